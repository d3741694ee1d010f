"""Where a march begins: at rest, or on a motion with contact forces in balance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_energy, contact_force
from microslip_mechanics.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from timedomain.newmark import State
from timedomain.record import FLOWS, Meters


@dataclass(frozen=True, slots=True)
class Start:
    """Initial motion."""

    displacement: Array
    """[m], shape (dofs,)"""
    velocity: Array
    """[m/s], shape (dofs,)"""


def at_rest(problem: Problem) -> Start:
    """Return the unloaded structure at rest."""
    still = np.zeros(problem.structure.dofs)
    return Start(still, still)


def first_state(problem: Problem, history: LoadHistory, start: Start) -> State:
    """Return the state whose acceleration balances all forces at time zero."""
    structure, interface = problem.structure, problem.interface
    basis, _ = interface.relative_motion()
    moved = (interface.displacement @ start.displacement).reshape(-1, 3)
    moving = (interface.displacement @ start.velocity).reshape(-1, 3)
    forces, unused = np.zeros_like(moved), np.zeros((2, 3, 3))
    for point in range(interface.count):
        contact_force(
            interface.points,
            point,
            moved[point],
            moving[point],
            forces[point],
            unused[0],
            unused[1],
        )
    factors = history.factors(np.zeros(1))[0]
    unbalanced = (
        factors[0] * problem.preload
        + factors[1] * problem.drive
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
    )


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
