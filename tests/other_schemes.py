"""Schemes that the fast march does not use, to be compared with those that it does."""

import math

import numpy as np

from microslip_mechanics.arrays import Array
from timedomain.fast.schemes import Scheme


def _runge_kutta(name: str, rows: list[list[float]], other: Array) -> Scheme:
    """Return a scheme from its stages' weights, whose powers are integrated exactly."""
    matrix = np.zeros((len(rows), len(rows)))
    for place, row in enumerate(rows):
        matrix[place, : len(row)] = row
    return Scheme(name, matrix, _quadrature(matrix.sum(axis=1)), other)


def _quadrature(times: Array) -> Array:
    """Return the weights that integrate polynomials through the stages exactly."""
    powers = np.arange(len(times))
    weights: Array = np.linalg.solve(times[None] ** powers[:, None], 1 / (powers + 1.0))
    return weights


def _tr_bdf2() -> Scheme:
    """Return TR-BDF2 as Hosea & Shampine (1996) write it."""
    first, mixed = 2.0 - math.sqrt(2.0), math.sqrt(2.0) / 4.0
    diagonal = first / 2.0
    other = np.array([1.0 - mixed, 3.0 * mixed + 1.0, diagonal]) / 3.0
    rows = [[0.0], [diagonal, diagonal], [mixed, mixed, diagonal]]
    return _runge_kutta("TR-BDF2", rows, other)


def _esdirk3() -> Scheme:
    """Return ESDIRK3(2)4L[2]SA of Kennedy & Carpenter (2016)."""
    diagonal = 0.4358665215084589994160194511935568425
    second = 2.0 * diagonal
    third = 0.6
    mixed = third * (third - 2.0 * diagonal) / (4.0 * diagonal)
    row = [third - mixed - diagonal, mixed, diagonal]
    times = np.array([0.0, second, third])
    last = np.linalg.solve(
        times[None] ** np.arange(3)[:, None],
        [1.0 - diagonal, 0.5 - diagonal, 1.0 / 3.0 - diagonal],
    )
    other = np.array([0.0, 0.0, 0.5 / (1.0 - third), (0.5 - third) / (1.0 - third)])
    rows = [[0.0], [diagonal, diagonal], row, [*last, diagonal]]
    return _runge_kutta("ESDIRK3", rows, other)


TRAPEZOID = _runge_kutta(
    "average acceleration", [[0.0], [0.5, 0.5]], np.array([1.0, 0.0])
)
TR_BDF2 = _tr_bdf2()
ESDIRK3 = _esdirk3()
