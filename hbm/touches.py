"""The derivative of what cells see in which faces touch or part (theory §6).

Tangents at the samples tell what a cell does to its ends as if either moved alone. That
is good enough where they are small; where a stiff stop is struck for a few samples
Newton's iteration would creep.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.cell import Work, write_motion
from hbm.refinement import node
from hbm.sampling import hat
from hbm.transitions import EVENTS, locate, steepness
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.jit import inner_kernel, kernel


class Touches(NamedTuple):
    """Cells in which a point touches or lifts off."""

    point: NDArray[np.int64]
    """shape (cells,)"""
    place: NDArray[np.int64]
    """the sample before, shape (cells,)"""
    shared: Array
    """∂force/∂displacement and ∂force/∂velocity, of the force on either end by the
    motion of either end; shape ``(cells, 2, 2 forces, 2 motions, 3, 3)``"""


class Factors(NamedTuple):
    """Two matrices, shape ``(unknowns, columns)``, whose product is a derivative."""

    left: Array
    right: Array

    @property
    def matrix(self) -> Array:
        """The derivative, shape ``(unknowns, unknowns)``."""
        return self.left @ self.right.T

    def product(self, change: Array) -> Array:
        """Return it times a vector, shape ``(unknowns,)``."""
        return self.left @ (self.right.T @ change)

    def up_to(self, unknowns: int) -> Factors:
        """Return those of the first unknowns alone."""
        return Factors(self.left[:unknowns], self.right[:unknowns])


def touch_factors(
    found: Touches,
    basis: Array,
    frequency: float,
    samples: int,
    places: NDArray[np.int64],
) -> Factors:
    """Return what of ∂force/∂y tangents at the samples leave out of these cells.

    Parameters
    ----------
    found
        The cells of a period.
    basis
        Map from the coordinates y to the points, shape ``(3 points, rank)``.
    frequency
        [rad/s].
    samples
        Per period.
    places
        Of the coefficients among the unknowns, ``(2H + 1, rank)``; negative ones are
        left out.
    """
    term, coordinate = np.nonzero(places >= 0)
    orders = (np.arange(len(places)) + 1) // 2
    fading = hat(len(places) // 2, samples)
    left, right = [], []
    for point, place, shared in zip(*found, strict=True):
        phase = 2.0 * np.pi / samples * np.multiply.outer((place, place + 1), orders)
        motion = _waves(phase), frequency * orders * _waves(phase + 0.5 * np.pi)
        analysis = motion[0] * np.where(orders, 2.0, 1.0) / samples
        faces = basis[3 * point : 3 * point + 3]
        moves = faces.any(axis=1)
        alone = np.zeros_like(shared)
        for end in (0, 1):
            alone[:, end, end] = -shared[:, :, end].sum(axis=1)
        for series, tangents in ((analysis / fading, shared), (analysis, alone)):
            # what acts on an end (e) by the motion of an end (m), of both kinds (k)
            seen = np.einsum(
                "kemij,kmt,jr->eitr", tangents[..., moves, :], np.stack(motion), faces
            )
            acts = np.einsum("et,ir->eitr", series, faces[moves])
            left.append(acts[:, :, term, coordinate].reshape(-1, term.size))
            right.append(seen[:, :, term, coordinate].reshape(-1, term.size))
    return Factors(np.vstack(left).T, np.vstack(right).T)


def _waves(phase: Array) -> Array:
    """Return 1, cos θ, sin θ, cos 2θ, …; ``phase`` is that of each, last axis."""
    waves = np.cos(phase)
    waves[..., 2::2] = np.sin(phase[..., 2::2])
    return waves


def touches(
    points: ContactPoints, displacement: Array, velocity: Array, seen: int
) -> Touches:
    """Return the cells in which a point touches or lifts off, of the first ``seen``.

    ``displacement`` and ``velocity`` are those of the points at the samples, shape
    ``(3 points, samples)``.
    """
    point, place = _cells(points, displacement, seen)
    shared = np.zeros((point.size, 2, 2, 2, 3, 3))
    _share(points, displacement, velocity, point, place, shared)
    return Touches(point, place, shared)


@kernel
def _cells(
    points: ContactPoints, displacement: Array, seen: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return points and samples of these cells."""
    room = points.load.size * seen
    found = np.empty((2, room), dtype=np.int64)
    count = int(0.0)  # kernels are compiled anew for a literal
    for point in range(points.load.size):
        for place in range(seen):
            if _touches(points, point, displacement, place):
                found[0, count], found[1, count] = point, place
                count += 1
    return found[0, :count].copy(), found[1, :count].copy()


@kernel
def _share(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    point: NDArray[np.int64],
    place: NDArray[np.int64],
    shared: Array,
) -> None:
    """Write what :class:`Touches` has of the cells."""
    events = np.zeros(EVENTS + 2)
    work = Work(
        np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    )
    for cell in range(point.size):
        _fill(
            points, point[cell], displacement, velocity, place[cell], work, events,
            shared[cell],
        )  # fmt: skip


@inner_kernel
def _after(displacement: Array, place: int) -> int:
    """Return the sample at the other end of a cell."""
    return place + 1 if place + 1 < displacement.shape[1] else 0


@inner_kernel
def _touches(
    points: ContactPoints, point: int, displacement: Array, place: int
) -> bool:
    """Return whether a point touches or lifts off in a cell, but for steep edges."""
    if points.normal[point] != ONE_SIDED or steepness(points, point) > 1:
        return False
    row, touch = 3 * point, edge(points, point)
    after = _after(displacement, place)
    return bool(
        (displacement[row, place] > touch) != (displacement[row, after] > touch)
    )


@inner_kernel
def _fill(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    work: Work,
    events: Array,
    shared: Array,
) -> None:
    """Add up the tangents of a cell, as :func:`~hbm.refinement.refine` its forces."""
    after = _after(displacement, place)
    found = locate(points, point, displacement, velocity, place, after, events)
    for piece in range(-2, 3 * (found + 1)):
        share, weight = piece + 2.0, 0.0
        if piece >= 0:
            share, weight = node(events[: found + 2], piece, 3, 0.0, 1.0, 1)
        write_motion(point, displacement, velocity, place, after, share, work)
        contact_force(
            points, point, work.moved, work.moving, work.force,
            work.by_displacement, work.by_velocity,
        )  # fmt: skip
        for end in range(2):
            for by in range(2):
                near, sees = abs(1.0 - end - share), abs(1.0 - by - share)
                part = weight * near * sees
                if piece < 0:
                    # the trapezoidal rule is taken back
                    part = -(1.0 + near) / 6.0 * sees
                for row in range(3):
                    for column in range(3):
                        tangent = work.by_displacement[row, column]
                        shared[0, end, by, row, column] += part * tangent
                        tangent = work.by_velocity[row, column]
                        shared[1, end, by, row, column] += part * tangent
