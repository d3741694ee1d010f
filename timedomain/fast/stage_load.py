"""Modal forces of the loads over a step of the fast march."""

from __future__ import annotations

from microslip_mechanics.jit import inner_kernel
from microslip_mechanics.loads.segments import Segments, load_factors
from timedomain.fast.coordinates import Modes
from timedomain.fast.coupling import coupled_force
from timedomain.fast.fast_powers import pull
from timedomain.fast.motion import HINT, Motion, Trial
from timedomain.fast.tables import Tables


@inner_kernel
def stage_load(
    modes: Modes,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    stage: int,
    time: float,
) -> None:
    """Write the modal force of a stage but for contact."""
    load_factors(segments, time, motion.counts[HINT], trial.factors)
    force = trial.force[stage]
    for j in range(force.size):
        force[j] = pull(modes, trial, j)
        force[j] -= coupled_force(trial, j, tables.times[stage], tables.mean > 0.0)


@inner_kernel
def middle_load(
    modes: Modes, segments: Segments, motion: Motion, trial: Trial, time: float
) -> None:
    """Write the modal forces of the loads at the middle of a step."""
    load_factors(segments, time, motion.counts[HINT], trial.factors)
    for j in range(trial.bulge.size):
        trial.bulge[j] = pull(modes, trial, j)


@inner_kernel
def share_bulge(modes: Modes, trial: Trial) -> None:
    """Add to both ends what the mean load, by Simpson's rule, exceeds their mean by."""
    for j in range(trial.bulge.size):
        ends = 0.5 * (trial.load[j] + pull(modes, trial, j))
        trial.bulge[j] = 2.0 * (trial.bulge[j] - ends) / 3.0
        trial.force[0, j] += trial.bulge[j]
        trial.force[1, j] += trial.bulge[j]
