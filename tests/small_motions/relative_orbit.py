"""What the contacts see along a periodic response: their tangents and regimes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge, regularised
from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.tangents import contact_tangents
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)
"""of the mean over a step, on −1 … 1"""


@dataclass(frozen=True, slots=True)
class RelativeOrbit:
    """A periodic response as the contact points see it."""

    points: ContactPoints
    basis: Array
    """relative displacements of the points from the coordinates, (3 points, rank)"""
    motion: PeriodicResponse
    """of the points in place of the degrees of freedom"""

    @classmethod
    def of(cls, problem: Problem, response: PeriodicResponse) -> RelativeOrbit:
        """Return the relative motion of a response of the whole structure.

        Raises
        ------
        ValueError
            If what a contact carries does not follow from the motion at a moment.
        """
        interface = problem.interface
        if beyond_motion(interface.points):
            raise ValueError(
                "a contact remembers or is rigid: small motions about the orbit are "
                "not those of a linear equation in the motion alone"
            )
        basis, _ = interface.relative_motion()
        seen = response.seen(interface.displacement)
        motion = replace(response, coefficients=seen, shapes=None)
        return cls(interface.points, basis, motion)

    def tangents(self, phase: Array) -> tuple[Array, Array]:
        """Return contact stiffness K_c and damping C_c on the relative coordinates.

        Parameters
        ----------
        phase
            ωt [rad], shape ``(phases,)``.

        Returns
        -------
        stiffness, damping
            ∂φ/∂y [N/m] and ∂φ/∂ẏ [N s/m], each of shape ``(phases, rank, rank)``.
        """
        return contact_tangents(self.points, self.basis, *self._seen(phase))

    def mean_tangents(
        self, begin: float, length: float, steps: int
    ) -> tuple[Array, Array]:
        """Return the tangents' means over equal steps, each (steps, rank, rank).

        The means are symmetric in time, and see the 1/√t of normal damping at both ends
        of a step, where a contact may close or open.

        Parameters
        ----------
        begin, length
            Phase of the first step and of one step [rad].
        steps
            How many.
        """
        place = 0.5 * (1.0 + NODES)
        weight = 3.0 * WEIGHTS * place * (1.0 - place)
        inside = place**2 * (3.0 - 2.0 * place)
        phase = begin + length * np.add.outer(inside, np.arange(steps))
        stiffness, damping = (
            np.tensordot(weight, each.reshape(*phase.shape, *each.shape[1:]), axes=1)
            for each in self.tangents(phase.ravel())
        )
        return stiffness, damping

    def regimes(self, phase: Array) -> NDArray[np.int64]:
        """Return which branch of its law each point is on, shape (phases, points).

        Tangents may jump where this number changes.
        """
        found = np.zeros((phase.size, self.points.load.size), dtype=np.int64)
        _regimes(self.points, *self._seen(phase), found)
        return found

    def samples(self, *, smallest: int, largest: int) -> int:
        """Return how many samples of a period see every turn of a sliding.

        At the largest sliding acceleration the velocity takes two samples and more
        from zero to the threshold.
        """
        if self.points.load.size == 0:
            return smallest
        phase = 2.0 * np.pi * np.arange(smallest) / smallest
        _, velocity = self._seen(phase)
        change = np.abs(np.diff(velocity, axis=0, append=velocity[:1]))[:, :, 1:]
        share = float((2.0 * change.max(axis=(0, 2)) / self.points.threshold).max())
        return int(np.clip(smallest * share, smallest, largest))

    def _seen(self, phase: Array) -> tuple[Array, Array]:
        displacement, velocity = self.motion.at(phase)
        shape = (phase.size, self.points.load.size, 3)
        return displacement.reshape(shape), velocity.reshape(shape)


@kernel
def _regimes(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    found: NDArray[np.int64],
) -> None:
    force, stiff, viscous = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    for phase in range(displacement.shape[0]):
        for point in range(displacement.shape[1]):
            gap, slip = displacement[phase, point], velocity[phase, point]
            contact_force(points, point, gap, slip, force, stiff, viscous)
            touches, pushes = gap[0] > edge(points, point), force[0] > 0.0
            loaded = points.constant_load[point] or pushes
            slides = (loaded and regularised(points, point)) and np.hypot(
                slip[1], slip[2]
            ) > points.threshold[point]
            found[phase, point] = 1 * touches + 2 * pushes + 4 * slides
