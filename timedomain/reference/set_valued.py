"""Average acceleration with rigid friction as a set-valued law (theory §7.1).

A rigid contact carries a mean traction over a step: that under which the mass that it
sees, with a constant push, slides from its velocity at the step's begin to that at its
end, stopping in between where it would turn. A contact that sticks ends with no sliding
velocity at all. Impulses stay out of the acceleration that the next step begins with,
so that a contact that begins to stick does not ring.
"""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import friction_load
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel
from timedomain.contact.dense import combine, copy, copy_rows
from timedomain.contact.operators import Operators
from timedomain.contact.state import State
from timedomain.record.record import FRICTION, Meters, accumulate, store
from timedomain.reference.rigid_points import Sliders
from timedomain.reference.sliding_newton import Trial, solve_sliding


@kernel
def march_sliders(
    operators: Operators,
    sliders: Sliders,
    points: ContactPoints,
    state: State,
    meters: Meters,
    factors: Array,
    rows: Array,
    first: int,
    tolerance: float,
) -> tuple[int, int]:
    """March like :func:`timedomain.reference.newmark.march`, with rigid points."""
    steps, stride = factors.shape[0], factors.shape[0] // rows.shape[0]
    compliance = _compliance(operators, sliders)
    count, rank = sliders.rows.shape
    size, iterations = rank + count, 0
    made = Trial(
        np.zeros(rank), np.zeros(count), np.zeros(count), np.zeros(size),
        np.zeros((size, size)), np.zeros(4), np.zeros((4, 6)), np.zeros(count // 2),
    )  # fmt: skip
    for place in range(count):
        made.push[place] = state.forces[sliders.points[place // 2], 1 + place % 2]
    for step in range(first, steps):
        gaps, slips, forces = state.gaps.copy(), state.slips.copy(), state.forces.copy()
        for place in range(count // 2):
            point = sliders.points[place]
            made.loads[place], _, _ = friction_load(
                points, point, state.gaps[point, 0], state.slips[point, 0]
            )
        taken = _advance(
            operators, sliders, compliance, points, state, factors[step], tolerance,
            made,
        )  # fmt: skip
        if taken < 0:  # its parts, too, begin where the step before has ended
            copy_rows(gaps, state.gaps)
            copy_rows(slips, state.slips)
            copy_rows(forces, state.forces)
            return step, iterations
        iterations += taken
        accumulate(meters, points, state, factors[step], operators.step)
        for point in sliders.points:  # the mean traction works on the mean velocity
            changed = state.forces[point, 1:] - forces[point, 1:]
            work = 0.5 * operators.step * np.dot(changed, slips[point, 1:])
            meters.energies[FRICTION] += work
        if (step + 1) % stride == 0:
            store(meters, points, state, rows[step // stride])
    return steps, iterations


@kernel
def _compliance(operators: Operators, sliders: Sliders) -> Array:
    """Return the larger acceleration of each point's tangents by force, (count,)."""
    count = sliders.points.size
    compliance = np.zeros(count)
    for place in range(2 * count):
        row = sliders.rows[place]
        own = np.dot(row, np.dot(operators.compliance, row))
        compliance[place // 2] = max(compliance[place // 2], own)
    return compliance


@kernel
def _advance(
    operators: Operators,
    sliders: Sliders,
    compliance: Array,
    points: ContactPoints,
    state: State,
    factors: Array,
    tolerance: float,
    made: Trial,
) -> int:
    """Take one step; return Newton's iterations, or −1 and an untouched motion."""
    half, dofs = 0.5 * operators.step, state.displacement.size
    predicted = np.empty(2 * dofs)
    for i in range(dofs):
        velocity = state.velocity[i] + half * state.acceleration[i]
        predicted[i] = state.displacement[i] + half * (state.velocity[i] + velocity)
        predicted[dofs + i] = velocity
    free = np.dot(operators.free, predicted) + np.dot(operators.load, factors)
    start = np.stack(
        (
            np.dot(operators.selection, predicted[:dofs]),
            np.dot(operators.selection, predicted[dofs:]),
            np.dot(operators.selection, free),
            np.dot(operators.selection, state.velocity),
        )
    )
    smooth, taken = solve_sliding(
        operators, sliders, compliance, points, state, start, tolerance, made
    )
    if taken < 0:  # once more, as if nothing rubbed before
        made.push[:] = 0.0
        smooth, taken = solve_sliding(
            operators, sliders, compliance, points, state, start, tolerance, made
        )
    if taken < 0:
        return taken
    # twice the mean at the end and nothing at the beginning: the trapezoidal rule
    impulse = 2.0 * np.dot(sliders.rows.T, made.traction)
    free -= np.dot(operators.contact, smooth + impulse)
    later = np.dot(sliders.release, impulse)
    copy(state.fresh.ravel(), state.past.ravel())
    combine(smooth, 1.0, impulse, state.reaction)
    for i in range(dofs):
        state.displacement[i] = predicted[i] + half**2 * free[i]
        state.velocity[i] = predicted[dofs + i] + half * free[i]
        state.acceleration[i] = free[i] + later[i]
    for place in range(made.traction.size):
        point = sliders.points[place // 2]
        state.forces[point, 1 + place % 2] += made.traction[place]
    return taken
