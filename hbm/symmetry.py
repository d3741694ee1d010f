"""What contact forces look like half a period later (theory §6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel


class Symmetry(NamedTuple):
    """What half a period later looks like; empty arrays without that symmetry."""

    partners: NDArray[np.int64]
    """row of the points that moves like this one did half a period before"""
    signs: Array
    """but for this sign; shape (3 points,) or (0,)"""
    entry_partners: NDArray[np.int64]
    """the same for the tangents, shape (entries,) or (0,)"""
    entry_signs: Array


def symmetry(
    basis: Array, entries: NDArray[np.int64], odd: NDArray[np.bool_] | None
) -> Symmetry:
    """Return which rows and tangents look like others half a period later.

    Odd coordinates change their sign then: a point moves like its mirror image did. No
    symmetry if some point has no mirror image among the points.
    """
    none = Symmetry(*(np.empty(0, kind) for kind in (int, float, int, float)))
    if odd is None:
        return none
    later = (basis * np.where(odd, -1.0, 1.0)).reshape(len(basis) // 3, 3, len(odd))
    faces = basis.reshape(later.shape)
    close = 1e-9 * np.abs(basis).max(initial=0.0)
    partners, signs = np.empty(len(basis), dtype=int), np.empty(len(basis))
    for point, wanted in enumerate(later):
        sign = np.where((wanted * faces).sum(axis=2) < 0.0, -1.0, 1.0)
        sign[:, 0] = 1.0  # the normal law tells pressing from pulling
        away = np.abs(wanted - sign[..., None] * faces).max(axis=(1, 2), initial=0.0)
        if not (away <= close).any():
            return none
        image, rows = int((away <= close).argmax()), slice(3 * point, 3 * point + 3)
        partners[rows], signs[rows] = 3 * image + np.arange(3), sign[image]
    places = {tuple(entry): place for place, entry in enumerate(entries.tolist())}
    turned = [
        places.get((int(partners[row]), int(partners[column]), kind), -1)
        for row, column, kind in entries.tolist()
    ]
    if -1 in turned:
        return none
    return Symmetry(
        partners,
        signs,
        np.array(turned, dtype=int),
        signs[entries[:, 0]] * signs[entries[:, 1]],
    )


@kernel
def mirror(rows: Array, partners: NDArray[np.int64], signs: Array) -> None:
    """Fill the second half of a period from the first, if there is a symmetry."""
    half = rows.shape[1] // 2
    if signs.size:
        for row in range(rows.shape[0]):
            for place in range(half):
                rows[row, half + place] = signs[row] * rows[partners[row], place]
