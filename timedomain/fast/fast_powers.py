"""Powers over a step of the fast march."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_power
from microslip_mechanics.jit import bare_kernel, inner_kernel
from timedomain.contact.point_law import between
from timedomain.fast.coordinates import Contacts, Modes
from timedomain.fast.coupling import coupled_force
from timedomain.fast.motion import Motion, Trial
from timedomain.fast.tables import Tables


@bare_kernel
def stage_powers(
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    stage: int,
    part: float,
) -> None:
    """Write the powers of a stage."""
    _input_power(modes, trial, trial.velocity, stage)
    friction, damping = 0.0, 0.0
    local = trial.local
    for point in range(contacts.first.size):
        slid, damped = contact_power(
            contacts.points,
            point,
            local.gaps[point],
            local.slips[point],
            local.forces[point],
        )
        friction += slid
        damping += damped
        if tables.mean > 0.0:
            more = between(
                contacts.points,
                point,
                trial.begins[point],
                local.gaps[point, 0],
            )
            damping -= more[0] * local.slips[point, 0]
    lost = 0.0
    for j in range(trial.velocity.size):
        v = trial.velocity[j]
        lost += v * (modes.damping[j] * v)
        lost += v * coupled_force(trial, j, tables.times[stage], False)
    trial.powers[stage, 1], trial.powers[stage, 2] = friction, damping
    trial.powers[stage, 3] = lost
    if tables.mean > 0.0:
        trial.powers[1, 3] = 0.5 * (lost + motion.powers[3])
        trial.numbers[1] = lost
        _mean_input(modes, motion, trial, part)


@bare_kernel
def pull(modes: Modes, trial: Trial, mode: int) -> float:
    """Return the modal force of the loads."""
    force = 0.0
    for load in range(trial.factors.size):
        force += trial.factors[load] * modes.loads[load, mode]
    return force


@inner_kernel
def _input_power(modes: Modes, trial: Trial, velocity: Array, stage: int) -> None:
    power = 0.0
    for j in range(velocity.size):
        power += pull(modes, trial, j) * velocity[j]
    trial.powers[stage, 0] = power


@inner_kernel
def _mean_input(modes: Modes, motion: Motion, trial: Trial, length: float) -> None:
    """Write the mean power of loads that are linear over the step but for their mean.

    With a cubic between the modal motions of its ends it is p̄ Δq/h + Δp Δq̇/12.
    """
    power = 0.0
    for j in range(trial.velocity.size):
        begin = trial.load[j]
        end = pull(modes, trial, j)
        moved = trial.displacement[j] - motion.displacement[j]
        faster = trial.velocity[j] - motion.velocity[j]
        mean = 0.5 * (begin + end) + trial.bulge[j]
        power += mean * moved / length + (end - begin) * faster / 12.0
    trial.powers[1, 0] = power
