"""What contact forces look like half a period later (theory §6.1, §6.6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel

CLOSE = 1e-9
"""relative difference of what counts as equal"""


class Symmetry(NamedTuple):
    """What half a period later looks like; empty arrays without that symmetry."""

    partners: NDArray[np.int64]
    """row of the points that moves like this one did half a period before"""
    signs: Array
    """but for this sign; shape (3 points,) or (0,)"""
    entry_partners: NDArray[np.int64]
    """the same for the tangents, shape (entries,) or (0,)"""
    entry_signs: Array

    @property
    def holds(self) -> bool:
        """Whether there is one: half a period tells all."""
        return self.signs.size > 0

    @property
    def images(self) -> NDArray[np.int64]:
        """Point that moves like this one did half a period before, shape (points,)."""
        return self.partners[::3] // 3


def symmetry(
    points: ContactPoints,
    offset: Array,
    basis: Array,
    entries: NDArray[np.int64],
    odd: NDArray[np.bool_] | None,
) -> Symmetry:
    """Return which rows and tangents look like others half a period later.

    Odd coordinates change their sign then: a point moves like its mirror image did. No
    symmetry if some point has no mirror image of the same law among the points.

    Parameters
    ----------
    points, offset
        Contact table, and constant displacement of the points [m], (3 points,).
    basis
        Map from the coordinates to the points, shape ``(3 points, rank)``.
    entries
        (row, column, by velocity) of each tangent.
    odd
        Which coordinates have odd harmonics only; None without that symmetry.
    """
    mirrored = None if odd is None else _mirrored(points, offset, basis, odd)
    turned = None if mirrored is None else _turned(entries, mirrored[0])
    if mirrored is None or turned is None:
        return Symmetry(*(np.empty(0, kind) for kind in (int, float, int, float)))
    partners, signs = mirrored
    return Symmetry(
        partners, signs, turned, signs[entries[:, 0]] * signs[entries[:, 1]]
    )


def still_holds(symmetry: Symmetry, points: ContactPoints, offset: Array) -> bool:
    """Return whether each point still has the law of its image, if there was one."""
    if not symmetry.holds:
        return True
    laws, sizes = _laws(points, offset)
    return np.allclose(laws, laws[:, symmetry.images], rtol=0.0, atol=CLOSE * sizes)


def _mirrored(
    points: ContactPoints, offset: Array, basis: Array, odd: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], Array] | None:
    """Return partner and sign of each row; None if a point has no mirror image."""
    later = (basis * np.where(odd, -1.0, 1.0)).reshape(len(basis) // 3, 3, len(odd))
    faces = basis.reshape(later.shape)
    close = CLOSE * np.abs(basis).max(initial=0.0)
    laws, sizes = _laws(points, offset)
    partners, signs = np.empty(len(basis), dtype=int), np.empty(len(basis))
    for point, wanted in enumerate(later):
        sign = np.where((wanted * faces).sum(axis=2) < 0.0, -1.0, 1.0)
        sign[:, 0] = 1.0  # the normal law tells pressing from pulling
        away = np.abs(wanted - sign[..., None] * faces).max(axis=(1, 2), initial=0.0)
        alike = np.isclose(laws, laws[:, [point]], rtol=0.0, atol=CLOSE * sizes)
        images = (away <= close) & alike.all(axis=0)
        if not images.any():
            return None
        image = point if images[point] else int(images.argmax())
        rows = slice(3 * point, 3 * point + 3)
        partners[rows], signs[rows] = 3 * image + np.arange(3), sign[image]
    return partners, signs


def _turned(
    entries: NDArray[np.int64], partners: NDArray[np.int64]
) -> NDArray[np.int64] | None:
    """Return the partner of each tangent; None if one has none."""
    places = {tuple(entry): place for place, entry in enumerate(entries.tolist())}
    turned = [
        places.get((int(partners[row]), int(partners[column]), kind), -1)
        for row, column, kind in entries.tolist()
    ]
    return None if -1 in turned else np.array(turned, dtype=int)


def _laws(points: ContactPoints, offset: Array) -> tuple[Array, Array]:
    """Return the values of the points' laws, and their sizes, (values, points) each.

    Gaps count from where a point is without vibration.
    """
    laws = np.array([np.asarray(each, float) for each in points])
    sizes, shift = np.abs(laws), offset[::3]
    place = ContactPoints._fields.index("gap")
    laws[place] -= shift
    sizes[place] += np.abs(shift)
    return laws, sizes


@kernel
def mirror(rows: Array, partners: NDArray[np.int64], signs: Array) -> None:
    """Fill the second half of a period from the first, if there is a symmetry."""
    half = rows.shape[1] // 2
    if signs.size:
        for row in range(rows.shape[0]):
            for place in range(half):
                rows[row, half + place] = signs[row] * rows[partners[row], place]
