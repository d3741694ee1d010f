"""A problem with a dense structure in place of a sparse one (theory §6.1)."""

from __future__ import annotations

from dataclasses import replace

from hbm.options import CurveOptions
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.static import StaticState

RESOLVED = 16.0
"""a sparse structure is resolved up to this multiple of the excitation frequency"""


def dense_problem(
    problem: Problem, rest: StaticState, highest: float
) -> tuple[Problem, StaticState, Array | None]:
    """Return a problem with a dense structure, its rest, and what its columns move.

    The last is None if the structure has been dense before.
    """
    if not problem.structure.sparse:
        return problem, rest, None
    reduction = reduced(problem, highest)
    state = replace(rest, displacement=reduction.coordinates(rest.displacement))
    return reduction.problem, state, reduction.shapes


def resolved_up_to(options: CurveOptions) -> float:
    """Return the frequency up to which a sparse structure is resolved [rad/s]."""
    return options.highest or RESOLVED * max(options.start, options.end)
