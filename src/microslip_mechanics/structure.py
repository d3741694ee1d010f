"""A linear structure: mass, damping and stiffness over named degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Structure:
    """Linear structure M ü + C u̇ + K u = p; the matrices have shape (dofs, dofs)."""

    mass: Array
    """M [kg], symmetric and positive definite"""
    damping: Array
    """C [N s/m], symmetric"""
    stiffness: Array
    """K [N/m], symmetric; may be singular where contact alone holds a body"""
    names: tuple[str, ...]
    """one name for each degree of freedom"""

    def __post_init__(self) -> None:
        """Check shapes, finiteness, symmetry and that no motion is massless."""
        shape = (len(self.names), len(self.names))
        for name in ("mass", "damping", "stiffness"):
            matrix = getattr(self, name)
            if matrix.shape != shape:
                raise ValueError(
                    f"{name} has shape {matrix.shape}, but there are "
                    f"{shape[0]} names of degrees of freedom: give {shape}"
                )
            if not np.all(np.isfinite(matrix)):
                raise ValueError(f"{name} holds a value that is not finite")
            if np.abs(matrix - matrix.T).max() > 1e-9 * np.abs(matrix).max():
                raise ValueError(
                    f"{name} is not symmetric: only symmetric is supported"
                )
        if np.linalg.eigvalsh(self.mass)[0] <= 0.0:
            raise ValueError(
                "mass is not positive definite: some motion has no mass; "
                "lock it or give it mass"
            )

    @property
    def dofs(self) -> int:
        """Number of degrees of freedom."""
        return len(self.names)
