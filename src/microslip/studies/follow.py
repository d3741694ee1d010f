"""The response at one frequency against a parameter, through folds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from hbm.curves.parameter_curves import parameter_response
from hbm.options import CurveOptions
from microslip.progress import Watch
from microslip.scenes.experiments import Resolution
from microslip.scenes.rigs import solvable
from microslip.studies.gaps import told
from microslip.studies.gathered import gathered
from microslip.studies.parameter import Parameter, told_along
from microslip.studies.prominent import prominent
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve, response_curve

ROUNDING = 1e-15
"""of the way between two values, by which a parameter may miss one"""


def follow(
    parameter: Parameter, frequency: float, watch: Watch = iter
) -> ResponseCurve:
    """Follow the response along a parameter of a scene, as :func:`along` does.

    Raises
    ------
    SceneError
        If there is no problem at the first value.
    ContinuationError
        If there is no first point.
    """
    solvable(parameter.scene)
    return along(
        parameter.problem_at,
        (parameter.first, parameter.last),
        frequency,
        parameter.scene.curve,
        parameter.label,
        watch,
    )


def along(
    problem_at: Callable[[float], Problem],
    ends: tuple[float, float],
    frequency: float,
    resolution: Resolution,
    label: str,
    watch: Watch = iter,
) -> ResponseCurve:
    """Follow the response along a parameter; keep what there is when it stops.

    Parameters
    ----------
    problem_at
        Value of the parameter ↦ what is solved.
    ends
        First and last value.
    frequency
        Of the excitation [rad/s].
    resolution
        Accuracy, or harmonics and samples.
    label
        Name and unit of the parameter.
    watch
        Shows the progress.

    Raises
    ------
    ContinuationError
        If there is no first point.
    """
    options = CurveOptions(
        *ends,
        error=resolution.tolerance,
        harmonics=resolution.harmonics,
        samples=resolution.samples,
        residual_range=True,
        contact_errors=True,
    )
    traced = told_along(parameter_response(problem_at, frequency, options), label)
    found, ending = gathered(watch(traced))
    problem = problem_at(ends[1])
    responses = prominent(problem, [_ended(each, ends) for each in found])
    return told(response_curve(problem, responses, ending, label))


def _ended(response: PeriodicResponse, ends: tuple[float, float]) -> PeriodicResponse:
    """Return a response whose parameter is that of an end, if rounding keeps it off.

    Zero would be 1e-28, which axes and tables of decades show.
    """
    near = ROUNDING * abs(ends[1] - ends[0])
    for end in ends:
        if abs(response.parameter - end) <= near:
            return replace(response, parameter=end)
    return response
