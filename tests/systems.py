"""Small systems of equations as Newton's corrector takes them."""

import numpy as np
from numpy.typing import ArrayLike

from hbm.continuation.linearised import SingularError
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
