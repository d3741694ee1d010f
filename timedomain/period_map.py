"""A period of the reference march, and the exact derivative of what it does to a state.

The step of :mod:`timedomain.newmark` is the trapezoidal rule on s = (u, u̇). With φ the
contact force, of tangents D at the new and at the old time,

    s₁ = A s₀ + b (φ₀ + φ₁) + load ,    δφ = D W δs ,

and z = δs − b δφ turns its derivative into a matrix of rank r more than A:

    z₁ = (A + c E W) z₀ ,   c = A b + b ,   E = (1 − D W b)⁻¹ D .

Steps are taken together in blocks, each a constant power of A and a small matrix.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import RIGID
from microslip_mechanics.excitation import Dwell
from microslip_mechanics.problem import Probes, Problem
from timedomain.integrate import MarchOptions, integrate
from timedomain.propagator import ModalStructure
from timedomain.relative_orbit import contact_tangents
from timedomain.start import Start

BLOCK = 16
"""steps that are taken together"""
TOLERANCE = 1e-12
"""of the march's contact forces"""
NUDGE = 1e-6
"""of the vibration, for derivatives by differences"""


@dataclass(frozen=True, slots=True)
class Period:
    """One period of a march, its beginning included."""

    displacement: Array
    """[m, rad], shape (steps + 1, dofs)"""
    velocity: Array
    """[m/s, rad/s], shape (steps + 1, dofs)"""
    friction: float
    """energy that friction took [J]"""


@dataclass(frozen=True, slots=True)
class PeriodMap:
    """A problem under a drive of one frequency, marched by equal steps over a period.

    A state is (q, q̇/ω) in mass-normalised modes, shape (2 modes,): its square is twice
    the kinetic energy over ω², plus the same of the displacement.
    """

    problem: Problem
    structure: ModalStructure
    frequency: float
    """[rad/s]"""
    steps: int
    """of the period, a multiple of :data:`BLOCK`"""

    @classmethod
    def of(cls, problem: Problem, frequency: float, steps: int) -> PeriodMap:
        """Return the map; ``steps`` is rounded up to whole blocks."""
        structure = ModalStructure.of(problem, frequency)
        whole = -(-steps // BLOCK) * BLOCK
        return cls(problem, replace(structure, scale=frequency), frequency, whole)

    def state(self, start: Start) -> Array:
        """Return a motion as a state."""
        to_modes = self.structure.inverse
        moving = to_modes @ start.velocity / self.frequency
        return np.concatenate([to_modes @ start.displacement, moving])

    def start(self, state: Array) -> Start:
        """Return a state as a motion."""
        shapes = self.structure.shapes
        moved, moving = np.split(state, 2)
        return Start(shapes @ moved, self.frequency * (shapes @ moving))

    def march(self, state: Array) -> Period:
        """March one period.

        Raises
        ------
        IntegrationError
            If a step does not converge.
        """
        dofs = self.problem.structure.dofs
        seen = Probes(tuple(str(place) for place in range(dofs)), np.eye(dofs))
        duration, start = 2.0 * np.pi / self.frequency, self.start(state)
        options = MarchOptions(
            duration / self.steps, 1, method="reference", residual=TOLERANCE
        )
        (history,) = integrate(
            replace(self.problem, probes=seen),
            Dwell(self.frequency, duration),
            options,
            start=start,
            block=duration,
        )
        return Period(
            np.vstack([start.displacement, history.displacement]),
            np.vstack([start.velocity, history.velocity]),
            float(history.of("friction")[-1]),
        )

    def monodromy(self, period: Period) -> Array:
        """Return the derivative of the state after a period by that before it.

        Returns
        -------
        Shape ``(2 modes, 2 modes)``.

        Notes
        -----
        With rigid friction, which has no tangents, it is that of differences.
        """
        if (self.problem.interface.points.friction == RIGID).any():
            return self._differences(period)
        free, push = self._step()
        seen = _seen(self.structure)
        tangents = self._tangents(period)
        answers = np.linalg.solve(
            np.eye(push.shape[1]) - tangents @ (seen @ push), tangents
        )
        carried = _product(free, push, seen, answers[:-1])
        whole: Array = np.eye(len(free))
        before = whole - push @ tangents[0] @ seen
        made: Array = (whole + push @ answers[-1] @ seen) @ carried @ before
        return made

    def _differences(self, period: Period) -> Array:
        """Return the derivative by marches from states nearby."""
        motions = np.hstack([period.displacement, period.velocity / self.frequency])
        to_modes = np.kron(np.eye(2), self.structure.inverse)
        nudge = NUDGE * float(np.linalg.norm(np.ptp(motions @ to_modes.T, axis=0)))
        start = self.state(Start(period.displacement[0], period.velocity[0]))
        ends = []
        for push in np.vstack([np.zeros(start.size), nudge * np.eye(start.size)]):
            near = self.march(start + push)
            ends.append(self.state(Start(near.displacement[-1], near.velocity[-1])))
        derivative: Array = (np.array(ends[1:]) - ends[0]).T / nudge
        return derivative

    def _step(self) -> tuple[Array, Array]:
        """Return A and b of one step, (2 modes, 2 modes) and (2 modes, rank)."""
        structure, modes = self.structure, self.structure.stiffness.size
        matrix = np.zeros((2 * modes, 2 * modes))
        matrix[:modes, modes:] = structure.scale * np.eye(modes)
        matrix[modes:, :modes] = -np.diag(structure.stiffness) / structure.scale
        matrix[modes:, modes:] = -structure.damping
        half = np.pi / (self.frequency * self.steps)
        force = np.zeros((2 * modes, structure.selection.shape[0]))
        force[modes:] = -half * structure.selection.T / structure.scale
        implicit = np.eye(2 * modes) - half * matrix
        explicit = np.eye(2 * modes) + half * matrix
        made = np.linalg.solve(implicit, np.hstack([explicit, force]))
        return made[:, : 2 * modes], made[:, 2 * modes :]

    def _tangents(self, period: Period) -> Array:
        """Return D at each time by (y, ẏ/ω), shape (steps + 1, rank, 2 rank)."""
        interface = self.problem.interface
        basis, _ = interface.relative_motion()
        moved, moving = (
            np.reshape(each @ interface.displacement.T, (len(each), interface.count, 3))
            for each in (period.displacement, period.velocity)
        )
        elastic, viscous = contact_tangents(interface.points, basis, moved, moving)
        return np.concatenate([elastic, self.frequency * viscous], axis=2)


def _seen(structure: ModalStructure) -> Array:
    """Return W, (y, ẏ/ω) from a state, shape (2 rank, 2 modes)."""
    return np.kron(np.eye(2), structure.selection)


def _product(free: Array, push: Array, seen: Array, answers: Array) -> Array:
    """Return the product of A + c E W over all steps, later ones on the left.

    ``answers`` holds E of each step, shape ``(steps, rank, 2 rank)``.
    """
    size, rank = push.shape
    count = len(answers) // BLOCK
    blocks = answers.reshape(count, BLOCK, rank, 2 * rank)
    powers = [np.eye(size)]
    for _ in range(BLOCK):
        powers.append(free @ powers[-1])
    kick = free @ push + push
    watched = np.stack([seen @ power for power in powers[:BLOCK]])
    kicked = np.hstack([power @ kick for power in powers[BLOCK - 1 :: -1]])
    coupled = np.zeros((BLOCK, 2 * rank, BLOCK, rank))
    for late in range(BLOCK):
        for early in range(late):
            coupled[late, :, early] = watched[late - 1 - early] @ kick
    lag = blocks @ coupled.reshape(BLOCK, 2 * rank, BLOCK * rank)
    drive = (blocks @ watched).reshape(count, BLOCK * rank, size)
    width = BLOCK * rank
    forces = np.linalg.solve(np.eye(width) - lag.reshape(count, width, width), drive)
    carried = powers[0]
    for force in forces:
        carried = powers[BLOCK] @ carried + kicked @ (force @ carried)
    return carried
