"""Damping by ratios of single modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import aslinearoperator

from microslip_mechanics.arrays import Matrix
from microslip_mechanics.natural_modes import natural_modes
from microslip_mechanics.rayleigh import Rayleigh
from microslip_mechanics.structure import Structure


@dataclass(frozen=True, slots=True)
class ModalDamping:
    """Ratios of the slowest modes, and what damps all others.

    C = α M + β K + Σ M φ (2ζω − α − βω²) φᵀ M over the modes that have ratios.
    """

    ratios: tuple[float, ...]
    """ζ of the slowest modes, the slowest first"""
    rest: Rayleigh | None = None
    """of all other modes; proportional to stiffness if left out, with the last ratio at
    the last of these modes: faster ones are damped more"""

    def __post_init__(self) -> None:
        """Check that there are ratios, none of them negative."""
        if not self.ratios:
            raise ValueError("no damping ratios: give at least one")
        for place, ratio in enumerate(self.ratios):
            if not 0.0 <= ratio < np.inf:
                raise ValueError(
                    f"damping ratio {ratio:g} of mode {place + 1}: "
                    "give zero or a positive number"
                )

    def matrix(self, structure: Structure) -> Matrix:
        """Return C [N s/m]; of a sparse structure a linear operator of scipy.

        Raises
        ------
        ValueError
            If there are more ratios than modes, or a sparse structure moves freely.
        """
        modes = natural_modes(structure, len(self.ratios))
        frequencies, rest = modes.frequencies, self._rest(float(modes.frequencies[-1]))
        surplus = np.array(
            [
                2.0 * ratio * frequency - rest.rate(float(frequency))
                for ratio, frequency in zip(self.ratios, frequencies, strict=True)
            ]
        )
        momenta = structure.mass @ modes.shapes
        if not structure.sparse:
            return rest.matrix(structure) + (momenta * surplus) @ momenta.T
        return aslinearoperator(rest.matrix(structure)) + (
            aslinearoperator(momenta * surplus) @ aslinearoperator(momenta.T.copy())
        )

    def _rest(self, last: float) -> Rayleigh:
        """Return what damps the other modes; ``last`` is the frequency [rad/s]."""
        if self.rest is not None:
            return self.rest
        if not last > 0.0:
            return Rayleigh()
        return Rayleigh(stiffness=2.0 * self.ratios[-1] / last)
