"""What a decay says of its cycles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microslip_mechanics.results.ring_down import RingDown

COLUMNS = ("time_s", "amplitude_m", "frequency_hz", "damping_ratio")
SHOWN = 20
GROWS = -1e-6
"""damping ratio below which an amplitude grows by more than the table shows"""


def cycles(decay: RingDown, probe: str) -> list[str]:
    """Return the table of the decay, some of its cycles."""
    count = decay.time.size
    rows = [
        f"free decay of {probe}",
        "time [s]  amplitude [mm]  frequency [Hz]  damping ratio [%]",
    ]
    chosen = sorted({round(n * (count - 1) / (SHOWN - 1)) for n in range(SHOWN)})
    rows += [
        f"{decay.time[place]:8.4f} {1e3 * decay.amplitude[place]:15.6g} "
        f"{decay.frequency[place] / math.tau:15.4f} "
        f"{100.0 * decay.damping[place]:18.4f}"
        for place in chosen
    ]
    grows = int((decay.damping < GROWS).sum())
    if grows:
        rows.append(
            f"the amplitude grows in {grows} of {count} cycles: several motions decay "
            "together and beat, so that no row is of one alone, or something feeds them"
        )
    return rows
