"""Damping of a structure: a matrix, ratios of modes, Rayleigh's, a loss factor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike
from scipy.sparse.linalg import LinearOperator

from microslip_mechanics.arrays import Array, Matrix, numbers_of, shown
from microslip_mechanics.structures.factors import indefinite_factors
from microslip_mechanics.structures.given_matrices import check_like, square_matrix
from microslip_mechanics.structures.hysteretic import equivalent_viscous
from microslip_mechanics.structures.modal_damping import ModalDamping
from microslip_mechanics.structures.rayleigh import Rayleigh
from microslip_mechanics.structures.structure import Structure

ROUNDING = 1e-9
"""over the largest entry: so little energy from a damping matrix is rounding"""


@dataclass(frozen=True, slots=True)
class Damping:
    """One of several ways to say what a structure loses; none of them is no damping."""

    matrix: ArrayLike | Matrix | None = None
    """C [N s/m]"""
    ratio: float | Sequence[float] | Array | None = None
    """of all modes, or of the slowest ones"""
    rayleigh: Sequence[float] | Array | None = None
    """α [1/s] and β [s] of C = α M + β K"""
    loss_factor: float | None = None
    """η of the stiffness"""

    def of(self, mass: Matrix, stiffness: Matrix, names: tuple[str, ...]) -> Matrix:
        """Return C [N s/m]; of a sparse structure it may be a linear operator.

        Raises
        ------
        ValueError
            In one line, with what is wrong and what to give instead.
        """
        self._check_single()
        found = self._matrix(mass, stiffness, names)
        if not isinstance(found, LinearOperator):
            _check_dissipates(found, names)
        return found

    def _matrix(
        self, mass: Matrix, stiffness: Matrix, names: tuple[str, ...]
    ) -> Matrix:
        """Return C, which may still put energy in."""
        if self.matrix is not None:
            given = square_matrix(self.matrix, "damping")
            check_like(given, mass, "damping")
            return given
        none = 0.0 * mass
        if self.ratio is None and self.rayleigh is None and self.loss_factor is None:
            return none
        bare = Structure(mass, none, stiffness, names)
        if self.rayleigh is not None:
            if numbers_of(self.rayleigh).shape != (2,):
                raise ValueError(
                    f"rayleigh_damping = {shown(self.rayleigh)}: give two numbers, of "
                    "the mass [1/s] and of the stiffness [s]"
                )
            return Rayleigh(*self.rayleigh).matrix(bare)
        if self.loss_factor is not None:
            _check_all(bare, "loss_factor")
            if numbers_of(self.loss_factor).shape != ():
                raise ValueError(
                    f"loss_factor = {shown(self.loss_factor)}: give a number such as "
                    "0.01"
                )
            return equivalent_viscous(self.loss_factor, bare.dofs).matrix(bare)
        return ModalDamping(self._ratios(bare)).matrix(bare)

    def _check_single(self) -> None:
        ways = (self.matrix, self.ratio, self.rayleigh, self.loss_factor)
        if sum(each is not None for each in ways) > 1:
            raise ValueError(
                "damping is given twice: give one of damping, damping_ratio, "
                "rayleigh_damping and loss_factor"
            )

    def _ratios(self, bare: Structure) -> tuple[float, ...]:
        """Return the ratio of each mode that has one."""
        given = numbers_of(self.ratio)
        if not given.size or given.ndim > 1:
            raise ValueError(
                f"damping_ratio = {shown(self.ratio)}: give a number such as 0.01, a "
                "share of critical damping, or a list of them"
            )
        single, ratios = given.ndim == 0, np.atleast_1d(given)
        for ratio in ratios:
            if not 0.0 <= ratio < 1.0:
                raise ValueError(
                    f"damping_ratio = {ratio:g}: give 0 to below 1, a share of "
                    "critical damping"
                )
        if single:
            _check_all(bare, "damping_ratio")
            ratios = np.repeat(ratios, bare.dofs)
        return tuple(map(float, ratios))


def _check_all(structure: Structure, name: str) -> None:
    """Check that all modes of a structure can be had."""
    if structure.sparse:
        raise ValueError(
            f"{name} needs all modes of the structure, which is sparse: give a list "
            "of ratios of the slowest modes, Rayleigh damping or a damping matrix"
        )


def _check_dissipates(damping: Matrix, names: tuple[str, ...]) -> None:
    """Check that a damping matrix puts no energy in; a skew part moves it only.

    Raises
    ------
    ValueError
        With the degree of freedom that gains most.
    """
    diagonal = damping.diagonal()
    if diagonal.size and diagonal.min() < 0.0:
        place = int(diagonal.argmin())
        raise ValueError(
            f"damping of {names[place]} is {diagonal[place]:g} N s/m: negative damping "
            "puts energy in, give 0 or more"
        )
    damping = 0.5 * (damping + damping.T)
    size = abs(damping).max() if diagonal.size else 0.0
    if size == 0.0:
        return
    sparse = bool(scipy.sparse.issparse(damping))
    if sparse:
        shift = ROUNDING * size * scipy.sparse.eye_array(len(names), format="csc")
        found = indefinite_factors(damping.tocsc() + shift)
        gains = found is not None and bool((found.pivots < 0.0).any())
        where = "some motion"
    else:
        rates, shapes = np.linalg.eigh(damping)
        gains = bool(rates[0] < -ROUNDING * size)
        where = f"a motion mostly of {names[int(np.abs(shapes[:, 0]).argmax())]}"
    if gains:
        raise ValueError(
            f"damping puts energy into {where}: give a matrix without negative "
            "eigenvalues"
        )
