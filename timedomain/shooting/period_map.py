"""A period of the reference march as a map of states (theory §7.3).

The step of :mod:`timedomain.reference.newmark` is the trapezoidal rule on s = (u, u̇).
With φ the contact force at the old and at the new time it is
s₁ = A s₀ + b (φ₀ + φ₁) + load.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides, slides_of
from microslip_mechanics.contact.tangents import contact_tangents
from microslip_mechanics.floating import floating
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Probes, Problem
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start
from timedomain.shooting.modal_structure import ModalStructure

BLOCK = 16
"""steps that are taken together"""
TOLERANCE = 1e-12
"""of the march's contact forces"""


@dataclass(frozen=True, slots=True)
class Period:
    """One period of a march, its beginning included."""

    displacement: Array
    """[m, rad], shape (steps + 1, dofs)"""
    velocity: Array
    """[m/s, rad/s], shape (steps + 1, dofs)"""
    friction: float
    """energy that friction took [J]"""
    slides: Slides
    """what contacts remember"""


@dataclass(frozen=True, slots=True)
class PeriodMap:
    """A problem under a drive of one frequency, marched by equal steps over a period.

    A state is (q, q̇/ω) in mass-normalised modes: its square is twice the kinetic energy
    over ω², plus the same of the displacement. Behind it are the tractions of what
    remembers, over :attr:`unit`; the shape is (2 modes + sliders,).
    """

    problem: Problem
    structure: ModalStructure
    frequency: float
    """[rad/s]"""
    steps: int
    """of the period, a multiple of :data:`BLOCK`"""
    sliders: Sliders

    @classmethod
    def of(cls, problem: Problem, frequency: float, steps: int) -> PeriodMap:
        """Return the map; ``steps`` is rounded up to whole blocks."""
        structure, whole = ModalStructure.of(problem), -(-steps // BLOCK) * BLOCK
        basis, _ = problem.interface.relative_motion()
        points = problem.interface.points
        floats = floating(problem) if remembers(points).any() else None
        sliders = Sliders.of(points, basis, floats)
        return cls(problem, structure, frequency, whole, sliders)

    @property
    def length(self) -> float:
        """Length of a step [s]."""
        return 2.0 * np.pi / (self.frequency * self.steps)

    @property
    def unit(self) -> Array:
        """Traction [N] that counts as one unit of a state, shape (sliders,).

        Between the one that shakes its contact by that much and the one that bends its
        slider so far: what is larger would hide the other equations.
        """
        seen = self.sliders.along @ self.structure.selection
        shaking = self.frequency**2 / np.sqrt((seen**2).sum(axis=1))
        bending = self.sliders.stiffness * np.sqrt((seen**2).sum(axis=1))
        unit: Array = np.sqrt(shaking * np.maximum(shaking, bending))
        return unit

    @property
    def seen(self) -> Array:
        """W, (y, ẏ/ω) from a state, shape (2 rank, 2 modes)."""
        return np.kron(np.eye(2), self.structure.selection)

    def state(self, start: Start) -> Array:
        """Return a motion as a state."""
        to_modes = self.structure.inverse
        moving = to_modes @ start.velocity / self.frequency
        held = self.sliders.seen(start.traction) / self.unit
        return np.concatenate([to_modes @ start.displacement, moving, held])

    def start(self, state: Array) -> Start:
        """Return a state as a motion."""
        shapes = self.structure.shapes
        modes = self.structure.stiffness.size
        moved, moving, held = np.split(state, [modes, 2 * modes])
        return Start(
            shapes @ moved,
            self.frequency * (shapes @ moving),
            self.sliders.spread(self.unit * held),
        )

    def end(self, period: Period) -> Array:
        """Return the state after a period."""
        held = self.sliders.spread(period.slides.traction[-1])
        return self.state(Start(period.displacement[-1], period.velocity[-1], held))

    def settled(self, state: Array, period: Period) -> Array:
        """Return a state with the tractions that a period from it ends with."""
        first = state.size - self.sliders.count
        return np.append(state[:first], self.end(period)[first:])

    def gap(self, state: Array, period: Period) -> Array:
        """Return by how much a period from a state does not close.

        It is end less beginning; for a slider that never slips, whose traction returns
        wherever it begins, the part of its mean traction that can be taken off, but for
        what holds a body that nothing else does.
        """
        gap, slides = self.end(period) - state, period.slides
        held = gap[gap.size - self.sliders.count :]
        held[slides.stuck] = (slides.brink.shed / self.unit)[slides.stuck]
        return gap

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
        options = MarchOptions(self.length, 1, method="reference", residual=TOLERANCE)
        (history,) = integrate(
            replace(self.problem, probes=seen),
            Dwell(self.frequency, duration),
            options,
            start=start,
            block=duration,
        )
        displacement = np.vstack([start.displacement, history.displacement])
        velocity = np.vstack([start.velocity, history.velocity])
        first = self.sliders.seen(start.traction)
        slides = slides_of(
            self.sliders, *self.points(displacement, velocity), first, self.frequency
        )
        friction = float(history.of("friction")[-1])
        return Period(displacement, velocity, friction, slides)

    def step(self, forces: Array) -> tuple[Array, Array]:
        """Return A of one step, and what ``forces`` on modes do at either of its ends.

        They are of shape (2 modes, 2 modes) and (2 modes, forces), of (modes, forces).
        """
        structure, modes = self.structure, self.structure.stiffness.size
        matrix = np.zeros((2 * modes, 2 * modes))
        matrix[:modes, modes:] = self.frequency * np.eye(modes)
        matrix[modes:, :modes] = -np.diag(structure.stiffness) / self.frequency
        matrix[modes:, modes:] = -structure.damping
        half = np.pi / (self.frequency * self.steps)
        pushed = np.vstack([np.zeros_like(forces), half * forces / self.frequency])
        implicit = np.eye(2 * modes) - half * matrix
        explicit = np.eye(2 * modes) + half * matrix
        made = np.linalg.solve(implicit, np.hstack([explicit, pushed]))
        return made[:, : 2 * modes], made[:, 2 * modes :]

    def tangents(self, motion: tuple[Array, Array], step: float) -> Array:
        """Return D by (y, ẏ/ω), shape (times, rank, 2 rank), at the points' motion.

        Forces that jump are spread over a ``step`` [s], 0 if they are not.
        """
        points, basis = self.problem.interface.points, self.sliders.basis
        elastic, viscous = contact_tangents(points, basis, *motion, step)
        return np.concatenate([elastic, self.frequency * viscous], axis=2)

    def points(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """Return displacement and velocity of the points, (times, points, 3) each."""
        interface = self.problem.interface
        moved, moving = (
            np.reshape(each @ interface.displacement.T, (len(each), interface.count, 3))
            for each in (displacement, velocity)
        )
        return moved, moving
