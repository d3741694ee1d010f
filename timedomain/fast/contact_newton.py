"""Newton's method for the contact forces of one stage (theory, §7.2)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel
from timedomain.contact.dense import copy_rows, eliminate
from timedomain.contact.local_motion import Answer, Local
from timedomain.fast.contact_matrix import assemble
from timedomain.fast.coordinates import Contacts

NEWTON_LIMIT = 40
CAREFUL = 6
"""iterations with tangents before those with secants"""
EARLY = 0.03
"""of the residual: one more change of a quadratic iteration squares it"""


@bare_kernel
def solve_contact(
    contacts: Contacts,
    answer: Answer,
    displacement: Array,
    velocity: Array,
    local: Local,
    tolerance: float,
    floor: float,
) -> int:
    """Find contact forces and relative motion of a stage.

    Parameters
    ----------
    contacts, answer
        Points and compliance.
    displacement, velocity
        y and ẏ that the stage would have without its contact force, shape ``(rank,)``.
    local
        Begins with a guess of ``forces``; all of it is written.
    tolerance, floor
        Of the unbalanced force: relative and absolute [N].

    Returns
    -------
    Iterations, or −1 if they do not converge.
    """
    if velocity.size == 0:
        return 1
    _begin(contacts, answer, displacement, velocity, local)
    for iteration in range(1, NEWTON_LIMIT + 1):
        size, scale = assemble(contacts, answer, local, iteration > CAREFUL)
        if size <= tolerance * scale + floor:
            copy_rows(local.lines, local.forces)
            return iteration
        change = local.change[0]
        if not eliminate(local.matrix, change):
            return -1
        _update(contacts, answer, local)
        if iteration < CAREFUL and size <= EARLY * tolerance**0.5 * scale:
            return iteration
        if not np.isfinite(size):
            return -1
    return -1


@inner_kernel
def _begin(
    contacts: Contacts,
    answer: Answer,
    displacement: Array,
    velocity: Array,
    local: Local,
) -> None:
    """Make the motion that belongs to the guessed forces."""
    rank = velocity.size
    local.reaction[:] = 0.0
    for point in range(contacts.first.size):
        first = contacts.first[point]
        for axis in range(3):
            force = local.forces[point, axis]
            for i in range(contacts.width[point]):
                local.reaction[first + i] += contacts.basis[point, axis, i] * force
    for i in range(rank):
        local.velocity[i], local.displacement[i] = velocity[i], displacement[i]
    for j in range(rank):
        force = local.reaction[j]
        for i in range(rank):
            local.velocity[i] -= answer.compliance[j, i] * force
    for i in range(rank):
        local.change[0, i] = local.velocity[i] - velocity[i]
    _displace(answer, local)
    _read(contacts, local)


@inner_kernel
def _displace(answer: Answer, local: Local) -> None:
    """Move the relative displacement by what belongs to a change of velocity."""
    for i in range(local.velocity.size):
        local.displacement[i] += answer.slope * local.change[0, i]


@inner_kernel
def _read(contacts: Contacts, local: Local) -> None:
    """Write displacement and velocity of the points."""
    for point in range(contacts.first.size):
        first = contacts.first[point]
        for axis in range(3):
            gap, slip = 0.0, 0.0
            for i in range(contacts.width[point]):
                row = contacts.basis[point, axis, i]
                gap += row * local.displacement[first + i]
                slip += row * local.velocity[first + i]
            local.gaps[point, axis], local.slips[point, axis] = gap, slip


@inner_kernel
def _update(contacts: Contacts, answer: Answer, local: Local) -> None:
    """Apply a change of velocity to motion, reaction and linearised forces."""
    rank = local.velocity.size
    change = local.change[0]
    for i in range(rank):
        local.velocity[i] += change[i]
        for j in range(rank):
            local.reaction[i] -= answer.stiffness[i, j] * change[j]
    _displace(answer, local)
    _follow(contacts, local)


@inner_kernel
def _follow(contacts: Contacts, local: Local) -> None:
    """Write the points' motion, and their forces along the tangents."""
    gaps, slips, forces, slopes = local.gaps, local.slips, local.forces, local.by_slip
    for point in range(contacts.first.size):
        first = contacts.first[point]
        for axis in range(3):
            gap, slip = 0.0, 0.0
            for i in range(contacts.width[point]):
                row = contacts.basis[point, axis, i]
                gap += row * local.displacement[first + i]
                slip += row * local.velocity[first + i]
            forces[point, axis] = slip - slips[point, axis]
            gaps[point, axis], slips[point, axis] = gap, slip
        zero, one, two = forces[point, 0], forces[point, 1], forces[point, 2]
        for axis in range(3):
            forces[point, axis] = (
                local.lines[point, axis]
                + slopes[point, axis, 0] * zero
                + slopes[point, axis, 1] * one
                + slopes[point, axis, 2] * two
            )
