"""Rigid friction in harmonic balance: pushes on it are unknowns (theory §6.5)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hbm.balance.relative import RelativeProblem
from hbm.balance.residual import HarmonicBalance
from hbm.structure.tractions import PushedStructure, Tractions
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import friction_load
from microslip_mechanics.contact.points import PUSHED, RIGID

HIGH = 100.0
"""times the excitation frequency: there a structure shows the mass of its contacts"""
LOSS = 0.2
"""damping rate of that mass, over the excitation frequency"""
LEAST = 1e-2
"""share in it of a point that carries little at rest"""


def with_pushes(problem: RelativeProblem, frequency: float) -> RelativeProblem:
    """Return the problem with the pushes on its rigid contacts as coordinates.

    The same problem if there are none.

    Parameters
    ----------
    problem
        In relative coordinates, all of them.
    frequency
        Of the excitation [rad/s], or the highest one.
    """
    rigid = problem.points.friction == RIGID
    if not rigid.any():
        return problem
    tractions = _tractions(problem, frequency)
    count, rank = tractions.rows.shape
    basis = np.pad(problem.basis, ((0, 0), (0, count)))
    basis[tractions.places] = 0.0
    basis[tractions.places, rank + np.arange(count)] = 1.0
    scale = problem.points.tangential.copy()
    scale[tractions.places // 3] = tractions.scale
    points = problem.points._replace(
        friction=np.where(rigid, PUSHED, problem.points.friction),
        tangential=scale,
        stribeck=np.where(rigid, tractions.rate, problem.points.stribeck),
    )
    return replace(
        problem,
        points=points,
        basis=basis,
        selection=np.pad(problem.selection, ((0, count), (0, 0))),
        condensed=PushedStructure(problem.condensed, tractions),
        loose=np.pad(problem.loose, ((0, count), (0, 0))),
        gauge=np.pad(problem.gauge, ((0, count), (0, count))),
        rest=np.pad(problem.rest, (0, count)),
        tractions=tractions,
    )


def pushed(balance: HarmonicBalance, point: Array) -> Array:
    """Return a point with the pushes on rigid contacts that balance its motion.

    They are zero in ``point``, which is returned if there are none.
    """
    tractions = balance.problem.tractions
    if tractions is None:
        return point
    count, rank = tractions.rows.shape
    missing = balance.residual(point).reshape(-1, rank + count)[:, :rank]
    filled = point.copy()
    filled[:-1].reshape(missing.shape[0], -1)[:, rank:] = (
        -missing @ np.linalg.pinv(tractions.rows) / tractions.scale
    )
    return filled


def _tractions(problem: RelativeProblem, frequency: float) -> Tractions:
    """Return the tractions along all tangents that a rigid point can slide along."""
    places = np.array(
        [
            3 * point + axis
            for point in np.flatnonzero(problem.points.friction == RIGID).tolist()
            for axis in (1, 2)
            if problem.basis[3 * point + axis].any()
        ],
        dtype=np.int64,
    )
    rows, owner = problem.basis[places], places // 3
    mass = _masses(problem, rows, frequency) * _shares(problem, owner, rows)
    # one for both tangents of a point: friction is alike in all directions; the larger
    # would hide what a sudden force does along the other
    alike = np.array([mass[owner == point].min() for point in owner])
    return Tractions(places, rows, frequency**2 * alike, alike, LOSS * frequency)


def _masses(problem: RelativeProblem, rows: Array, frequency: float) -> Array:
    """Return what a force along each row accelerates at once [kg]."""
    variable = np.array([1j * HIGH * frequency])
    stiffness = problem.condensed.dynamic_stiffness(variable)
    compliance = rows @ np.linalg.pinv(stiffness[0]) @ rows.T
    masses: Array = 1.0 / ((HIGH * frequency) ** 2 * np.abs(np.diagonal(compliance)))
    return masses


def _shares(problem: RelativeProblem, owner: NDArray[np.int64], rows: Array) -> Array:
    """Return the slip limits at rest over the sum of those that move together.

    Points on one rigid face share what sticking asks of them as they would slide: what
    a single one carries is not determined otherwise.
    """
    points = problem.points
    depth = (problem.basis @ problem.rest + problem.offset)[3 * owner]
    limits = np.array(
        [
            points.dynamic[point] * friction_load(points, point, deep, 0.0)[0]
            for point, deep in zip(owner.tolist(), depth.tolist(), strict=True)
        ]
    )
    moves = (rows != 0.0).astype(float)
    _, family = connected_components(moves @ moves.T)
    sums, counts = np.empty((2, len(limits)))
    for each in np.unique(family):
        _, first = np.unique(owner[family == each], return_index=True)
        sums[family == each] = limits[family == each][first].sum()
        counts[family == each] = first.size
    shares = np.divide(limits, sums, out=1.0 / counts, where=sums > 0.0)
    kept: Array = np.maximum(shares, LEAST / counts)
    return kept
