"""A linear structure: mass, damping and stiffness over named degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse
from scipy.sparse.linalg import LinearOperator

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.quantity import LARGEST, apart
from microslip_mechanics.structures.factors import factors

MATRICES = ("mass", "damping", "stiffness")
LIGHTEST = 1e-15
"""mass over stiffness, over the largest one, below which rounding takes all of it"""
LOOSE = 1e-12
"""stiffness over the largest one, below which nothing but a contact that vanishes may
hold a mass: it moves as a free one does, and says nothing of the others"""


@dataclass(frozen=True, slots=True)
class Structure:
    """Linear structure M ü + C u̇ + K u = p; the matrices have shape (dofs, dofs).

    All three are arrays, or all three are sparse arrays or matrices of scipy.sparse;
    beside sparse ones the damping may be a linear operator of scipy.
    """

    mass: Matrix
    """M [kg], symmetric and positive definite"""
    damping: Matrix
    """C [N s/m], symmetric; and Coriolis terms, skew-symmetric, if it is gyroscopic"""
    stiffness: Matrix
    """K [N/m], symmetric; may be singular where contact alone holds a body"""
    names: tuple[str, ...]
    """one name for each degree of freedom"""
    gyroscopic: bool = False
    """whether the damping has a skew-symmetric part"""

    def __post_init__(self) -> None:
        """Check shapes, sizes, symmetry and that no motion is massless."""
        shape = (len(self.names), len(self.names))
        arrays = self._arrays(shape)
        for name in arrays:
            matrix = getattr(self, name)
            if matrix.shape != shape:
                raise ValueError(
                    f"{name} has shape {matrix.shape}, but there are "
                    f"{shape[0]} names of degrees of freedom: give {shape}"
                )
            if self.sparse:
                matrix = matrix.tocsc()
            _check_sizes(matrix.data if self.sparse else matrix, name)
            if self.gyroscopic and name == "damping":
                continue
            _check_symmetric(matrix, name, self.names)
        self._check_light()
        if not self._heavy():
            raise ValueError(
                "mass is not positive definite: some motion has no mass; "
                "lock it or give it mass"
            )

    @property
    def dofs(self) -> int:
        """Number of degrees of freedom."""
        return len(self.names)

    @property
    def sparse(self) -> bool:
        """Whether the matrices are sparse."""
        return bool(scipy.sparse.issparse(self.mass))

    @property
    def dense(self) -> Structure:
        """The structure itself.

        Raises
        ------
        ValueError
            If it is sparse.
        """
        if self.sparse:
            raise ValueError(
                "the structure is sparse, which frc can do with, but not what follows "
                "motions in time or modes: reduce it, in a scene by "
                "[structure.reduction], in Python by microslip.reduced_problem"
            )
        return self

    def _arrays(self, shape: tuple[int, int]) -> list[str]:
        """Return which matrices are no operators; check that they are alike."""
        operator = self.sparse and isinstance(self.damping, LinearOperator)
        arrays = [name for name in MATRICES if not (operator and name == "damping")]
        if len({scipy.sparse.issparse(getattr(self, name)) for name in arrays}) > 1:
            raise ValueError("some matrices are sparse, others not: give three alike")
        if operator:
            self._check_operator(shape)
        return arrays

    def _check_operator(self, shape: tuple[int, int]) -> None:
        """Check shape, finiteness and symmetry of an operator, by two motions."""
        if self.damping.shape != shape:
            raise ValueError(
                f"damping has shape {self.damping.shape}, but there are "
                f"{shape[0]} names of degrees of freedom: give {shape}"
            )
        motions = np.random.default_rng(0).normal(size=(shape[0], 2))
        power = motions.T @ (self.damping @ motions)
        if not np.all(np.isfinite(power)):
            raise ValueError("damping holds a value that is not finite")
        away = abs(power[0, 1] - power[1, 0])
        if not self.gyroscopic and away > 1e-9 * np.abs(power).max():
            raise ValueError("damping is not symmetric: only symmetric is supported")

    def _check_light(self) -> None:
        """Check that no mass is lost beside the others by rounding.

        Each is compared over its own stiffness, as some may be those of rotations.
        """
        mass, held = self.mass.diagonal(), self.stiffness.diagonal()
        slow = np.divide(mass, held, out=np.full(mass.size, np.nan), where=held > 0.0)
        if np.isnan(slow).all():
            return
        firm = np.where(held > LOOSE * held.max(), slow, np.nan)
        light, heavy = int(np.nanargmin(slow)), int(np.nanargmax(firm))
        if 0.0 < slow[light] < LIGHTEST * slow[heavy]:
            raise ValueError(
                f"mass of {self.names[light]} is {mass[light]:g} beside "
                f"{mass[heavy]:g} of {self.names[heavy]}, which rounding takes "
                "for nothing: lock it or give it more mass"
            )

    def _heavy(self) -> bool:
        """Return whether the mass is positive definite."""
        if self.sparse:
            return factors(self.mass) is not None
        return bool(np.linalg.eigvalsh(self.mass)[0] > 0.0)


def _check_symmetric(matrix: Matrix, name: str, names: tuple[str, ...]) -> None:
    """Check that a matrix is symmetric; the worst entry is named."""
    away = abs(matrix - matrix.T)
    if away.max() > 1e-9 * abs(matrix).max():
        row, column = np.unravel_index(int(away.argmax()), away.shape)
        there, back = apart(matrix[row, column], matrix[column, row])
        remedy = "only symmetric is supported"
        if name == "damping":
            remedy += ", beside a skew-symmetric gyroscopic matrix"
        raise ValueError(
            f"{name} is not symmetric: {there} of {names[row]} by {names[column]} but "
            f"{back} of {names[column]} by {names[row]}: {remedy}"
        )


def _check_sizes(entries: Array, name: str) -> None:
    """Check that the entries of a matrix, if any, are numbers whose squares are."""
    most = float(np.abs(entries).max(initial=0.0))
    if not np.isfinite(most):
        raise ValueError(f"{name} holds a value that is not finite")
    if most > LARGEST:
        raise ValueError(
            f"{name} holds a value of {most:g}: give at most {LARGEST:g} in size, or "
            "what is reckoned with it overflows"
        )
    if name != "damping" and 0.0 < most < 1.0 / LARGEST:
        raise ValueError(
            f"{name} holds nothing above {most:g}: give at least {1.0 / LARGEST:g}, "
            "or what is reckoned with it vanishes"
        )
