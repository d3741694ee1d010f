"""The rate of the first-order form and its derivative, compiled."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, contact_power
from microslip_mechanics.contact.normal import contact_energy, spring_response
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel
from microslip_mechanics.loads.segments import load_factors
from timedomain.first_order.first_order_slider import slide, slide_tangents
from timedomain.first_order.first_order_system import ENERGIES, System


@kernel
def flow(system: System, time: float, state: Array, rate: Array) -> None:
    """Write the rate of a state at a time; both have shape ``(size,)``."""
    modes, points = system.rates.size, system.points
    moved, moving = state[:modes], state[modes : 2 * modes]
    held, slides = state[2 * modes : -ENERGIES], rate[2 * modes : -ENERGIES]
    gaps, slips = np.dot(system.gaps, moved), np.dot(system.slips, moving)
    forces, tangent = np.empty(gaps.size), np.empty((3, 3))
    friction, damped = 0.0, 0.0
    for point in range(points.load.size):
        rows = slice(3 * point, 3 * point + 3)
        gap, slip, force = gaps[rows], slips[rows], forces[rows]
        contact_force(points, point, gap, slip, force, tangent, tangent)
        if system.slider[point] >= 0:
            slide(system, point, slip, held, slides, force)
        slid, lost = contact_power(points, point, gap, slip, force)
        friction += slid
        damped += lost
    pull, drag = np.dot(system.pulls, forces), np.dot(system.damping, moving)
    loads = _loads(system, time)
    put_in, taken = 0.0, 0.0
    for mode in range(modes):
        load = loads[mode]
        rate[mode] = system.scale * moving[mode]
        rate[modes + mode] = (
            load - system.rates[mode] * moved[mode] - drag[mode] - pull[mode]
        )
        put_in += load * moving[mode]
        taken += drag[mode] * moving[mode]
    unit = system.motion**2 / system.energy
    rate[-3] = friction / system.energy
    rate[-2] = unit * taken + damped / system.energy
    rate[-1] = unit * put_in


@kernel
def jacobian(system: System, time: float, state: Array, matrix: Array) -> None:
    """Write the derivative of the rate by the state, of shape ``(size, size)``."""
    modes, points = system.rates.size, system.points
    moving = state[modes : 2 * modes]
    gaps = np.dot(system.gaps, state[:modes])
    slips = np.dot(system.slips, moving)
    force, stiff, viscous = np.empty(3), np.empty((3, 3)), np.empty((3, 3))
    matrix[:] = 0.0
    for mode in range(modes):
        matrix[mode, modes + mode] = system.scale
        matrix[modes + mode, mode] = -system.rates[mode]
    matrix[modes : 2 * modes, modes : 2 * modes] = -system.damping
    power = np.empty((2, 2, 3))
    for point in range(points.load.size):
        rows = slice(3 * point, 3 * point + 3)
        gap, slip, pull = gaps[rows], slips[rows], system.pulls[:, rows].copy()
        contact_force(points, point, gap, slip, force, stiff, viscous)
        _power_tangents(points, point, gap, slip, force, stiff, viscous, power)
        for part, tangent in enumerate((stiff, viscous)):
            seen = (system.gaps if part == 0 else system.slips)[rows]
            columns = slice(part * modes, (part + 1) * modes)
            matrix[modes : 2 * modes, columns] -= np.dot(pull, np.dot(tangent, seen))
            matrix[-3:-1, columns] += np.dot(power[part], seen) / system.energy
        if system.slider[point] >= 0:
            slide_tangents(system, point, slip, state, matrix)
    loads = _loads(system, time)
    unit = system.motion**2 / system.energy
    # of vᵀ C v, where C has Coriolis terms too
    drag = np.dot(system.damping, moving) + np.dot(moving, system.damping)
    for mode in range(modes):
        matrix[-2, modes + mode] += unit * drag[mode]
        matrix[-1, modes + mode] = unit * loads[mode]


@kernel
def _loads(system: System, time: float) -> Array:
    """Return the load on each mode over the motion unit, shape (modes,)."""
    factors = np.empty(system.loads.shape[0])
    load_factors(system.history, time, 0, factors)
    loads: Array = np.dot(factors, system.loads)
    return loads


@kernel
def _power_tangents(
    points: ContactPoints,
    point: int,
    gap: Array,
    slip: Array,
    force: Array,
    stiff: Array,
    viscous: Array,
    power: Array,
) -> None:
    """Write the derivatives of both powers of a point.

    ``power`` has shape (by gap or by slip, friction or damping, 3).
    """
    power[:] = 0.0
    for axis in range(3):
        for tangent in (1, 2):
            power[0, 0, axis] += stiff[tangent, axis] * slip[tangent]
            power[1, 0, axis] += viscous[tangent, axis] * slip[tangent]
    for tangent in (1, 2):
        power[1, 0, tangent] += force[tangent]
    spring, harder = spring_response(points, point, gap[0])
    power[1, 1, 0] = viscous[0, 0] * slip[0] + force[0] - spring
    power[0, 1, 0] = (stiff[0, 0] - harder) * slip[0]


@kernel
def stored_energy(system: System, state: Array) -> float:
    """Return kinetic, elastic and contact energy [J]."""
    modes, points = system.rates.size, system.points
    gaps = np.dot(system.gaps, state[:modes])
    stored = 0.0
    for mode in range(modes):
        elastic = system.rates[mode] / system.scale * state[mode] ** 2
        stored += 0.5 * system.motion**2 * (elastic + state[modes + mode] ** 2)
    for point in range(points.load.size):
        stored += contact_energy(points, point, gaps[3 * point])
    return stored
