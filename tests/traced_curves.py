"""Whole curves of small problems, as studies take them."""

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.studies.curve import Traced
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response_curve import response_curve
from microslip_mechanics.static import static_equilibrium


def traced(
    problem: Problem, start: float, end: float, *, harmonics: int | None = None
) -> Traced:
    """Return the curve from one frequency to another [rad/s]."""
    rest = static_equilibrium(problem)
    options = CurveOptions(start, end, harmonics=harmonics)
    found = tuple(frequency_response(problem, rest, options))
    return Traced(response_curve(problem, found, "complete"), found, rest)
