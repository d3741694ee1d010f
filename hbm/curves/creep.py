"""How far rigid friction that sticks lets a structure creep (theory §6.5)."""

from __future__ import annotations

import numpy as np

from hbm.curves.dense_problem import RESOLVED, dense_problem
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState


def rigid_creep(problem: Problem, rest: StaticState, frequencies: Array) -> Array:
    """Return the amplitude up to which motions are creep of rigid contacts [m].

    Parameters
    ----------
    problem, rest
        What is solved, and its static equilibrium.
    frequencies
        Of the points of a curve [rad/s], shape (points,).

    Returns
    -------
    Shape (points,); zeros without rigid contacts.
    """
    least, most = float(frequencies.min()), float(frequencies.max())
    small, still, _ = dense_problem(problem, rest, RESOLVED * most)
    path = along_frequency(small, still, least, most)
    resolution = PathResolution(path, small.probes.rows)
    return np.array([resolution.least(np.array([each])) for each in frequencies])
