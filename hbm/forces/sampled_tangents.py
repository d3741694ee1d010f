"""Contact tangents at the samples of a period, and their Fourier series (§6.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import Transform
from hbm.forces.symmetry import Symmetry, mirror
from hbm.forces.tangent_entries import mixing
from hbm.forces.tangent_product import TangentProduct
from microslip_mechanics.arrays import Array


class SampledTangents:
    """Buffers of one period, valid until the next call that writes them."""

    def __init__(
        self,
        basis: Array,
        entries: NDArray[np.int64],
        symmetry: Symmetry,
        signs: Array,
        samples: int,
    ) -> None:
        """Make room for the tangents of points, and for those of y if they are fewer.

        Parameters
        ----------
        basis
            Map from the coordinates y to the points, shape ``(3 points, rank)``.
        entries
            (row, column, by velocity) of each tangent, ordered by points.
        symmetry, signs
            Of half a period, and by which signs coordinates differ after it, (rank,);
            both empty if all samples are needed.
        samples
            Per period.
        """
        self.entries = entries
        self.bounds = np.searchsorted(entries[:, 0], np.arange(0, len(basis) + 1, 3))
        self._symmetry, self._signs, self._rank = symmetry, signs, basis.shape[1]
        self._half = samples // 2 if signs.size else samples
        self._mixing = mixing(basis, entries)
        self._of_points = Transform(len(entries), samples)
        few = len(self._mixing) < len(entries)
        self._of_coordinates = Transform(len(self._mixing), samples) if few else None

    @property
    def samples(self) -> Array:
        """Where they are written, shape (entries, samples).

        With a symmetry those of the first half of the period are enough.
        """
        return self._of_points.samples

    def spectra(self, harmonics: int) -> tuple[Array, Array]:
        """Return the series of ∂force/∂y and ∂force/∂ẏ, a₀, a₁, b₁, ….

        Each has shape ``(rank, rank, 2 harmonics + 1)``.
        """
        if self._of_coordinates is None:
            symmetry = self._symmetry
            mirror(self.samples, symmetry.entry_partners, symmetry.entry_signs)
            series = np.dot(self._mixing, self._of_points.analysis(harmonics).T)
        else:
            self._mix(self._of_coordinates.samples)
            series = self._of_coordinates.analysis(harmonics).T.copy()
        shape = 2, self._rank, self._rank, 2 * harmonics + 1
        elastic, viscous = series.reshape(shape)
        return elastic, viscous

    def means(self) -> tuple[Array, Array]:
        """Return the means of ∂force/∂y and ∂force/∂ẏ, shape (rank, rank) each."""
        elastic, viscous = self.spectra(0)
        return elastic[:, :, 0], viscous[:, :, 0]

    def product(self) -> TangentProduct:
        """Return what multiplies motions by the tangents."""
        rank, signs = self._rank, self._signs
        mixed = np.dot(self._mixing, self.samples[:, : self._half])
        return TangentProduct(
            mixed.reshape(2, rank, rank, self._half),
            self.samples.shape[1],
            signs if signs.size else np.ones(rank),
        )

    def _mix(self, mixed: Array) -> None:
        """Write the tangents of the coordinates at all samples, (2 rank², samples)."""
        half, signs = self._half, self._signs
        np.matmul(self._mixing, self.samples[:, :half], out=mixed[:, :half])
        if signs.size:
            later = np.tile(np.outer(signs, signs).ravel(), 2)
            np.multiply(later[:, None], mixed[:, :half], out=mixed[:, half:])
