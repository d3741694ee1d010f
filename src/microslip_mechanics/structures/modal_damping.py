"""Damping by ratios of single modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import aslinearoperator

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.structures.natural_modes import natural_modes
from microslip_mechanics.structures.rayleigh import Rayleigh
from microslip_mechanics.structures.structure import Structure

ROUNDING = 1e-9
"""over its parts: so little negative stiffness of a mode is rounding"""


@dataclass(frozen=True, slots=True)
class ModalDamping:
    """Ratios of the slowest modes; faster ones are damped in proportion to stiffness.

    C = β K + Σ M φ (2ζω − βω²) φᵀ M over the modes that have ratios, with the last of
    these ratios by β at its mode.
    """

    ratios: tuple[float, ...]
    """ζ of the slowest modes, the slowest first"""

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
            If there are more ratios than modes, a sparse structure moves freely, or
            the stiffness is negative along a mode.
        """
        modes = natural_modes(structure, len(self.ratios))
        if any(self.ratios):
            _check_held(structure, modes.shapes[:, 0])
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
        if not last > 0.0:
            return Rayleigh()
        return Rayleigh(stiffness=2.0 * self.ratios[-1] / last)


def _check_held(structure: Structure, slowest: Array) -> None:
    """Check that the stiffness of the slowest mode is not negative."""
    stiffness = float(slowest @ (structure.stiffness @ slowest))
    parts = float(np.abs(slowest) @ (abs(structure.stiffness) @ np.abs(slowest)))
    if stiffness < -ROUNDING * parts:
        mostly = structure.names[int(np.abs(slowest).argmax())]
        raise ValueError(
            f"the stiffness is negative along a motion mostly of {mostly}, of which a "
            "damping ratio says nothing: give a damping matrix"
        )
