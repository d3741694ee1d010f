"""Small systems of equations as Newton's corrector takes them."""

import numpy as np
from numpy.typing import ArrayLike

from hbm.continuation.linearised import SingularError
from hbm.continuation.settler import Unsettled
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array


class Dense:
    """A Jacobian, shape (n, n + 1), solved as it stands."""

    exact = True

    def __init__(self, rows: ArrayLike) -> None:
        """Take the rows."""
        self.rows = np.asarray(rows, dtype=float)

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [rows; normal] d = right."""
        try:
            return np.linalg.solve(np.vstack([self.rows, normal]), right)
        except np.linalg.LinAlgError as error:
            raise SingularError from error

    def orientation(self, tangent: Array) -> float:
        """Return the sign of the determinant with the tangent as its last row."""
        return float(np.linalg.slogdet(np.vstack([self.rows, tangent])).sign)

    def forget(self) -> None:
        """Keep the rows."""


class Square(Unsettled):
    """y² = 1, at any parameter."""

    size = 2
    fourier = settled = FourierBasis(1, 32)

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        y, _ = point
        return np.array([y**2 - 1.0]), Dense([[2.0 * y, 0.0]])

    def restart(self, harmonics: int) -> None:
        """Have nothing to begin anew."""

    def raise_floor(self) -> bool:
        """Have no more harmonics."""
        return False


class Finer(Square):
    """The same; with more harmonics it ends, at 0.25 if nothing else is said."""

    def __init__(self, ends: float = 0.25) -> None:
        """Begin with few harmonics."""
        self.more, self.ends = False, ends

    def restart(self, harmonics: int) -> None:  # noqa: ARG002
        """Have few harmonics again."""
        self.more = False

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        residual, linearised = super().__call__(point)
        return residual + 2.0 * (self.more and point[-1] > self.ends), linearised

    def raise_floor(self) -> bool:
        """Take more harmonics, once."""
        before, self.more = self.more, True
        return not before
