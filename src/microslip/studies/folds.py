"""How the folds of a scene's curve move with a parameter, and where they meet."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hbm.curves.fold_curve import FoldPoint
from hbm.curves.parameter_curves import fold_curve
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from microslip.interruption import unmasked
from microslip.progress import Watch
from microslip.scenes.experiments import Curve
from microslip.studies.curve import trace_curve
from microslip.studies.parameter import Parameter, told_along
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.quantity import apart
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve, response_curve

FAR = 10.0
"""times the highest frequency of the curve, or its lowest over it, beyond which a fold
is not followed"""
SAME = 1e-2
"""difference of two motions, relative, up to which they are one at two resolutions"""


class FoldError(MicroslipError):
    """Folds that are not found or not followed; the text says where and why."""


class NoFoldsError(FoldError):
    """A curve without folds, which was traced to its end: nothing went wrong."""


@dataclass(frozen=True, slots=True)
class FollowedFold:
    """A fold, as far as it was followed."""

    curve: ResponseCurve
    """the motions at the fold; events are where folds or curves meet"""
    points: tuple[FoldPoint, ...]
    """in the same order"""


def followed_folds(parameter: Parameter, watch: Watch = iter) -> Iterator[FollowedFold]:
    """Yield the folds of the curve at the first value, followed along a parameter.

    A fold that comes back to the first value as another one is followed once. What
    cannot go on, or is interrupted, keeps what it has.

    Parameters
    ----------
    parameter
        What changes.
    watch
        Shows the progress along each fold.

    Raises
    ------
    NoFoldsError
        If the curve has no folds.
    FoldError
        If it has none up to where it ends early.
    ContinuationError
        If the curve has no first point.
    """
    starts = _located(parameter)
    while starts:
        fold = _followed(parameter, starts.pop(0), watch)
        yield fold
        if fold.curve.ending == "interrupted":
            return
        if fold.points and fold.curve.parameter[-1] == parameter.first:
            last = fold.points[-1].response
            starts = [each for each in starts if _distance(each, last) > SAME]


def _located(parameter: Parameter) -> list[PeriodicResponse]:
    """Return the folds of the curve at the first value of a parameter."""
    wanted = parameter.scene.curve
    traced = trace_curve(parameter.problem_at(parameter.first), wanted)
    ending = traced.curve.ending
    if ending == "interrupted":
        raise KeyboardInterrupt
    found = [response for response in traced.responses if response.event == "fold"]
    if not found:
        reached = "" if ending == "complete" else f" up to where it ends ({ending})"
        low, high = apart(wanted.lowest, wanted.highest)
        raise (NoFoldsError if ending == "complete" else FoldError)(
            f"the curve at {parameter.name} = {parameter.first:g} has no folds between "
            f"{low} and {high} Hz{reached}: begin at a value "
            "where it has, which microslip track finds"
        )
    return found


def _followed(
    parameter: Parameter, start: PeriodicResponse, watch: Watch
) -> FollowedFold:
    """Return a fold as far as it goes."""
    curve = parameter.scene.curve
    options = CurveOptions(
        parameter.first,
        parameter.last,
        harmonics=curve.harmonics,
        samples=curve.samples,
    )
    followed = fold_curve(parameter.problem_at, start, options)
    points: list[FoldPoint] = []
    ending = "complete"
    try:
        with unmasked():
            for point in watch(told_along(followed, parameter.label)):
                points.append(point)
                if _far(point.response.frequency / math.tau, curve):
                    ending = _left(parameter, point.response)
                    break
    except ContinuationError as cause:
        ending = str(cause)
    except KeyboardInterrupt:
        ending = "interrupted"
        if not points:
            raise
    made = response_curve(
        parameter.problem_at(parameter.last),
        [point.response for point in points],
        ending,
        parameter.label,
    )
    return FollowedFold(made, tuple(points))


def _far(hertz: float, curve: Curve) -> bool:
    """Return whether a fold has gone far away from the curve."""
    return not curve.lowest / FAR <= hertz <= curve.highest * FAR


def _left(parameter: Parameter, fold: PeriodicResponse) -> str:
    """Return how a fold ends that goes far away."""
    return (
        f"the fold goes away to {fold.frequency / math.tau:.4g} Hz at {parameter.name} "
        f"= {fold.parameter:.3g}: it is followed to {FAR:g} times the curve's highest "
        "frequency, or its lowest over that; give the curve more range"
    )


def _distance(one: PeriodicResponse, other: PeriodicResponse) -> float:
    """Return by how much means and first harmonics of two motions differ, relative."""
    parts = [each.coefficients[:3] for each in (one, other)]
    distance = np.linalg.norm(parts[0] - parts[1])
    return float(distance / np.linalg.norm(parts[1]))
