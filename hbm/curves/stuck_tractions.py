"""What sliders carry that never slip, and what else limits allow (theory §6.5)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.balance.residual import HarmonicBalance
from hbm.forces.fourier import derivative, waves
from hbm.forces.sampled_orbit import SampledOrbit
from hbm.stability.slide_events import even_slides
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.contact.sliders import Sliders

STEPS, EACH = 256, 4
"""of the period, in which slips are looked for; in so many each the limit is kept"""
STEADY = 1e-9
"""relative change over the period of what counts as constant: one time tells all"""
DIRECTIONS = 16
"""of a traction along two tangents, in which its limit is kept"""


class Effects(NamedTuple):
    """What mean tractions change, at some of the times.

    Each has shape ``(times / EACH, stuck, stuck)``, the last axis being that of the
    cause.
    """

    traction: Array
    limit: Array

    @property
    def reliefs(self) -> Array:
        """What they change of mean limits, shape (stuck, stuck)."""
        mean: Array = self.limit.mean(axis=0)
        return mean


@dataclass(frozen=True, slots=True)
class StuckTractions:
    """What sliders carry that never slip, at some times of the period."""

    sliders: Sliders
    places: NDArray[np.int64]
    """which of all they are, shape (stuck,)"""
    frequency: float
    traction: Array
    """[N], shape (times, stuck)"""
    limit: Array
    """[N], shape (times, stuck)"""
    load: Array
    """by depth and by approach at some of the times, (times / EACH, stuck, 2)"""
    own: Array
    """mean traction but for that by how far bodies have moved [N], shape (stuck,)"""

    @classmethod
    def of(cls, balance: HarmonicBalance, frequency: float) -> StuckTractions:
        """Return those of the orbit at which the contacts were just called."""
        contact = balance.contact
        sliders = Sliders.of(contact.points, balance.problem.basis, contact.floating)
        orbit = SampledOrbit.of(contact, frequency)
        slides = even_slides(sliders, orbit, STEPS).slides
        places = np.flatnonzero(slides.stuck)
        moved = sliders
        if contact.floating is not None:
            moved = replace(sliders, floating=replace(contact.floating, bent=0.0))
        mean = orbit.spectrum[0].real.reshape(-1, 3)
        own = slides.traction[:-1].mean(axis=0) - moved.seen(moved.bent(mean))
        return cls(
            sliders,
            places,
            frequency,
            slides.traction[:-1, places],
            slides.limit[:-1, places],
            slides.load[:-1:EACH, sliders.point[places]],
            own[places],
        )

    @property
    def rank(self) -> int:
        """Number of coordinates."""
        return int(self.sliders.basis.shape[1])

    @property
    def along(self) -> Array:
        """Displacement of each from the coordinates, shape (stuck, rank)."""
        return self.sliders.along[self.places]

    def bent(self, change: Array) -> Array:
        """Return by how much sliders are bent in the mean [m], shape (points, 3).

        ``change`` is that of the mean tractions of these [N], shape ``(stuck,)``; what
        slips has no say.
        """
        made = np.zeros((self.sliders.points.load.size, 3))
        made[self._entries] = (self.own + change) / self._stiffness
        return made

    def slipped(self, bent: Array | None) -> Array:
        """Return what slips have made of mean tractions [N], shape (stuck,).

        ``bent`` is how sliders were when the orbit began.
        """
        if bent is None:
            return self.own
        return self.own - self._stiffness * bent[self._entries]

    @property
    def _entries(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Where each is in a table of shape (points, 3)."""
        point, axis = self.sliders.point[self.places], self.sliders.axis[self.places]
        return point, 1 + axis

    @property
    def _stiffness(self) -> Array:
        """k_t [N/m], shape (stuck,)."""
        return self.sliders.stiffness[self.places]

    @property
    def spare(self) -> Array:
        """What each limit may lose at all times before the slider slips [N], (stuck,).

        Whatever mean traction it carries then.
        """
        one, other = (
            (self.limit - side * self.traction).min(axis=0) for side in (-1.0, 1.0)
        )
        spare: Array = 0.5 * (one + other)
        return spare

    def bounds(self, effects: Effects, loose: int | None = None) -> tuple[Array, Array]:
        """Return the limits of tractions as matrix · change ≤ room.

        The matrix has shape ``(conditions, stuck)``. ``loose`` is one of these whose
        point may slip.
        """
        traction, limit = effects
        matrices, rooms = [np.zeros((0, len(self.places)))], [np.zeros(0)]
        points = self.sliders.point[self.places]
        held = points if loose is None else points[points != points[loose]]
        for point in np.unique(held):
            own = np.flatnonzero(points == point)
            for way in _directions(own.size):
                outward = np.einsum("a,tas->ts", way, traction[:, own])
                outward -= limit[:, own[0]]
                room = self.limit[:, own[0]] - self.traction[:, own] @ way
                room = room.reshape(-1, EACH).min(axis=1)
                steady = np.ptp(outward, axis=0).max() <= STEADY * largest(outward)
                matrices.append(outward[:1] if steady else outward)
                rooms.append(room.min(keepdims=True) if steady else room)
        return np.vstack(matrices), np.maximum(np.concatenate(rooms), 0.0)

    def effects(self, changes: Array) -> Effects:
        """Return what mean tractions change.

        ``changes`` are those of coefficients of y by each, ``(2H + 1, rank, stuck)``.
        """
        own, table = self.places, self.sliders.points
        points = self.sliders.point[own]
        there, _ = waves(len(changes) // 2, len(self.load))
        moved, turned = (
            np.tensordot(there, each, axes=(0, 0))
            for each in (changes, derivative(changes))
        )
        traction = self._stiffness[:, None] * (self.along @ moved)
        traction -= self._stiffness[:, None] * (self.along @ changes[0])
        traction += self.sliders.bending[own] @ changes[0] + np.eye(own.size)
        normal = self.sliders.basis[3 * points]
        limit = self.load[:, :, :1] * (normal @ moved)
        limit += self.load[:, :, 1:] * (normal @ (self.frequency * turned))
        return Effects(traction, table.dynamic[points, None] * limit)


def _directions(axes: int) -> Array:
    """Return unit vectors in all directions of a traction, (directions, axes)."""
    if axes == 1:
        return np.array([[-1.0], [1.0]])
    angles = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)
