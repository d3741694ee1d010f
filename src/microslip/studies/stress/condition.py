"""The condition of harmonic balance's Jacobian at a point of a curve."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import lapack

from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from microslip.studies.curve import Traced
from microslip_mechanics.problem import Problem


def condition(problem: Problem, traced: Traced, place: int) -> float:
    """Return the condition at a place, in the 1-norm; NaN for a sparse structure."""
    response = traced.responses[place]
    if problem.structure.sparse:
        return math.nan
    frequency = response.frequency
    path = along_frequency(problem, traced.rest, frequency, frequency)
    balance = path.balance(FourierBasis(response.harmonics, response.samples))
    rows = path.problem.map_from(problem.interface.displacement)
    _, linearised = balance(balance.point(response.seen(rows), frequency))
    jacobian = linearised.jacobian
    if jacobian.size == 0:
        return 1.0
    size = float(np.abs(jacobian).sum(axis=0).max())
    factors, _, failed = lapack.dgetrf(jacobian)
    share, _ = lapack.dgecon(factors, size)
    return math.inf if failed or share == 0.0 else 1.0 / float(share)
