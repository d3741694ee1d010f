"""The first harmonic of a free motion, with the stuck modes that resonate (§6.8).

The condensed stiffness is infinite at a pole of the stuck structure, where y vanishes
and the structure moves all the same. The modal coordinates η of poles near the motion
are therefore kept beside y; the others stay condensed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.structure.condensed_structure import CondensedStructure
from microslip_mechanics.arrays import Array, ComplexArray

NEAR = 2.0
"""largest ratio of a pole's frequency to that of the motion, either way"""


@dataclass(frozen=True, slots=True)
class NearModes:
    """Stuck modes whose coordinates η are kept; names as in the condensation."""

    poles: ComplexArray
    """λ [rad/s], shape (count,)"""
    viscous: ComplexArray
    """coupling η ← s y, shape (count, rank)"""
    inertial: ComplexArray
    """coupling η ← s² y, shape (count, rank)"""
    viscous_back: ComplexArray
    """coupling y ← s η, shape (rank, count)"""
    inertial_back: ComplexArray
    """coupling y ← s² η, shape (rank, count)"""
    modes: ComplexArray
    """motion per η, shape (dofs, count)"""


@dataclass(frozen=True, slots=True)
class FreeMotion:
    """Order 1 of a motion without drive, in y and η."""

    far: CondensedStructure
    """without the poles that are near"""
    near: NearModes

    @property
    def count(self) -> int:
        """Number of coordinates η."""
        return int(self.near.poles.size)

    def balance(
        self, pole: complex, relative: ComplexArray, modal: ComplexArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return what forces on y and on η leave, and its derivative.

        Parameters
        ----------
        pole
            s [rad/s].
        relative, modal
            y, shape (rank,), and η, shape (count,).

        Returns
        -------
        Forces on y and imbalance of η, shape ``(rank + count,)``; derivatives by y, η
        and s, shape ``(rank + count, rank + count + 1)`` (theory, eq. 29).
        """
        near, rank, size = self.near, relative.size, relative.size + self.count
        at = np.array([pole])
        stiffness = self.far.dynamic_stiffness(at)[0]
        back, into = _coupling(near.viscous_back, near.inertial_back, pole)
        right, turn = _coupling(near.viscous, near.inertial, pole)
        matrix = np.zeros((size, size + 1), complex)
        matrix[:rank, :rank], matrix[:rank, rank:size] = stiffness, back
        matrix[rank:, :rank] = right
        matrix[rank:, rank:size] = np.diag(pole - near.poles)
        left = matrix[:, :size] @ np.concatenate([relative, modal])
        matrix[:rank, -1] = self.far.slope(at, relative[None])[0] + into @ modal
        matrix[rank:, -1] = modal + turn @ relative
        return left, matrix

    def seen(
        self,
        pole: complex,
        relative: ComplexArray,
        modal: ComplexArray,
        row: ComplexArray,
    ) -> tuple[complex, ComplexArray]:
        """Return a linear form of the motion, and its derivatives by y, η and s.

        ``row`` has shape ``(dofs,)``.
        """
        far, away = self.far, 1.0 / (pole - self.far.poles)
        right, turn = _coupling(far.viscous, far.inertial, pole)
        weights = (row @ far.modes) * away
        by_relative = row @ far.static - weights @ right
        by_modal = row @ self.near.modes
        by_pole = (weights * away) @ (right @ relative) - weights @ (turn @ relative)
        value = by_relative @ relative + by_modal @ modal
        return complex(value), np.concatenate([by_relative, by_modal, [by_pole]])

    def motion(
        self, pole: complex, relative: ComplexArray, modal: ComplexArray
    ) -> ComplexArray:
        """Return the motion of the structure, shape (dofs,)."""
        none = np.zeros((1, len(self.far.static)), complex)
        far = self.far.motion(np.array([pole]), relative[None], none)[0]
        found: ComplexArray = far + self.near.modes @ modal
        return found

    def modal(
        self, pole: complex, relative: ComplexArray, motion: ComplexArray
    ) -> ComplexArray:
        """Return η, shape (count,), of a motion of the structure, shape (dofs,)."""
        nothing = np.zeros(self.count, complex)
        rest = motion - self.motion(pole, relative, nothing)
        found: ComplexArray = np.linalg.lstsq(self.near.modes, rest, rcond=None)[0]
        return found


def free_motion(
    condensed: CondensedStructure,
    kept: NDArray[np.int64],
    mass: Array,
    pole: complex,
    size: float,
) -> FreeMotion:
    """Return the free motion near a pole.

    Parameters
    ----------
    condensed
        The structure with all its poles.
    kept
        Which of its coordinates y move.
    mass
        M, shape (dofs, dofs).
    pole
        s of the motion [rad/s].
    size
        Modal mass φᴴMφ that the near modes are given [kg].
    """
    ratio = np.abs(condensed.poles) / abs(pole)
    near = (condensed.poles.imag > 0.0) & (ratio <= NEAR) & (ratio >= 1.0 / NEAR)
    modes = condensed.modes[:, near]
    heavy = np.einsum("di,de,ei->i", modes.conj(), mass, modes).real
    factor = np.sqrt(size / heavy)
    chosen = NearModes(
        condensed.poles[near],
        condensed.viscous[near][:, kept] / factor[:, None],
        condensed.inertial[near][:, kept] / factor[:, None],
        condensed.viscous_back[kept][:, near] * factor,
        condensed.inertial_back[kept][:, near] * factor,
        modes * factor,
    )
    none = np.zeros((0, len(condensed.static)), complex)
    return FreeMotion(condensed.with_poles(~near).restricted(kept, none), chosen)


def _coupling(
    viscous: ComplexArray, inertial: ComplexArray, pole: complex
) -> tuple[ComplexArray, ComplexArray]:
    """Return s C + s² M of a coupling, and its derivative by s."""
    return pole * viscous + pole**2 * inertial, viscous + 2.0 * pole * inertial
