"""The response at one frequency against a parameter of the scene, through folds."""

from __future__ import annotations

from hbm.options import CurveOptions
from hbm.parameter_curves import parameter_response
from microslip.progress import Watch
from microslip.studies.curve import gathered
from microslip.studies.gaps import told
from microslip.studies.parameter import Parameter
from microslip_mechanics.response_curve import ResponseCurve, response_curve


def follow(
    parameter: Parameter, frequency: float, watch: Watch = iter
) -> ResponseCurve:
    """Follow the response along a parameter; keep what there is when it stops.

    Parameters
    ----------
    parameter
        What changes.
    frequency
        Of the excitation [rad/s].
    watch
        Shows the progress.

    Raises
    ------
    ContinuationError
        If there is no first point.
    """
    curve = parameter.scene.curve
    options = CurveOptions(
        parameter.first,
        parameter.last,
        error=curve.tolerance,
        harmonics=curve.harmonics,
        samples=curve.samples,
    )
    traced = parameter_response(parameter.problem_at, frequency, options)
    responses, ending = gathered(watch(traced))
    problem = parameter.problem_at(parameter.last)
    return told(response_curve(problem, responses, ending, parameter.label))
