"""Where a march begins: at rest, or on a motion with contact forces in balance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.memory import friction_load, remembers
from microslip_mechanics.contact.normal import contact_energy
from microslip_mechanics.contact.steady_loop import Waves, steady_loop
from microslip_mechanics.excitation import Dwell, LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.segments import factors_over
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.time_history import Checkpoint
from timedomain.record import FLOWS, Meters, accumulate
from timedomain.state import State

LOOP = 4096
"""samples of a period in which contacts that remember settle"""


@dataclass(frozen=True, slots=True)
class Start:
    """Initial motion."""

    displacement: Array
    """[m], shape (dofs,)"""
    velocity: Array
    """[m/s], shape (dofs,)"""
    traction: Array | None = None
    """of friction that remembers [N], shape (points, 2); none if left out"""


def at_rest(problem: Problem) -> Start:
    """Return the unloaded structure at rest."""
    still = np.zeros(problem.structure.dofs)
    return Start(still, still)


def loaded(problem: Problem, history: LoadHistory) -> Start:
    """Return rest under what loads a structure when a march begins, but its drive.

    These are what is there of the preload, and contacts under a force of their own.
    Where they balance at zero displacement, on a hilltop too, that is the place.

    Raises
    ------
    StaticError
        If the preload has no static equilibrium.
    """
    grown = float(history.segments().preload[0, 0])
    there, begin = replace(problem, preload=grown * problem.preload), at_rest(problem)
    if not first_state(there, Dwell(1.0, 1.0), begin).acceleration.any():
        return begin
    return Start(static_equilibrium(there).displacement, begin.velocity)


def force_scale(problem: Problem, start: Start) -> float:
    """Return what forces are compared with [N]: a load, or what a free start holds."""
    if problem.loads.any():
        return problem.force_scale
    structure = problem.structure.dense
    held = np.abs(structure.stiffness @ start.displacement).max(initial=0.0)
    damped = np.abs(structure.damping @ start.velocity).max(initial=0.0)
    return float(held + damped) or 1.0


def on_orbit(problem: Problem, response: PeriodicResponse) -> Start:
    """Return the motion of a periodic response at phase 0, with what contacts remember.

    Their tractions are those of the steady loop along the response.
    """
    displacement, velocity = response.at(np.zeros(1))
    points, rows = problem.interface.points, problem.interface.displacement
    tractions = np.zeros((problem.interface.count, 2))
    recalls = np.flatnonzero(remembers(points)).tolist()
    if recalls:
        phase = 2.0 * np.pi * np.arange(LOOP) / LOOP
        moved, moving = (part @ rows.T for part in response.at(phase))
        still = Waves(np.zeros((LOOP, 0)), np.zeros((LOOP, 0)))
        for point in recalls:
            own = slice(3 * point, 3 * point + 3)
            loop, _ = steady_loop(
                points, point, moved[:, own].T.copy(), moving[:, own].T.copy(), still,
                response.frequency, np.zeros(3, dtype=bool), np.zeros((2, 3, 0, 0)),
            )  # fmt: skip
            tractions[point] = loop[:, 0]
    return Start(displacement[0], velocity[0], tractions)


def at_end(problem: Problem, end: Checkpoint) -> Start:
    """Return the motion at the end of a march, with what contacts remember.

    Those that remember are marched by the reference method alone, whose checkpoint
    holds their tractions; behind it may be that of a march with other steps.
    """
    if not remembers(problem.interface.points).any():
        return Start(end.displacement, end.velocity)
    state = first_state(problem, Dwell(1.0, 1.0), at_rest(problem))
    unread = meters(problem, problem.loads.T.copy())
    own = 3 + sum(array.size for array in _kept(state, unread))
    restore(state, unread, replace(end, memory=end.memory[:own]))
    return Start(end.displacement, end.velocity, state.past[:, 1].copy())


def first_state(problem: Problem, history: LoadHistory, start: Start) -> State:
    """Return the state whose acceleration balances all forces at time zero."""
    structure, interface = problem.structure, problem.interface
    basis, _ = interface.relative_motion()
    moved, moving, forces, past = _contacts(interface, start)
    loads = problem.loads
    factors = factors_over(history.segments(), np.zeros(1), len(loads))[0]
    unbalanced = (
        factors @ loads
        - structure.damping @ start.velocity
        - structure.stiffness @ start.displacement
        - interface.displacement.T @ forces.ravel()
    )
    return State(
        start.displacement.copy(),
        start.velocity.copy(),
        np.linalg.solve(structure.mass, unbalanced),
        basis.T @ forces.ravel(),
        forces,
        moved,
        moving,
        past,
        past.copy(),
    )


def _contacts(interface: Interface, start: Start) -> tuple[Array, Array, Array, Array]:
    """Return displacement, velocity, force and past of the contact points.

    Of shape ``(points, 3)`` each, the past ``(points, 4, 2)`` as
    :func:`~microslip_mechanics.contact.memory.add_traction` wants it.
    """
    moved = (interface.displacement @ start.displacement).reshape(-1, 3)
    moving = (interface.displacement @ start.velocity).reshape(-1, 3)
    forces, unused = np.zeros_like(moved), np.zeros((2, 3, 3))
    past = np.zeros((interface.count, 4, 2))
    past[:, 0], past[:, 2] = moved[:, 1:], moving[:, 1:]
    for point in range(interface.count):
        past[point, 3, 0], _, _ = friction_load(
            interface.points, point, moved[point, 0], moving[point, 0]
        )
        contact_force(
            interface.points, point, moved[point], moving[point], forces[point], *unused
        )
    if start.traction is not None:
        past[:, 1] = start.traction
        forces[:, 1:] += start.traction
    return moved, moving, forces, past


def checkpoint(
    state: State, meters: Meters, steps: int, step: float, stored: float
) -> Checkpoint:
    """Return where a march stands after so many steps [s].

    ``stored`` is the energy [J] that was stored at its start.
    """
    kept = [array.ravel() for array in _kept(state, meters)]
    memory = np.concatenate([[steps, stored, step], *kept])
    return Checkpoint(state.displacement.copy(), state.velocity.copy(), memory)


def restore(state: State, meters: Meters, end: Checkpoint) -> tuple[int, float, float]:
    """Put state and meters to where a march stood; return what else it kept.

    These are its number of steps, their length [s] and ``stored``.

    Raises
    ------
    ValueError
        If that march had other degrees of freedom or contacts.
    """
    arrays = (state.displacement, state.velocity, *_kept(state, meters))
    refill(arrays, np.concatenate([end.displacement, end.velocity, end.memory[3:]]))
    steps, stored, step = end.memory[:3]
    return int(steps), float(step), float(stored)


def refill(arrays: Sequence[NDArray[Any]], numbers: Array) -> None:
    """Write numbers of a checkpoint into the arrays of a march.

    Raises
    ------
    ValueError
        If they are the numbers of another problem.
    """
    if numbers.size != sum(array.size for array in arrays):
        raise ValueError(
            f"a march cannot go on from a state of {numbers.size} numbers: "
            "it must be one of the same problem"
        )
    cuts = np.cumsum([array.size for array in arrays])[:-1]
    for array, values in zip(arrays, np.split(numbers, cuts), strict=True):
        array[...] = values.reshape(array.shape)


def _kept(state: State, meters: Meters) -> tuple[Array, ...]:
    """Return what a step takes over from the one before, besides the motion."""
    return (*state[2:], meters.powers, meters.energies)


def meters(problem: Problem, shapes: Array) -> Meters:
    """Return meters that read zero."""
    structure = problem.structure
    return Meters(
        structure.mass,
        structure.damping,
        structure.stiffness,
        shapes,
        np.ascontiguousarray(problem.probes.rows),
        np.zeros(len(FLOWS)),
        np.zeros(len(FLOWS)),
    )


def powers(problem: Problem, history: LoadHistory, state: State) -> Array:
    """Return the powers of FLOWS at time zero [W], shape (4,)."""
    shapes = problem.loads.T.copy()
    reading = meters(problem, shapes)
    factors = factors_over(history.segments(), np.zeros(1), shapes.shape[1])[0]
    accumulate(reading, problem.interface.points, state, factors, 0.0)
    return reading.powers


def stored_energy(problem: Problem, state: State) -> float:
    """Return kinetic, elastic and contact energy [J]."""
    structure, points = problem.structure, problem.interface.points
    kinetic = state.velocity @ structure.mass @ state.velocity / 2.0
    elastic = state.displacement @ structure.stiffness @ state.displacement / 2.0
    contact = sum(
        contact_energy(points, point, state.gaps[point, 0])
        for point in range(problem.interface.count)
    )
    return float(kinetic + elastic + contact)
