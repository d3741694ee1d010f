"""The frequency response curve of a scene, as far as it was traced."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from hbm.curves.cyclic import cyclic_response
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import branches, frequency_response
from microslip.progress import Watch
from microslip.scenes.experiments import Curve
from microslip.scenes.quantity import SceneError
from microslip.studies.gaps import BROKEN, MISSING, told
from microslip.studies.gathered import gathered
from microslip.studies.prominent import prominent
from microslip_mechanics.cyclic import CyclicProblem
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve, response_curve
from microslip_mechanics.static import StaticState, static_equilibrium

if TYPE_CHECKING:
    from microslip.studies.detached import Searched

SHOWN = 11
"""points in a table, beside that of the largest amplitude"""
LOST = "a branch was lost"
"""begins the ending of a curve that is whole"""


@dataclass(frozen=True, slots=True)
class Traced:
    """A curve, the responses it is made of, and the equilibrium it started from."""

    curve: ResponseCurve
    responses: tuple[PeriodicResponse, ...]
    rest: StaticState
    searched: Searched | None = None
    """where detached curves were sought, if they were"""


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is sought beside the curve that begins at its first frequency."""

    branches: bool = False
    """that begin at branch points"""
    detached: bool = False
    """curves that do not hang together with it"""
    effort: float = 1.0
    """that the search for them may take, over the usual"""
    residual_range: bool = False
    """the range of amplitudes by other residual tractions of contacts that stick"""
    contact_errors: bool = False
    """errors of the energies that contacts take out, and of normal forces"""


ALONE = Wanted()


def trace_curve(
    problem: Problem,
    curve: Curve,
    watch: Watch = iter,
    wanted: Wanted = ALONE,
    searching: Watch = iter,
    *,
    pruned: bool = True,
    stability: bool = True,
) -> Traced:
    """Trace a scene's curve; keep what there is when it cannot go on or is stopped.

    ``wanted`` says what is sought beside it, and ``searching`` watches the search for
    detached curves; ``pruned``, whether what always stays at zero is left out;
    ``stability``, whether its points have multipliers.
    """
    rest = static_equilibrium(problem)
    options = replace(
        curve_options(curve),
        pruned=pruned,
        stability=stability,
        residual_range=wanted.residual_range,
        contact_errors=wanted.contact_errors,
    )
    traced = traced_of(problem, rest, _all(problem, rest, options, wanted), watch)
    ending = traced.curve.ending
    ended = ending == "complete" or ending.startswith((LOST, MISSING, BROKEN))
    if not wanted.detached or not ended:
        return traced
    from microslip.studies.detached import search

    known = traced.responses
    found = search(problem, rest, options, known, effort=wanted.effort, watch=searching)
    ending = found.ending if ending == "complete" else ending
    responses = [*known, *found.responses]
    if wanted.branches and found.responses and not found.interrupted:
        branched = _branched(problem, rest, options, found.responses)
        responses, lost = gathered(chain(responses, watch(branched)))
        ending = lost if ending == "complete" else ending
    responses = prominent(problem, responses)
    made = response_curve(problem, responses, ending)
    return Traced(made, tuple(responses), rest, found)


def trace_sector(
    problem: CyclicProblem, curve: Curve, watch: Watch = iter, wanted: Wanted = ALONE
) -> Traced:
    """Trace the curve of one sector that stands for a disk, as :func:`trace_curve`.

    Raises
    ------
    SceneError
        If more than the curve is wanted.
    """
    if wanted.branches or wanted.detached:
        raise SceneError(
            "branches and detached curves of a disk may break its symmetry, which one "
            "sector cannot show: give --set solve=disk"
        )
    standing = problem.standing()
    options = replace(
        curve_options(curve),
        residual_range=wanted.residual_range,
        contact_errors=wanted.contact_errors,
    )
    traced = cyclic_response(problem, options)
    return traced_of(standing, static_equilibrium(standing), traced, watch)


def curve_options(curve: Curve) -> CurveOptions:
    """Return what a scene asks of a curve."""
    return CurveOptions(
        2.0 * np.pi * curve.lowest,
        2.0 * np.pi * curve.highest,
        error=curve.tolerance,
        harmonics=curve.harmonics,
        samples=curve.samples,
    )


def traced_of(
    problem: Problem,
    rest: StaticState,
    traced: Iterator[PeriodicResponse],
    watch: Watch,
) -> Traced:
    """Return what is traced until it ends or is stopped."""
    found, ending = gathered(watch(traced))
    responses = prominent(problem, found)
    made = told(response_curve(problem, responses, ending))
    return Traced(made, tuple(responses), rest)


def _all(
    problem: Problem, rest: StaticState, options: CurveOptions, wanted: Wanted
) -> Iterator[PeriodicResponse]:
    """Yield the responses on the curve, then on what branches off it."""
    known: list[PeriodicResponse] = []
    for response in frequency_response(problem, rest, options):
        del known[len(known) - response.replaces :]
        known.append(response)
        yield response
    if wanted.branches:
        yield from _branched(problem, rest, options, known)


def _branched(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
) -> Iterator[PeriodicResponse]:
    """Yield the responses on what branches off known ones.

    Raises
    ------
    ContinuationError
        If a branch is lost; it says so.
    """
    try:
        yield from branches(problem, rest, options, known)
    except ContinuationError as error:
        raise ContinuationError(f"{LOST}: {error}") from None


def shown_points(curve: ResponseCurve, largest: int) -> list[int]:
    """Return points evenly spread in frequency, and the one of largest amplitude.

    Over all that the curve covers: a part of it may run back to where it began.
    """
    wanted = np.linspace(curve.frequency.min(), curve.frequency.max(), SHOWN)
    places = {int(np.abs(curve.frequency - each).argmin()) for each in wanted}
    return sorted(places | {largest})
