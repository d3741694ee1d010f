"""What a march reads before its first step: meters at zero, powers, energy."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import traction_energy
from microslip_mechanics.contact.normal import contact_energy
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.problem import Problem
from timedomain.contact.state import State
from timedomain.record.record import FLOWS, FRICTION, Meters, accumulate


def meters(problem: Problem, shapes: Array, state: State) -> Meters:
    """Return meters that read zero at a state; its friction may store something."""
    structure, energies = problem.structure, np.zeros(len(FLOWS))
    energies[FRICTION] = _stuck(problem, state)
    return Meters(
        structure.mass,
        structure.damping,
        structure.stiffness,
        shapes,
        np.ascontiguousarray(problem.probes.rows),
        np.zeros(len(FLOWS)),
        energies,
    )


def powers(problem: Problem, history: LoadHistory, state: State) -> Array:
    """Return the powers of FLOWS at time zero [W], shape (4,)."""
    shapes = problem.loads.T.copy()
    reading = meters(problem, shapes, state)
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
    return float(kinetic + elastic + contact + _stuck(problem, state))


def _stuck(problem: Problem, state: State) -> float:
    """Return what friction that remembers stores in its springs k_t [J]."""
    points = problem.interface.points
    energies = (
        traction_energy(points, point, state.past[point, 1])
        for point in range(problem.interface.count)
    )
    return float(sum(energies))
