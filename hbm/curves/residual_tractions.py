"""What other residual tractions would make of an amplitude (theory §6.5).

A slider that never slips may carry any mean traction within its limit: what came before
decides. Where normal loads follow that, amplitudes do. To first order the extremes of
an amplitude are those of a linear programme: the tractions of all such sliders vary,
and none may exceed its limit, which varies with them, at any time of the period.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import upright
from hbm.continuation.linearised import SingularError
from hbm.forces.fourier import derivative, waves
from hbm.forces.sampled_orbit import SampledOrbit
from hbm.stability.slide_events import even_slides
from microslip_mechanics.arrays import TINY, Array, largest
from microslip_mechanics.contact.points import ELASTIC, ContactPoints
from microslip_mechanics.contact.sliders import Sliders

STEPS, EACH = 256, 4
"""of the period, in which slips are looked for; limits are kept after so many each"""
DIRECTIONS = 16
"""of a traction along two tangents, in which its limit is kept"""
NONE = 1e-6
"""change of an amplitude, relative, that is none"""


def amplitude_range(balance: HarmonicBalance, point: Array, rows: Array) -> Array:
    """Return by how much amplitudes may be lower and higher [m], shape (2, probes).

    Parameters
    ----------
    balance
        That is solved at ``point``, of shape ``(size,)``.
    rows
        Probes of the motion, shape ``(probes, dofs)``.

    Returns
    -------
    Zero where all tractions are determined, infinite where their limits do not bound
    them or the curve turns; of shape ``(0, probes)`` if no load follows a traction.
    """
    if not may_vary(balance.contact.points):
        return np.zeros((0, len(rows)))
    _, linearised = balance(point)
    stuck = _Stuck.of(balance, float(point[-1]))
    if not stuck.along.size:
        return np.zeros((2, len(rows)))
    pulled = np.zeros((point.size, len(stuck.along)))
    pulled[: balance.rank] = -stuck.along.T
    try:
        changes = linearised.solve(upright(point), pulled)
    except SingularError:
        return np.outer([-np.inf, np.inf], np.ones(len(rows)))
    amplitude, slopes = _slopes(balance, point, changes, rows)
    bounds = stuck.bounds(changes[:-1].reshape(-1, balance.rank, len(stuck.along)))
    found = np.zeros((2, len(rows)))
    most = 2.0 * np.abs(slopes) @ stuck.limit.max(axis=0)
    for probe in np.flatnonzero(most > NONE * amplitude):
        slope = slopes[probe]
        found[:, probe] = -_most(-slope, *bounds), _most(slope, *bounds)
    return found


def may_vary(points: ContactPoints) -> bool:
    """Return whether a load may follow what a stuck slider carries in the mean."""
    return bool((points.friction == ELASTIC).any() and not points.constant_load.all())


@dataclass(frozen=True, slots=True)
class _Stuck:
    """Sliders that never slip in an orbit, at some times of the period."""

    sliders: Sliders
    places: NDArray[np.int64]
    """which of all they are, shape (stuck,)"""
    frequency: float
    traction: Array
    """[N], shape (times, stuck)"""
    limit: Array
    """[N], shape (times, stuck)"""
    load: Array
    """by depth and by approach, shape (times, stuck, 2)"""

    @classmethod
    def of(cls, balance: HarmonicBalance, frequency: float) -> _Stuck:
        """Return those of the orbit at which the contacts were just called."""
        contact = balance.contact
        sliders = Sliders.of(contact.points, balance.problem.basis, contact.floating)
        orbit = SampledOrbit.of(contact, frequency)
        slides = even_slides(sliders, orbit, STEPS).slides
        places = np.flatnonzero(slides.stuck)
        return cls(
            sliders,
            places,
            frequency,
            slides.traction[:-1:EACH, places],
            slides.limit[:-1:EACH, places],
            slides.load[:-1:EACH, sliders.point[places]],
        )

    @property
    def along(self) -> Array:
        """Displacement of each from the coordinates, shape (stuck, rank)."""
        return self.sliders.along[self.places]

    def bounds(self, changes: Array) -> tuple[Array, Array]:
        """Return the limits of tractions as matrix · change ≤ room.

        ``changes`` are coefficients of y by each mean traction, shape
        ``(2H + 1, rank, stuck)``. The matrix has shape ``(conditions, stuck)``.
        """
        traction, limit = self._changes(changes)
        matrices, rooms = [], []
        points = self.sliders.point[self.places]
        for point in np.unique(points):
            own = np.flatnonzero(points == point)
            for way in _directions(own.size):
                outward = np.einsum("a,tas->ts", way, traction[:, own])
                matrices.append(outward - limit[:, own[0]])
                rooms.append(self.limit[:, own[0]] - self.traction[:, own] @ way)
        return np.vstack(matrices), np.maximum(np.concatenate(rooms), 0.0)

    def _changes(self, changes: Array) -> tuple[Array, Array]:
        """Return what mean tractions change of tractions and limits.

        Each has shape ``(times, stuck, stuck)``, the last axis being that of the cause.
        """
        own, table = self.places, self.sliders.points
        points = self.sliders.point[own]
        there, _ = waves(len(changes) // 2, len(self.limit))
        moved, turned = (
            np.tensordot(there, each, axes=(0, 0))
            for each in (changes, derivative(changes))
        )
        traction = self.sliders.stiffness[own, None] * (self.along @ moved)
        traction -= self.sliders.stiffness[own, None] * (self.along @ changes[0])
        traction += self.sliders.bending[own] @ changes[0] + np.eye(own.size)
        normal = self.sliders.basis[3 * points]
        limit = self.load[:, :, :1] * (normal @ moved)
        limit += self.load[:, :, 1:] * (normal @ (self.frequency * turned))
        return traction, table.dynamic[points, None] * limit


def _directions(axes: int) -> Array:
    """Return unit vectors in all directions of a traction, (directions, axes)."""
    if axes == 1:
        return np.array([[-1.0], [1.0]])
    angles = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _slopes(
    balance: HarmonicBalance, point: Array, changes: Array, rows: Array
) -> tuple[Array, Array]:
    """Return amplitudes of probes and their derivatives, (probes, causes)."""
    here = balance.motion(point)[1:3] @ rows.T
    amplitude = np.hypot(*here)
    moved = [balance.motion(point + each)[1:3] @ rows.T - here for each in changes.T]
    slopes: Array = np.einsum("cp,scp->ps", here, np.array(moved))
    slopes /= np.maximum(amplitude, TINY)[:, None]
    return amplitude, slopes


def _most(slope: Array, matrix: Array, room: Array) -> float:
    """Return the largest slope · change within limits; infinite if there is no end."""
    from scipy.optimize import linprog  # slow to load, and hardly a scene needs it

    unit, size = largest(room), largest(slope)
    if unit == 0.0 or size == 0.0:
        return 0.0
    found = linprog(-slope / size, matrix, room / unit, bounds=(None, None))
    if found.x is None:
        return np.inf
    return float(slope @ found.x) * unit
