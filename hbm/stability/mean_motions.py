"""Free motions of the structure on mean tangents, step by step (theory §6.5).

With constant tangents the structure is one matrix A, diagonal in its own motions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray

SKEW = 1e8
"""condition of the eigenvectors of A from which they are no basis"""


@dataclass(frozen=True, slots=True)
class MeanMotions:
    """Motions z of the structure on mean tangents, x = (u, u̇/ω) = Re(V z)."""

    rates: ComplexArray
    """[1/s], shape (motions,); of a pair of conjugates the first"""
    shapes: ComplexArray
    """V, shape (2 coordinates, motions)"""
    parts: ComplexArray
    """z of each x, shape (motions, 2 coordinates)"""
    push: ComplexArray
    """ż of a contact force on y, shape (motions, rank)"""
    seen: ComplexArray
    """(y, ẏ/ω) of z, shape (2 rank, motions)"""


def mean_motions(
    matrices: tuple[Array, Array, Array], elastic: Array, viscous: Array, scale: float
) -> MeanMotions | None:
    """Return the motions; None if they are no basis.

    Parameters
    ----------
    matrices
        Mass, damping and stiffness, each (coordinates, coordinates), y first.
    elastic, viscous
        Mean tangents of the contacts by y and ẏ [N/m, N s/m], each (rank, rank).
    scale
        ω, by which velocities are divided [rad/s].
    """
    mass, damping, stiffness = matrices
    size, rank = len(mass), len(elastic)
    damping, stiffness = damping.copy(), stiffness.copy()
    damping[:rank, :rank] += viscous
    stiffness[:rank, :rank] += elastic
    inverse = np.linalg.inv(mass)
    none = np.zeros_like(mass)
    system = np.block(
        [
            [none, scale * np.eye(size)],
            [-inverse @ stiffness / scale, -inverse @ damping],
        ]
    )
    values, shapes = np.linalg.eig(system)
    if not np.linalg.cond(shapes) < SKEW:
        return None
    kept = values.imag >= 0.0
    parts = np.linalg.inv(shapes.astype(complex))[kept]
    halves = np.where(values[kept].imag > 0.0, 2.0, 1.0)
    shapes = shapes[:, kept].astype(complex) * halves
    places = np.append(np.arange(rank), size + np.arange(rank))
    push = parts[:, size:] @ inverse[:, :rank].astype(complex) / scale
    return MeanMotions(
        values[kept].astype(complex),
        shapes,
        parts,
        push,
        shapes[places],
    )


class FreeSteps(NamedTuple):
    """What steps of several lengths do to the motions without changes of contacts."""

    turn: ComplexArray
    """exp(λ h), shape (lengths, motions)"""
    kicks: Array
    """z of a constant force on y, real parts above, (lengths, 2 motions, rank)"""
    felt: Array
    """(y, ẏ/ω) of that force, shape (lengths, 2 rank, rank)"""
    kind: NDArray[np.int64]
    """which length each step has, shape (steps,)"""


def free_steps(motions: MeanMotions, lengths: Array, frequency: float) -> FreeSteps:
    """Return the steps; ``lengths`` are in phase [rad], shape (steps,)."""
    # equal ones differ by rounding
    sizes, kind = np.unique(lengths.round(13), return_inverse=True)
    turn = np.exp(np.multiply.outer(sizes / frequency, motions.rates))
    # ∫ exp(λ s) ds over a step; λ may be zero
    safe = np.where(motions.rates == 0.0, 1.0, motions.rates)
    still = (sizes / frequency)[:, None]
    kick = np.where(motions.rates == 0.0, still, (turn - 1.0) / safe)
    kicks = kick[:, :, None] * motions.push
    parts = np.concatenate([kicks.real, kicks.imag], axis=1)
    return FreeSteps(turn, parts, stacked(motions.seen) @ parts, kind.astype(np.int64))


def stacked(matrix: ComplexArray) -> Array:
    """Return what takes real parts above imaginary ones to the product's real part.

    ``matrix`` has shape (rows, columns), the result (rows, 2 columns).
    """
    return np.hstack([matrix.real, -matrix.imag])


def turned(turn: ComplexArray, above: Array, below: Array) -> Array:
    """Return motions after a free step, real parts above imaginary ones.

    ``above`` and ``below`` are these parts before it, shape (motions, several) each.
    """
    cosine, sine = turn.real[:, None], turn.imag[:, None]
    return np.concatenate(
        [cosine * above - sine * below, sine * above + cosine * below]
    )
