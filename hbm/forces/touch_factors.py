"""The derivative of what cells see in which faces touch or part (theory §6.1).

Tangents at the samples tell what a cell does to its ends as if either moved alone. That
is good enough where they are small; where a stiff stop is struck for a few samples
Newton's iteration would creep.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.sampling import hat
from hbm.forces.touches import Touches, touches
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ONE_SIDED


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
    contact: AlternatingFrequencyTime, places: NDArray[np.int64]
) -> Factors | None:
    """Return what of ∂force/∂y tangents at the samples leave out of such cells.

    In the last call of ``contact``; None if there are none. ``places``, shape
    ``(2H + 1, rank)``, are those of the coefficients among the unknowns; negative ones
    are left out.
    """
    if not (contact.points.normal == ONE_SIDED).any():
        return None
    found = touches(contact.points, *contact.moved, contact.telling)
    if not found.place.size:
        return None
    if contact.symmetry.holds:
        # the other half, seen by coordinates that it mirrors, is the same again
        found = found._replace(shared=2.0 * found.shared)
    return _factors(found, contact.basis, contact.frequency, contact.samples, places)


def _factors(
    found: Touches,
    basis: Array,
    frequency: float,
    samples: int,
    places: NDArray[np.int64],
) -> Factors:
    """Return the same of the cells of a period."""
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
