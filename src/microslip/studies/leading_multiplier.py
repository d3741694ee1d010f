"""How sure the largest Floquet multiplier of a curve is."""

from __future__ import annotations

from hbm.curves.periodic_response import multiplier_error
from microslip.scenes.experiments import Curve
from microslip.studies.curve import Traced, curve_options
from microslip_mechanics.problem import Problem


def leading_error(problem: Problem, traced: Traced, curve: Curve) -> float:
    """Return the error of the largest multiplier; infinite where it is not known.

    Parameters
    ----------
    problem, curve
        Of which the curve is, and what was asked of it.
    traced
        The curve.
    """
    place = int(traced.curve.multiplier.argmax())
    response = traced.responses[place]
    return multiplier_error(problem, traced.rest, response, curve_options(curve))
