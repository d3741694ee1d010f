"""Motions with which single orders answer a residual, each by itself (theory §6.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray


def answers(
    stiffness: ComplexArray,
    tangents: tuple[Array, Array],
    variable: ComplexArray,
    wanted: NDArray[np.bool_],
    residual: ComplexArray,
) -> ComplexArray:
    """Return the change of y in each order that balances a residual, (orders, rank).

    Parameters
    ----------
    stiffness
        Of the structure, order by order [N/m], shape ``(orders, rank, rank)``.
    tangents
        Means of those of the contacts, by y [N/m] and by its velocity [N s/m].
    variable
        Laplace variable of each order [rad/s], shape ``(orders,)``.
    wanted
        Which coordinates move in each order, shape ``(orders, rank)``.
    residual
        Of each order [N], shape ``(orders, rank)``.
    """
    elastic, viscous = tangents
    whole = stiffness + elastic + variable[:, None, None] * viscous
    both = wanted[:, :, None] & wanted[:, None, :]
    matrices: ComplexArray = np.where(both, whole, np.eye(len(elastic)))
    right: ComplexArray = np.where(wanted, -residual, 0.0)[..., None]
    moved: ComplexArray
    try:
        moved = np.linalg.solve(matrices, right)[..., 0]
    except np.linalg.LinAlgError:  # an undamped mode met exactly
        moved = (np.linalg.pinv(matrices) @ right)[..., 0]
    return moved
