"""Single periodic responses: to another resolution, a stated error, or stability.

What a symmetry keeps still is left out where the response that is known keeps it.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hbm.balance.rigid import pushed
from hbm.continuation.corrected import correct_at
from hbm.continuation.step_control import StepControl
from hbm.curves.dense_problem import RESOLVED, dense_problem, resolved_up_to
from hbm.curves.response import response
from hbm.curves.tracer import Tracer
from hbm.errors import hertz, placed
from hbm.events.crossing_error import SLOWEST, witness
from hbm.forces.fourier import FourierBasis
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency, along_frequency
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState


def periodic_response(
    problem: Problem,
    rest: StaticState,
    guess: PeriodicResponse,
    *,
    harmonics: int,
    samples: int,
    tolerance: float = 1e-8,
    highest: float | None = None,
    pruned: bool = True,
) -> PeriodicResponse:
    """Return the response at the frequency of ``guess`` with another resolution.

    A sparse structure is reduced anew, up to ``highest``; both that and ``pruned`` are
    as in :class:`~hbm.options.CurveOptions`.

    Raises
    ------
    ContinuationError
        If the point does not converge.
    """
    control = StepControl(tolerance=tolerance * problem.force_scale)
    highest = highest or RESOLVED * guess.frequency
    small, still, shapes = dense_problem(problem, rest, highest)
    path = along_frequency(
        small, still, guess.frequency, guess.frequency, pruned=pruned
    )
    path = _holding(path, problem, guess)
    balance = path.balance(FourierBasis(harmonics, samples))
    rows = path.problem.map_from(problem.interface.displacement)
    start = pushed(balance, balance.point(guess.seen(rows), guess.frequency))
    with one_thread(), placed(hertz):
        correction = correct_at(balance, start, control)
    return replace(response(small, balance, correction), shapes=shapes)


def settled_response(
    problem: Problem,
    rest: StaticState,
    guess: PeriodicResponse,
    *,
    error: float,
) -> PeriodicResponse:
    """Return the response at the frequency of ``guess`` to a stated error.

    Harmonics and samples grow from one harmonic of the guess, or from all of one that
    breaks a symmetry, until the estimated relative error of the amplitude is
    below ``error``, or until there are no more.

    Raises
    ------
    ContinuationError
        If the point does not converge.
    """
    frequency = guess.frequency
    small, still, shapes = dense_problem(problem, rest, RESOLVED * frequency)
    symmetric = along_frequency(small, still, frequency, frequency)
    path = _holding(symmetric, problem, guess)
    around = CurveOptions(frequency, 2.0 * frequency, error=error, stability=False)
    tracer = Tracer(small, path, around)
    rows = path.problem.map_from(problem.interface.displacement)
    known = guess.seen(rows)[:3].ravel()
    if path is not symmetric:
        known = guess.seen(rows).ravel()[: tracer.system.size - 1]
        tracer.system.restart(guess.harmonics)
    start = np.zeros(tracer.system.size)
    start[: known.size], start[-1] = known, frequency
    with one_thread(), placed(hertz):
        found = correct_at(tracer.system, start, tracer.control, tracer.system)
        made = next(tracer.curve.followed([found], tracer.pieces.metric))
    return replace(made, shapes=shapes)


def with_multipliers(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    options: CurveOptions,
) -> PeriodicResponse:
    """Return a response with the multipliers that its curve left out.

    Its error is infinite if more harmonics, where they ask for them, do not confirm the
    orbit.

    Parameters
    ----------
    problem, rest, options
        As for :func:`hbm.solve.frequency_response`.
    response
        On the curve, which was traced without stability.
    """
    tracer, point = _placed(problem, rest, response, options)
    with one_thread():
        return tracer.curve.examined(response, point)[0]


def multiplier_error(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    options: CurveOptions,
) -> float:
    """Return how far the largest Floquet multiplier of a response may be off.

    It is twice what the modulus changes by with another resolution (theory §6.4);
    infinite where that has no such orbit at the response's frequency.

    Parameters
    ----------
    problem, rest, options
        As for :func:`hbm.solve.frequency_response`.
    response
        On the curve.
    """
    tracer, point = _placed(problem, rest, response, options)
    with one_thread():
        seen, used = tracer.curve.examined(response, point)
        told = FourierBasis(response.harmonics, response.samples)
        resolutions = used, witness(used, told)
        *known, other = tracer.curve.multipliers.largest(point, resolutions)
    for each in (response, seen):  # of what is in doubt there are none
        known.append(float(np.abs(each.multipliers).max(initial=0.0)) or math.inf)
    errors = [abs(each - other) for each in known]
    return SLOWEST * max(errors) if np.isfinite([*known, other]).all() else math.inf


def _placed(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    options: CurveOptions,
) -> tuple[Tracer, Array]:
    """Return what traces a curve, and the point on it of a response."""
    small, still, _ = dense_problem(problem, rest, resolved_up_to(options))
    path = along_frequency(small, still, options.start, options.end)
    path = _holding(path, problem, response)
    tracer = Tracer(small, path, replace(options, stability=True))
    return tracer, tracer.guess(response, path.problem.selection)


def _holding(
    path: AlongFrequency, problem: Problem, response: PeriodicResponse
) -> AlongFrequency:
    """Return a path that has room for a response of the whole problem."""
    rows = path.every.map_from(problem.interface.displacement)
    return path.holding(response.seen(rows))
