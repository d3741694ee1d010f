"""Structural damping: a loss factor of the stiffness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.modal_damping import ModalDamping
from microslip_mechanics.structure import Structure


@dataclass(frozen=True, slots=True)
class Hysteretic:
    """K (1 + i η) at each positive frequency, which has no counterpart in time.

    Its response to an impulse begins before the impulse (Crandall 1970), and a solver
    of differential equations cannot march it. So that all solvers speak of the same
    structure, they are given viscous damping with the ratio η/2 in each mode instead
    (:meth:`viscous`), and :meth:`error` is what this changes.
    """

    loss_factor: float
    """η"""

    def __post_init__(self) -> None:
        """Check the loss factor."""
        if not 0.0 <= self.loss_factor < 1.0:
            raise ValueError(
                f"loss factor {self.loss_factor:g}: give one from 0 to below 1"
            )

    def dynamic_stiffness(self, structure: Structure, frequency: float) -> Matrix:
        """Return K (1 + i η) − ω² M at a frequency ω [rad/s], complex."""
        if not 0.0 < frequency < np.inf:
            raise ValueError(
                f"frequency {frequency:g} rad/s: structural damping is defined at "
                "positive frequencies alone"
            )
        stiffness = (1.0 + 1j * self.loss_factor) * structure.stiffness
        return stiffness - frequency**2 * structure.mass

    def viscous(self, modes: int) -> ModalDamping:
        """Return viscous damping that equals it at the first resonances."""
        return ModalDamping((0.5 * self.loss_factor,) * modes)

    def error(self, ratio: Array) -> Array:
        """Return the relative error of a mode's response by :meth:`viscous`.

        Parameters
        ----------
        ratio
            Frequency of the excitation over that of the mode.

        Returns
        -------
        η |1 − r|/|1 − r² + i η r|: zero at resonance, nowhere more than η/(1 + r).
        Responses of all modes together differ by no more than the largest of these,
        as a norm weighted with the mass.
        """
        loss = self.loss_factor
        found: Array = loss * np.abs(1.0 - ratio)
        return found / np.abs(1.0 - ratio**2 + 1j * loss * ratio)
