"""The equations of a problem in first-order form, as general solvers want them.

M ü + C u̇ + K u + Lᵀ f(L u, L u̇) = loads is written in modal coordinates u = Φ q with
Φᵀ M Φ = 1, all modes kept. The state is (s q, q̇) over a motion unit and three energies
over an energy unit: taken out by friction, taken out by damping (of structure and of
contacts), put in. With s about the frequency of the motion, all of it is of order one.
Forces and their tangents are those of the product's own kernel.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numba
import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.hunt_crossley import spring_force
from microslip_mechanics.contact.law import (
    ContactPoints,
    contact_energy,
    contact_force,
    contact_power,
    normal_law,
)
from microslip_mechanics.excitation import SweptSine
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem
from timedomain.start import Start

ENERGIES = 3
"""friction, damping, input: the last places of the state"""


class Load(NamedTuple):
    """A swept sine as compiled code wants it (theory, eq. 20)."""

    ramp: float
    """the preload grows linearly from 0 until then [s]"""
    start: float
    """[s]"""
    end: float
    """[s]"""
    lowest: float
    """frequency at the start [Hz]"""
    rate: float
    """logarithmic sweep rate [1/s]"""


class System(NamedTuple):
    """Constants of the first-order form."""

    rates: Array
    """ω² / s of each mode [1/s], shape (modes,)"""
    damping: Array
    """Φᵀ C Φ [1/s], shape (modes, modes)"""
    gaps: Array
    """relative displacements of the points [m] from s q over its unit, (3 points, m)"""
    slips: Array
    """relative velocities [m/s] from q̇ over its unit, shape (3 points, modes)"""
    pulls: Array
    """Φᵀ Lᵀ over the motion unit, shape (modes, 3 points)"""
    preload: Array
    """Φᵀ of it over the motion unit, shape (modes,)"""
    drive: Array
    """the same of the drive's amplitude"""
    scale: float
    """s [1/s]"""
    motion: float
    """unit of s q and q̇ [m √kg / s]"""
    energy: float
    """unit of the energies [J]"""
    load: Load
    points: ContactPoints


class FirstOrder(NamedTuple):
    """The first-order form of a problem under a swept sine."""

    system: System
    modes: Array
    """Φ, shape (dofs, modes)"""
    mass: Array
    """M"""

    def state(self, start: Start) -> Array:
        """Return the state of a motion, all energies zero."""
        back, system = self.modes.T @ self.mass, self.system
        return np.concatenate(
            [
                back @ start.displacement * (system.scale / system.motion),
                back @ start.velocity / system.motion,
                np.zeros(ENERGIES),
            ]
        )

    def motion(self, state: Array) -> tuple[Array, Array]:
        """Return displacement and velocity, each (…, dofs), of states (…, size)."""
        modes, system = self.modes.shape[1], self.system
        moved, moving = state[..., :modes], state[..., modes : 2 * modes]
        scaled = self.modes.T * system.motion
        return moved @ scaled / system.scale, moving @ scaled

    def closing_error(self, states: Array) -> Array:
        """Return what the energy balance leaves [J], of states from the first on."""
        rows = np.ascontiguousarray(states)
        stored = np.array([stored_energy(self.system, each) for each in rows])
        friction, damping, put_in = self.system.energy * states[:, -ENERGIES:].T
        left: Array = put_in + stored[0] - friction - damping - stored
        return left

    def compiled(self) -> tuple[Flow, Jacobian]:
        """Return functions of time and state alone, their constants compiled in.

        What is unpacked at every call of a solver written in Python is then little.
        """
        system = self.system

        @numba.njit(error_model="numpy")
        def flow_of(time: float, state: Array, rate: Array) -> None:
            flow(system, time, state, rate)

        @numba.njit(error_model="numpy")
        def jacobian_of(time: float, state: Array, matrix: Array) -> None:
            jacobian(system, time, state, matrix)

        return flow_of, jacobian_of


Flow = Callable[[float, Array, Array], None]
"""writes the state's rate, given time and state"""
Jacobian = Callable[[float, Array, Array], None]
"""writes the derivative of the rate by the state, given time and state"""


def first_order(
    problem: Problem, sweep: SweptSine, *, motion: float, energy: float
) -> FirstOrder:
    """Return the first-order form of a problem under a swept sine.

    ``motion`` [m √kg / s] and ``energy`` [J] are the units of the state.
    """
    structure = problem.structure.dense
    squares, modes = scipy.linalg.eigh(structure.stiffness, structure.mass)
    scale = 2.0 * np.pi * sweep.lowest
    seen = problem.interface.displacement @ modes
    system = System(
        np.maximum(squares, 0.0) / scale,
        np.ascontiguousarray(modes.T @ structure.damping @ modes),
        np.ascontiguousarray(seen * (motion / scale)),
        np.ascontiguousarray(seen * motion),
        np.ascontiguousarray(seen.T / motion),
        modes.T @ problem.preload / motion,
        modes.T @ problem.drive.real / motion,
        scale,
        motion,
        energy,
        Load(sweep.ramp, sweep.start, sweep.end, sweep.lowest, sweep.rate),
        problem.interface.points,
    )
    return FirstOrder(system, modes, structure.mass)


@kernel
def factors(load: Load, time: float) -> tuple[float, float]:
    """Return the factors of preload and drive, as ``SweptSine.factors`` does."""
    steady = min(time / load.ramp, 1.0) if load.ramp > 0.0 else 1.0
    if time < load.start or time > load.end:
        return steady, 0.0
    elapsed = math.expm1(load.rate * (time - load.start)) / load.rate
    return steady, math.sin(2.0 * math.pi * load.lowest * elapsed)


@kernel
def flow(system: System, time: float, state: Array, rate: Array) -> None:
    """Write the rate of a state at a time; both have shape ``(2 modes + 3,)``."""
    modes, points = system.rates.size, system.points
    moved, moving = state[:modes], state[modes : 2 * modes]
    gaps, slips = np.dot(system.gaps, moved), np.dot(system.slips, moving)
    forces, tangent = np.empty(gaps.size), np.empty((3, 3))
    friction, damped = 0.0, 0.0
    for point in range(points.load.size):
        rows = slice(3 * point, 3 * point + 3)
        gap, slip, force = gaps[rows], slips[rows], forces[rows]
        contact_force(points, point, gap, slip, force, tangent, tangent)
        slid, lost = contact_power(points, point, gap, slip, force)
        friction += slid
        damped += lost
    pull, drag = np.dot(system.pulls, forces), np.dot(system.damping, moving)
    steady, sine = factors(system.load, time)
    put_in, taken = 0.0, 0.0
    for mode in range(modes):
        load = steady * system.preload[mode] + sine * system.drive[mode]
        rate[mode] = system.scale * moving[mode]
        rate[modes + mode] = (
            load - system.rates[mode] * moved[mode] - drag[mode] - pull[mode]
        )
        put_in += load * moving[mode]
        taken += drag[mode] * moving[mode]
    unit = system.motion**2 / system.energy
    rate[2 * modes] = friction / system.energy
    rate[2 * modes + 1] = unit * taken + damped / system.energy
    rate[2 * modes + 2] = unit * put_in


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
            matrix[2 * modes : 2 * modes + 2, columns] += (
                np.dot(power[part], seen) / system.energy
            )
    steady, sine = factors(system.load, time)
    unit = system.motion**2 / system.energy
    drag = np.dot(system.damping, moving)
    for mode in range(modes):
        load = steady * system.preload[mode] + sine * system.drive[mode]
        matrix[2 * modes + 1, modes + mode] += 2.0 * unit * drag[mode]
        matrix[2 * modes + 2, modes + mode] = unit * load


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
    spring = spring_force(normal_law(points, point), gap[0])
    power[1, 1, 0] = viscous[0, 0] * slip[0] + force[0] - spring
    if gap[0] > 0.0:
        harder = points.exponent[point] * spring / gap[0]
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
