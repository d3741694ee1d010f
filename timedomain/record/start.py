"""Where a march begins: at rest, or on a motion with contact forces in balance."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.loop_gradient import Waves, loop_gradient
from microslip_mechanics.contact.memory import pressed, remembers
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.spread import spread_force
from microslip_mechanics.contact.steady_loop import steady_loop
from microslip_mechanics.floating import floating
from microslip_mechanics.jit import kernel
from microslip_mechanics.loads.excitation import Dwell, LoadHistory
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from timedomain.contact.state import State
from timedomain.record.driftless import driftless

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
    Where they balance at zero displacement, on a hilltop too, that is the place. What
    nothing holds has the velocity with which it does not drift.

    Raises
    ------
    StaticError
        If the preload has no static equilibrium.
    """
    grown = float(history.segments().preload[0, 0])
    there, still = replace(problem, preload=grown * problem.preload), at_rest(problem)
    begin = replace(still, velocity=driftless(problem, history))
    if not first_state(there, Dwell(1.0, 1.0), still).acceleration.any():
        return begin
    return replace(begin, displacement=static_equilibrium(there).displacement)


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
        leans = floating(problem).lean(moved.mean(axis=0))
        for point in recalls:
            own = slice(3 * point, 3 * point + 3)
            loop, _ = steady_loop(
                points, point, moved[:, own].T.copy(), moving[:, own].T.copy(), still,
                response.frequency, np.zeros(3, dtype=bool), leans[point],
                loop_gradient(LOOP, 0),
            )  # fmt: skip
            tractions[point] = loop[:, 0]
    return Start(displacement[0], velocity[0], tractions)


def first_state(
    problem: Problem, history: LoadHistory, start: Start, step: float = 0.0
) -> State:
    """Return the state whose acceleration balances all forces at time zero.

    ``step`` is that of a march over which forces that jump are spread [s].
    """
    structure, interface = problem.structure, problem.interface
    basis, _ = interface.relative_motion()
    moved, moving, forces, past = _contacts(interface, start, step)
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


def _contacts(
    interface: Interface, start: Start, step: float
) -> tuple[Array, Array, Array, Array]:
    """Return displacement, velocity, force and past of the contact points.

    Of shape ``(points, 3)`` each, the past ``(points, 4, 2)`` as
    :func:`~microslip_mechanics.contact.memory.add_traction` wants it.
    """
    moved = (interface.displacement @ start.displacement).reshape(-1, 3)
    moving = (interface.displacement @ start.velocity).reshape(-1, 3)
    forces, unused = np.zeros_like(moved), np.zeros((5, 3, 3))
    past = np.zeros((interface.count, 4, 2))
    past[:, 0], past[:, 2] = moved[:, 1:], moving[:, 1:]
    for point in range(interface.count):
        _press(interface.points, point, moved[point, 0], moving[point, 0], past[point])
        spread_force(
            interface.points, point, step, moved[point], moving[point], forces[point],
            unused,
        )  # fmt: skip
    if start.traction is not None:
        past[:, 1] = start.traction
        forces[:, 1:] += start.traction
    return moved, moving, forces, past


@kernel
def _press(
    points: ContactPoints, point: int, displacement: float, velocity: float, past: Array
) -> None:
    """Write into a point's past how it is pressed."""
    press, _, _ = pressed(points, point, displacement, velocity)
    past[3, 0], past[3, 1] = press.load, press.depth
