"""Which step the fast march tries after one that is too rough (theory, §7.2)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.jit import inner_kernel
from timedomain.fast.motion import (
    FIRST,
    HOPELESS,
    LEVEL,
    REJECTED,
    ROUGH,
    SAFE,
    TICK,
    WORST,
    Control,
    Motion,
)

SAFE_RUN = 32
"""dissipative steps before another of the first kind is tried"""
SHARE = 16.0
"""error over tolerance above which half a step would not do"""
IN_VAIN = 4
"""halvings of a step that do not halve its error, after which no more are tried"""

HOPE = 4096
"""shortest steps that may be too rough before all is well again"""
WELL = 12
"""level of a step that shows that it is"""


@inner_kernel
def tried_enough(control: Control, motion: Motion, level: int, error: float) -> bool:
    """Return whether a step of known error is taken though that is too large.

    It is where shorter ones are no better, as when a contact jams at once, and for a
    while where there are none.
    """
    if not np.isfinite(error):
        return False
    counts, worst = motion.counts, motion.numbers[WORST]
    if worst == 0.0 or error < 0.5 * worst:
        motion.numbers[WORST], counts[FIRST] = error, level
    if counts[SAFE] == 0:
        return False
    if level < control.lowest:
        return bool(error <= SHARE and _in_vain(motion, level))
    counts[HOPELESS] += 1
    return bool(counts[HOPELESS] <= HOPE)


@inner_kernel
def _in_vain(motion: Motion, level: int) -> bool:
    """Return whether halving a step has not helped at this place."""
    return bool(motion.numbers[WORST] > 0.0 and level >= motion.counts[FIRST] + IN_VAIN)


@inner_kernel
def reject(control: Control, motion: Motion, level: int, nearly: bool) -> bool:
    """Choose half the step, or a dissipative one; return whether there is one."""
    counts = motion.counts
    counts[REJECTED] += 1
    counts[ROUGH] = counts[TICK]
    counts[LEVEL] = level
    half = nearly and level < control.lowest and not _in_vain(motion, level)
    if counts[SAFE] > 0 or half:
        counts[LEVEL] = level + 1
    else:
        counts[SAFE] = SAFE_RUN
        motion.numbers[WORST] = 0.0
    return bool(counts[LEVEL] <= control.lowest)
