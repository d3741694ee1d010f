"""Rigid friction in harmonic balance: its tractions become unknowns (theory §6)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from scipy.sparse.csgraph import connected_components

from hbm.relative import RelativeProblem
from hbm.tractions import Tractions, TractionStructure
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import LIMITED, RIGID
from microslip_mechanics.contact.memory import friction_load

WEIGHT = 2.0
"""of trial tractions, over what a structure's stiffness and mass ask of them"""
LEAST = 1e-2
"""share of a point that carries little at rest"""


def with_tractions(
    problem: RelativeProblem, frequency: float, weight: float = WEIGHT
) -> RelativeProblem:
    """Return the problem with trial tractions of its rigid contacts as coordinates.

    The same problem if there are none.

    Parameters
    ----------
    problem
        In relative coordinates, all of them.
    frequency
        Of the excitation [rad/s], or the highest one: it makes weights of stiffness and
        mass.
    weight
        Times these; a numerical parameter (theory, eq. 19b).
    """
    rigid = problem.points.friction == RIGID
    if not rigid.any():
        return problem
    tractions = _tractions(problem, frequency, weight)
    count, rank = tractions.rows.shape
    basis = np.pad(problem.basis, ((0, 0), (0, count)))
    basis[tractions.places] = 0.0
    basis[tractions.places, rank + np.arange(count)] = 1.0
    stiffness = problem.points.tangential.copy()
    stiffness[tractions.places // 3] = tractions.scale
    return replace(
        problem,
        points=problem.points._replace(
            friction=np.where(rigid, LIMITED, problem.points.friction),
            tangential=stiffness,
        ),
        basis=basis,
        selection=np.pad(problem.selection, ((0, count), (0, 0))),
        condensed=TractionStructure(problem.condensed, tractions),
        gauge=np.pad(problem.gauge, ((0, count), (0, count))),
        rest=np.pad(problem.rest, (0, count)),
        tractions=tractions,
    )


def _tractions(
    problem: RelativeProblem, frequency: float, weight: float
) -> Tractions:
    """Return the tractions along all tangents that a rigid point can slide along."""
    places = [
        3 * point + axis
        for point in np.flatnonzero(problem.points.friction == RIGID).tolist()
        for axis in (1, 2)
        if problem.basis[3 * point + axis].any()
    ]
    rows = problem.basis[places]
    owner = np.array(places) // 3
    size = weight * _impedance(problem, rows, frequency) * _shares(problem, owner, rows)
    # both tangents of a point: friction is alike in all directions
    alike = np.array([size[owner == point].max() for point in owner])
    return Tractions(np.array(places), rows, frequency * alike, alike)


def _impedance(problem: RelativeProblem, rows: Array, frequency: float) -> Array:
    """Return force by velocity [N s/m] that each row's stiffness and mass make."""
    elastic = np.einsum("ij,jk,ik->i", rows, problem.condensed.stiffness, rows)
    inertial = np.einsum("ij,jk,ik->i", rows, problem.condensed.mass, rows)
    impedance: Array = np.abs(elastic) / frequency + np.abs(inertial) * frequency
    return np.maximum(impedance, 1e-12 * max(impedance.max(initial=0.0), 1e-300))


def _shares(problem: RelativeProblem, owner: NDArray[np.int64], rows: Array) -> Array:
    """Return the slip limits at rest over the largest with which each row moves.

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
    largest = np.array([limits[family == each].max() for each in family])
    shares = np.divide(limits, largest, out=np.ones(len(limits)), where=largest > 0.0)
    return np.maximum(shares, LEAST)
