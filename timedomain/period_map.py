"""A period of the reference march, and the exact derivative of what it does to a state.

The step of :mod:`timedomain.newmark` is the trapezoidal rule on s = (u, u̇). With φ the
contact force, of tangents D at the new and at the old time,

    s₁ = A s₀ + b (φ₀ + φ₁) + load ,    δφ = D W δs ,

and z = δs − b δφ turns its derivative into a matrix of rank r more than A:

    z₁ = (A + c E W) z₀ ,   c = A b + b ,   E = (1 − D W b)⁻¹ D .

Steps are taken together in blocks, each a constant power of A and a small matrix. With
friction that remembers the tractions are part of the state, and steps are taken one by
one (:mod:`timedomain.carried`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import RIGID
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides, slides_of
from microslip_mechanics.contact.tangents import contact_tangents
from microslip_mechanics.excitation import Dwell
from microslip_mechanics.problem import Probes, Problem
from timedomain.carried import carried
from timedomain.integrate import MarchOptions, integrate
from timedomain.modal_structure import ModalStructure
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
    slides: Slides
    """what contacts remember"""


class Sensitivity(NamedTuple):
    """Derivatives by the state before a period."""

    monodromy: Array
    """of the state after it, shape (states, states)"""
    mean: Array
    """of the mean tractions over it, in units of states, shape (sliders, states)"""


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
        structure = ModalStructure.of(problem, frequency)
        whole = -(-steps // BLOCK) * BLOCK
        structure = replace(structure, scale=frequency)
        basis, _ = problem.interface.relative_motion()
        sliders = Sliders.of(problem.interface.points, basis)
        return cls(problem, structure, frequency, whole, sliders)

    @property
    def unit(self) -> Array:
        """Traction [N] that shakes its contact by one unit of a state, (sliders,)."""
        seen = self.sliders.along @ self.structure.selection
        unit: Array = self.frequency**2 / np.sqrt((seen**2).sum(axis=1))
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
        wherever it begins, the part of its mean traction that can be taken off.
        """
        gap, slides = self.end(period) - state, period.slides
        held = gap[gap.size - self.sliders.count :]
        held[slides.stuck] = (slides.mean / self.unit)[slides.stuck]
        return gap

    def slope(self, period: Period, sensitivity: Sensitivity) -> Array:
        """Return the derivative of minus the gap by the state, (states, states)."""
        slope = np.eye(len(sensitivity.monodromy)) - sensitivity.monodromy
        held = slope[len(slope) - self.sliders.count :]
        stuck = period.slides.stuck
        held[stuck] = -sensitivity.mean[stuck]
        return slope

    def loose(self, monodromy: Array, stuck: NDArray[np.bool_]) -> Array:
        """Return the derivative of what is left if some sliders are springs.

        A slider that never slips keeps T − k_t w: that is a multiplier of exactly one,
        which says nothing but that its position is free.
        """
        sliders, size = self.sliders, len(monodromy)
        first = size - sliders.count
        made = np.eye(size)
        seen = sliders.along @ self.structure.selection
        springs = (sliders.stiffness / self.unit)[:, None] * seen
        made[first:][stuck, : first // 2] = springs[stuck]
        kept = np.append(np.ones(first, dtype=bool), ~stuck)
        found: Array = (monodromy @ made[:, kept])[kept]
        return found

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
        displacement = np.vstack([start.displacement, history.displacement])
        velocity = np.vstack([start.velocity, history.velocity])
        first = self.sliders.seen(start.traction)
        slides = slides_of(
            self.sliders, *self.points(displacement, velocity), first, self.frequency
        )
        friction = float(history.of("friction")[-1])
        return Period(displacement, velocity, friction, slides)

    def sensitivity(self, period: Period) -> Sensitivity:
        """Return the exact derivatives of what a march does by the state before it."""
        if self.sliders.count == 0:
            whole = self._monodromy(period)
            return Sensitivity(whole, np.zeros((0, len(whole))))
        return self._carried(period, period.slides)

    def monodromy(self, period: Period) -> Array:
        """Return the derivative of the motion: small motions grow by it in a period.

        It is that of the march but where contacts that remember touch: a march jumps
        from one step to the next as they do so, a motion does not.
        """
        if self.sliders.count == 0:
            return self._monodromy(period)
        slides = slides_of(
            self.sliders,
            *self.points(period.displacement, period.velocity),
            period.slides.traction[0],
            self.frequency,
            continuous=True,
        )
        return self._carried(period, slides).monodromy

    def _carried(self, period: Period, slides: Slides) -> Sensitivity:
        free, push = self.step(-self.structure.selection.T)
        units = np.append(np.ones(len(free)), self.unit)
        tangents = self.tangents(*self.points(period.displacement, period.velocity))
        monodromy, mean = carried(free, push, self.seen, tangents, self.sliders, slides)
        monodromy = monodromy * units / units[:, None]
        return Sensitivity(monodromy, mean * units / self.unit[:, None])

    def _monodromy(self, period: Period) -> Array:
        """Return the derivative of the state after a period without memory.

        With rigid friction, which has no tangents, it is that of differences.
        """
        if (self.problem.interface.points.friction == RIGID).any():
            return self._differences(period)
        free, push = self.step(-self.structure.selection.T)
        seen = self.seen
        tangents = self.tangents(*self.points(period.displacement, period.velocity))
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

    def step(self, forces: Array) -> tuple[Array, Array]:
        """Return A of one step, and what ``forces`` on modes do at either of its ends.

        They are of shape (2 modes, 2 modes) and (2 modes, forces), of (modes, forces).
        """
        structure, modes = self.structure, self.structure.stiffness.size
        matrix = np.zeros((2 * modes, 2 * modes))
        matrix[:modes, modes:] = structure.scale * np.eye(modes)
        matrix[modes:, :modes] = -np.diag(structure.stiffness) / structure.scale
        matrix[modes:, modes:] = -structure.damping
        half = np.pi / (self.frequency * self.steps)
        pushed = np.vstack([np.zeros_like(forces), half * forces / structure.scale])
        implicit = np.eye(2 * modes) - half * matrix
        explicit = np.eye(2 * modes) + half * matrix
        made = np.linalg.solve(implicit, np.hstack([explicit, pushed]))
        return made[:, : 2 * modes], made[:, 2 * modes :]

    def tangents(self, displacement: Array, velocity: Array) -> Array:
        """Return D by (y, ẏ/ω), shape (times, rank, 2 rank), at the points' motion."""
        elastic, viscous = contact_tangents(
            self.problem.interface.points, self.sliders.basis, displacement, velocity
        )
        return np.concatenate([elastic, self.frequency * viscous], axis=2)

    def points(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """Return displacement and velocity of the points, (times, points, 3) each."""
        interface = self.problem.interface
        moved, moving = (
            np.reshape(each @ interface.displacement.T, (len(each), interface.count, 3))
            for each in (displacement, velocity)
        )
        return moved, moving


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
