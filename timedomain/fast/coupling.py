"""Damping and gyroscopic forces of the other modes, over a step (theory, §7.2).

Modes are marched exactly one by one; what couples them through their velocities is a
force ``p`` on each. It is linear over a step but for its mean, C Δq/h, which the motion
itself tells; its value at the end is found by trying the step again. What the mean is
more is shared out evenly, or as a parabola in a step of several stages.
"""

from __future__ import annotations

from microslip_mechanics.jit import bare_kernel, inner_kernel
from timedomain.fast.coordinates import Modes
from timedomain.fast.motion import Motion, Trial

BEGIN, CHANGE, BULGE = range(3)
SMOOTHEST = 60.0
"""h²/60 times the change of the mean's excess is what a step leaves out of q: the
cubic part of p, h³ p‴ (x³ - x/4)/6, has the first moment h⁵ p‴/720"""


@inner_kernel
def extrapolate_coupling(motion: Motion, trial: Trial, length: float) -> None:
    """Guess the coupling forces of a step from those of the last one."""
    coupled = trial.coupled
    for j in range(trial.coupled.shape[1]):
        coupled[BEGIN, j] = motion.coupled[0, j]
        coupled[CHANGE, j] = length * motion.coupled[1, j]
        coupled[BULGE, j] = length**2 * motion.coupled[2, j]


@inner_kernel
def renew_coupling(modes: Modes, motion: Motion, trial: Trial, length: float) -> float:
    """Write the coupling forces that the step's end asks for.

    Returns
    -------
    By how much velocities change then, over the size of the motion.
    """
    coupled, change, size = trial.coupled, 0.0, 0.0
    for i in range(trial.coupled.shape[1]):
        q, v = trial.displacement[i], trial.velocity[i]
        size += v**2 + abs(modes.stiffness[i]) * q**2
        end, mean = 0.0, 0.0
        for j in range(modes.reach[i, 0], modes.reach[i, 1]):
            moved = trial.displacement[j] - motion.displacement[j]
            end += modes.coupling[i, j] * trial.velocity[j]
            mean += modes.coupling[i, j] * moved / length
        rise = end - coupled[BEGIN, i]
        bulge = mean - coupled[BEGIN, i] - 0.5 * rise
        change += (0.5 * (rise - coupled[CHANGE, i]) + bulge - coupled[BULGE, i]) ** 2
        coupled[CHANGE, i], coupled[BULGE, i] = rise, bulge
    return float(length * (change / size) ** 0.5) if change > 0.0 else 0.0


@bare_kernel
def coupled_force(trial: Trial, mode: int, place: float, mean: bool) -> float:
    """Return the coupling force at a place of the step, from 0 to 1.

    With ``mean``, what the mean exceeds that of both ends by is added to both.
    """
    coupled = trial.coupled
    if coupled.shape[1] == 0:
        return 0.0
    share = 1.0 if mean else 6.0 * place * (1.0 - place)
    return float(
        coupled[BEGIN, mode]
        + place * coupled[CHANGE, mode]
        + share * coupled[BULGE, mode]
    )


@inner_kernel
def coupling_error(modes: Modes, motion: Motion, trial: Trial, length: float) -> float:
    """Return twice the energy of what a step leaves out of the coupling forces.

    That is a displacement; it counts by the stiffness of its mode, or by the speed that
    it gives to the others.
    """
    energy = 0.0
    for j in range(trial.coupled.shape[1]):
        bent = trial.coupled[BULGE, j] - length**2 * motion.coupled[2, j]
        across, stiffness = 0.0, abs(modes.stiffness[j])
        for i in range(modes.reach[j, 0], modes.reach[j, 1]):
            across += modes.coupling[i, j] ** 2
        flexibility = length**2 / SMOOTHEST
        if stiffness * flexibility > 1.0:
            flexibility = 1.0 / stiffness
        energy += max(stiffness, across) * (flexibility * bent) ** 2
    return energy


@inner_kernel
def accept_coupling(motion: Motion, trial: Trial, length: float) -> None:
    """Keep the forces at the end of a step that is taken over, and their rates."""
    for j in range(trial.coupled.shape[1]):
        rise = trial.coupled[CHANGE, j]
        motion.coupled[0, j] = trial.coupled[BEGIN, j] + rise
        motion.coupled[1, j] = rise / length
        motion.coupled[2, j] = trial.coupled[BULGE, j] / length**2
