"""Whether what a curve shows is creep of contacts that stick, and no motion."""

from __future__ import annotations

import numpy as np

from hbm.curves.creep import rigid_creep
from microslip.studies.curve import Traced
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.contact.points import FRICTIONLESS, RIGID
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

MOSTLY = 0.9
"""share of the points that creep: beside an undamped resonance of parts that only creep
drives, they move more"""


def creep(problem: Problem, traced: Traced) -> list[str]:
    """Return what is to be said of a curve that is nothing but creep; else nothing."""
    points, sizes = problem.interface.points, traced.curve.amplitude.max(axis=1)
    rubs = points.friction != FRICTIONLESS
    if not rubs.any() or not sizes.any():
        return []
    if (points.friction[rubs] == RIGID).all():
        limits = rigid_creep(problem, traced.rest, traced.curve.frequency)
        if np.mean(sizes <= limits) < MOSTLY:
            return []
        return [
            f"{_told(sizes)}: its amplitude is that of a numerical parameter (theory, "
            "6.5), as is what its error is relative to: take it for zero"
        ]
    threshold = float(points.threshold[rubs].min())
    fastest = max(_velocity(problem, each) for each in traced.responses)
    if beyond_motion(points) or fastest > threshold:
        return []
    return [
        f"{_told(sizes)}, for no velocity is above {fastest:.2g} m/s, and up to the "
        f"threshold velocity of friction, {threshold:g} m/s, that is a damper: the "
        "amplitude is that of this parameter"
    ]


def _told(sizes: Array) -> str:
    """Return how a message begins."""
    return (
        f"what moves, at most {1e3 * sizes.max():.2g} mm, is creep of friction that "
        "sticks at all times"
    )


def _velocity(problem: Problem, response: PeriodicResponse) -> float:
    """Return the largest velocity of a probe or across a contact [m/s]."""
    rows = np.vstack([problem.probes.rows, problem.interface.displacement])
    return response.frequency * response.largest(rows)
