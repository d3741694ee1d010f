"""Complex eigenvalues of linear structures, and how they move (theory §6.1, §6.7)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.undamped_modes import undamped_modes

ALIKE = 0.9
"""of the shapes before and after a step that is not divided (MAC)"""
LARGEST, SMALLEST = 1.0 / 4.0, 1.0 / 64.0
"""shares of the way between two structures: first tried, and not divided further"""

NONE = complex(np.nan, np.nan)
"""in place of a pole that does not exist"""


@dataclass(frozen=True, slots=True)
class Poles:
    """Poles without those of negative imaginary part, the slowest oscillation first."""

    values: ComplexArray
    """λ [rad/s], shape (poles,)"""
    shapes: ComplexArray
    """their motions, of unit length in the mass matrix, shape (dofs, poles)"""


def poles(structure: Structure) -> Poles:
    """Return the poles of a structure; its stiffness may be indefinite."""
    values, shapes = eigenpairs(structure.mass, structure.damping, structure.stiffness)
    kept = np.flatnonzero(values.imag >= 0.0)
    kept = kept[np.lexsort((values.real[kept], values.imag[kept]))]
    return Poles(values[kept], shapes[:, kept])


def eigenpairs(
    mass: Array, damping: Array, stiffness: Array
) -> tuple[ComplexArray, ComplexArray]:
    """Return λ and φ of (λ² M + λ C + K) φ = 0, shapes (2 dofs,) and (dofs, 2 dofs).

    The shapes have unit length in the mass matrix. The damping may be any matrix; of
    the stiffness, which may be indefinite, the symmetric part counts.
    """
    squares, modes = undamped_modes((stiffness + stiffness.T) / 2.0, mass)
    size = np.abs(squares)
    # The state (Ω q, q̇) keeps large and small frequencies on one scale.
    scale = np.sqrt(np.maximum(size, 1e-12 * (size.max(initial=0.0) or 1.0)))
    zero = np.zeros_like(modes)
    state = np.block(
        [
            [zero, np.diag(scale)],
            [-np.diag(squares / scale), -modes.T @ damping @ modes],
        ]
    )
    values, vectors = scipy.linalg.eig(state)
    shapes = vectors[: len(scale)] / scale[:, None]
    return values, modes @ (shapes / np.linalg.norm(shapes, axis=0))


def frequencies(values: ComplexArray) -> Array:
    """Return the frequency of free decay [Hz] of each pole."""
    return values.imag / (2.0 * np.pi)


def damping_ratios(values: ComplexArray) -> Array:
    """Return −Re λ / |λ| of each pole: 1 where nothing oscillates."""
    return -values.real / np.maximum(np.abs(values), np.finfo(float).tiny)


def followed(structures: Sequence[Structure]) -> ComplexArray:
    """Return the poles of structures, each in a column of its own.

    Between two structures of the same size poles are followed over structures between
    them, so closely that their shapes stay alike.

    Returns
    -------
    [rad/s], shape ``(structures, columns)``; NaN where a pole does not exist, as when
    two real ones have become a pair.
    """
    current = poles(structures[0])
    columns = np.arange(current.values.size)
    rows, count = [(columns, current.values)], columns.size
    for before, after in itertools.pairwise(structures):
        share = 0.0
        while share < 1.0:
            share, reached, partners = _step(before, after, share, current)
            new = partners < 0
            columns = np.where(new, 0, columns[partners])
            columns[new] = count + np.arange(new.sum())
            current, count = reached, count + int(new.sum())
        rows.append((columns, current.values))
    table = np.full((len(rows), count), NONE)
    for row, (places, values) in zip(table, rows, strict=True):
        row[places] = values
    return table


def _step(
    before: Structure, after: Structure, share: float, current: Poles
) -> tuple[float, Poles, NDArray[np.int64]]:
    """Return how far a step towards ``after`` came, the poles there, their origins."""
    step = min(LARGEST, 1.0 - share) if before.dofs == after.dofs else 1.0
    while True:
        target = share + step
        reached = poles(_between(before, after, target))
        alike, distance = _compared(current, reached, after)
        ones, others = linear_sum_assignment(1.0 - alike + distance)
        partners = np.full(reached.values.size, -1)
        partners[others] = ones
        small = step <= SMALLEST or before.dofs != after.dofs
        oscillate = current.values[ones].imag > 0.0
        if small or alike[ones, others][oscillate].min(initial=1.0) > ALIKE:
            return target, reached, partners
        step *= 0.5


def _between(before: Structure, after: Structure, share: float) -> Structure:
    if share >= 1.0 or before.dofs != after.dofs:
        return after
    mass, damping, stiffness = (
        (1.0 - share) * getattr(before, name) + share * getattr(after, name)
        for name in ("mass", "damping", "stiffness")
    )
    return Structure(mass, damping, stiffness, after.names, after.gyroscopic)


def _compared(one: Poles, other: Poles, structure: Structure) -> tuple[Array, Array]:
    """Return likeness of shapes (MAC) and relative distance of values, from 0 to 1."""
    sizes = np.abs(one.values)[:, None] + np.abs(other.values)
    apart = np.abs(one.values[:, None] - other.values)
    distance = apart / np.maximum(sizes, np.finfo(float).tiny)
    if len(one.shapes) != len(other.shapes):
        return np.zeros_like(distance), distance
    products = one.shapes.conj().T @ structure.mass @ other.shapes
    return np.abs(products) ** 2, distance
