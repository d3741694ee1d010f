"""The equations of a problem in first-order form, as general solvers want them.

M ü + C u̇ + K u + Lᵀ f(L u, L u̇) = loads is written in modal coordinates u = Φ q with
Φᵀ M Φ = 1, all modes kept. The state is (s q, q̇) over a motion unit and three energies
over an energy unit: taken out by friction, taken out by damping (of structure and of
contacts), put in. With s about the frequency of the motion, all of it is of order one.
Between them stand the tractions of elastic friction over its limit: where a slider
does not slide, ṫ = k_t v. Forces and tangents are those of the marches' own kernel.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import ELASTIC, RIGID, ContactPoints
from microslip_mechanics.jit import closure
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.undamped_modes import undamped_modes
from timedomain.first_order.first_order_rate import flow, jacobian, stored_energy
from timedomain.first_order.first_order_system import ENERGIES, System
from timedomain.record.start import Start

__all__ = ["FirstOrder", "Flow", "Jacobian", "first_order", "flow", "jacobian"]


class FirstOrder(NamedTuple):
    """The first-order form of a problem under a load history."""

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
                self._tractions(start),
                np.zeros(ENERGIES),
            ]
        )

    def start(self, state: Array) -> Start:
        """Return a state as a motion."""
        displacement, velocity = self.motion(state)
        points = np.flatnonzero(self.system.slider >= 0)
        traction = np.zeros((self.system.slider.size, 2))
        held = state[2 * self.modes.shape[1] : -ENERGIES].reshape(-1, 2)
        traction[points] = held * self.system.limit[points, None]
        return Start(displacement, velocity, traction if points.size else None)

    def _tractions(self, start: Start) -> Array:
        """Return the tractions over their limits, shape (2 sliders,)."""
        points = np.flatnonzero(self.system.slider >= 0)
        if start.traction is None:
            return np.zeros(2 * points.size)
        held = start.traction[points] / self.system.limit[points, None]
        return np.asarray(held.ravel())

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

        @closure
        def flow_of(time: float, state: Array, rate: Array) -> None:
            flow(system, time, state, rate)

        @closure
        def jacobian_of(time: float, state: Array, matrix: Array) -> None:
            jacobian(system, time, state, matrix)

        return flow_of, jacobian_of


Flow = Callable[[float, Array, Array], None]
"""writes the state's rate, given time and state"""
Jacobian = Callable[[float, Array, Array], None]
"""writes the derivative of the rate by the state, given time and state"""


def first_order(
    problem: Problem, history: LoadHistory, *, motion: float, energy: float
) -> FirstOrder:
    """Return the first-order form of a problem under a load history.

    ``motion`` [m √kg / s] and ``energy`` [J] are the units of the state.

    Raises
    ------
    ValueError
        If a contact remembers, other than elastic friction of constant limit, or is
        rigid.
    """
    structure, points = problem.structure.dense, problem.interface.points
    _check(points, problem.interface.names)
    segments = history.segments()
    squares, modes = undamped_modes(structure.stiffness, structure.mass)
    scale = float(segments.sine[0, 1])
    seen = problem.interface.displacement @ modes
    sliding = remembers(points)
    system = System(
        squares / scale,
        np.ascontiguousarray(modes.T @ structure.damping @ modes),
        np.ascontiguousarray(seen * (motion / scale)),
        np.ascontiguousarray(seen * motion),
        np.ascontiguousarray(seen.T / motion),
        np.ascontiguousarray(problem.loads @ modes / motion),
        scale,
        motion,
        energy,
        segments,
        points,
        np.where(sliding, np.cumsum(sliding) - 1, -1),
        np.where(sliding, points.dynamic * points.load, 1.0),
    )
    return FirstOrder(system, modes, structure.mass)


def _check(points: ContactPoints, names: tuple[str, ...]) -> None:
    """Check that what remembers has a rate of its own, and that nothing is rigid."""
    for point in np.flatnonzero(points.friction == RIGID):
        raise ValueError(
            f"{names[point]}: rigid friction is set-valued: it has no first-order form"
        )
    for point in np.flatnonzero(remembers(points)):
        steady = points.constant_load[point] and points.load[point] > 0.0
        if points.friction[point] != ELASTIC or not steady:
            raise ValueError(
                f"{names[point]}: of contacts that remember only elastic friction of "
                "constant load has a first-order form"
            )
