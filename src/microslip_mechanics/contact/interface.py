"""Where the contact points sit: from the structure's motion to the relative motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import connected_components

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints

ROUNDING = 1e-14
"""columns of this size beside the largest are those of rounding"""


@dataclass(frozen=True, slots=True)
class Interface:
    """Contact points and the relative displacement that each one sees."""

    points: ContactPoints
    displacement: Array
    """map to (normal, tangent, tangent) of each point, shape (3 points, dofs)"""
    names: tuple[str, ...]
    """one name for each point"""

    def __post_init__(self) -> None:
        """Check that table, map and names speak of the same points."""
        count = len(self.names)
        if self.displacement.ndim != 2 or self.displacement.shape[0] != 3 * count:
            raise ValueError(
                f"displacement has shape {self.displacement.shape}, but {count} "
                f"points need {3 * count} rows: normal and two tangents for each"
            )
        for field, column in self.points._asdict().items():
            if column.shape != (count,):
                raise ValueError(
                    f"contact parameter {field} has shape {column.shape}, "
                    f"but there are {count} contact points"
                )

    @property
    def count(self) -> int:
        """Number of contact points."""
        return len(self.names)

    def relative_motion(self) -> tuple[Array, Array]:
        """Return independent coordinates of the relative motion.

        Rigid faces move relative to each other in six ways at the most, however many
        points they carry; the solvers need no more unknowns (theory, eq. 11). Motions
        that share no degree of freedom, such as those along and across a plane of
        symmetry, stay apart.

        Returns
        -------
        basis
            Orthonormal map from the coordinates to the relative displacements of the
            points, shape ``(3 points, rank)``.
        selection
            Map from the structure to the coordinates [m], shape ``(rank, dofs)``;
            ``displacement = basis @ selection``.
        """
        rows = self.displacement
        if rows.shape[0] == 0:
            return np.zeros((0, 0)), rows
        sizes = np.linalg.norm(rows, axis=0)
        seen = sizes > ROUNDING * sizes.max(initial=0.0)
        touched, units = rows[:, seen], rows[:, seen] / sizes[seen]
        _, family = connected_components(np.abs(units.T @ units) > 1e-10)
        floor = 1e-9 * float(np.linalg.norm(touched, 2))
        spans = [_span(touched[:, family == each], floor) for each in np.unique(family)]
        basis = np.hstack(spans)
        if basis.shape[1] == rows.shape[0]:
            basis = np.eye(rows.shape[0])
        return np.ascontiguousarray(basis), np.ascontiguousarray(basis.T @ rows)


def _span(columns: Array, floor: float) -> Array:
    """Return an orthonormal basis of what the columns span above ``floor``."""
    left, sizes, _ = np.linalg.svd(columns, full_matrices=False)
    basis: Array = left[:, sizes > floor]
    return basis
