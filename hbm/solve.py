"""The public functions: from a problem to periodic responses along curves."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from hbm.along_parameter import AlongParameter
from hbm.branches import Branching
from hbm.condensation import CondensedStructure
from hbm.continuation import correct_at
from hbm.curve import response
from hbm.detached import Search, Sought
from hbm.errors import hertz, placed
from hbm.fold_curve import FoldCurve, FoldPoint
from hbm.fourier import FourierBasis
from hbm.linear_curve import linear_curve
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.path import along_frequency
from hbm.step_control import StepControl
from hbm.tracer import Tracer
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction import reduced
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState

RESOLVED = 16.0
"""a sparse structure is resolved up to this multiple of the excitation frequency"""


def frequency_response(
    problem: Problem, rest: StaticState, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses along the curve, one per continuation step.

    Parameters
    ----------
    problem
        What is solved.
    rest
        Its static equilibrium: the curve starts from it.
    options
        Range, accuracy, harmonics.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    ValueError
        If a frequency is not positive.
    """
    small, still, shapes = _small(problem, rest, options.highest or _most(options))
    path = along_frequency(
        small, still, options.start, options.end, pruned=options.pruned
    )
    tracer, condensed = Tracer(small, path, options), path.problem.condensed
    responses = tracer.responses()
    if path.rank == 0 and isinstance(condensed, CondensedStructure):
        linear = linear_curve(condensed, path.problem.force[1], small.probes.rows)
        responses = tracer.at_places(linear.places(options.start, options.end))
    with one_thread(), placed(hertz):
        for made in responses:
            yield replace(made, shapes=shapes)


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
        As for :func:`frequency_response`.
    response
        On the curve, which was traced without stability.
    """
    small, still, _ = _small(problem, rest, options.highest or _most(options))
    path = along_frequency(small, still, options.start, options.end)
    tracer = Tracer(small, path, replace(options, stability=True))
    point = tracer.guess(response, path.problem.selection)
    with one_thread():
        return tracer.curve.examined(response, point)


def branches(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
) -> Iterator[PeriodicResponse]:
    """Yield the responses on the branches that begin at branch points of a curve.

    The first of each branch has ``event = "branch"``.

    Parameters
    ----------
    problem, rest, options
        As for :func:`frequency_response`.
    known
        The responses on the curve.

    Raises
    ------
    ContinuationError
        If a branch cannot go on; what was yielded before stays valid.
    """
    small, still, shapes = _small(problem, rest, options.highest or _most(options))
    path = along_frequency(small, still, options.start, options.end, symmetry=False)
    with one_thread(), placed(hertz):
        for made in Branching(small, path, options).curves(known):
            yield replace(made, shapes=shapes)


def detached(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
    *,
    frequencies: int = 15,
    effort: float = 1.0,
) -> Iterator[PeriodicResponse | Sought]:
    """Yield the responses on curves that do not hang together with known ones.

    They are sought by homotopy in the drive at some frequencies, spread evenly. The
    first response to each side has ``event = "detached"``. After those found at a
    frequency comes what the search there was.

    Parameters
    ----------
    problem, rest, options
        As for :func:`frequency_response`.
    known
        The responses on the known curve.
    frequencies
        Number of them.
    effort
        What the search may cost, over the usual (theory §6).

    Raises
    ------
    ValueError
        If the effort is not positive.
    """
    if not 0.0 < effort < np.inf:
        raise ValueError(f"effort {effort:g}: give a positive number")
    small, still, shapes = _small(problem, rest, options.highest or _most(options))
    path = along_frequency(small, still, options.start, options.end)
    shares = (np.arange(frequencies) + 0.5) / frequencies
    places = options.start + shares * (options.end - options.start)
    with one_thread(), placed(hertz):
        search = Search(small, path, options, effort)
        for made in search.curves(known, places.tolist()):
            if isinstance(made, Sought):
                yield made
            else:
                yield replace(made, shapes=shapes)


def parameter_response(
    problem_at: Callable[[float], Problem], frequency: float, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses at one frequency along a parameter, through folds.

    Parameters
    ----------
    problem_at
        Value of the parameter ↦ what is solved.
    frequency
        Of the excitation [rad/s].
    options
        Range of the parameter, accuracy, harmonics.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    ValueError
        If the frequency is not positive.
    """
    path = AlongParameter(problem_at, frequency, options.start, options.end)
    tracer = Tracer(_driven(problem_at, options), path, options)
    with one_thread():
        yield from tracer.responses()


def fold_curve(
    problem_at: Callable[[float], Problem],
    fold: PeriodicResponse,
    options: CurveOptions,
) -> Iterator[FoldPoint]:
    """Yield the folds into which a fold of a frequency response curve moves.

    Parameters
    ----------
    problem_at
        Value of the parameter ↦ what is solved.
    fold
        Of the curve at ``options.start``, as it was located.
    options
        Range of the parameter, harmonics; left open, those of the fold, at most
        :data:`~hbm.fold_curve.HARMONICS`.

    Raises
    ------
    ContinuationError
        If the fold is lost; what was yielded before stays valid.
    """
    path = AlongParameter(problem_at, fold.frequency, options.start, options.end)
    with one_thread():
        problem = _driven(problem_at, options)
        yield from FoldCurve(problem, path, options, fold).points()


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
    small, still, shapes = _small(problem, rest, highest)
    path = along_frequency(
        small, still, guess.frequency, guess.frequency, pruned=pruned
    )
    balance = path.balance(FourierBasis(harmonics, samples))
    rows = path.problem.map_from(problem.interface.displacement)
    start = balance.pushed(balance.point(guess.seen(rows), guess.frequency))
    with one_thread(), placed(hertz):
        correction = correct_at(balance, start, control)
    return replace(response(small, balance, correction), shapes=shapes)


def settled_response(
    problem: Problem,
    rest: StaticState,
    guess: PeriodicResponse,
    *,
    error: float,
    highest: float | None = None,
) -> PeriodicResponse:
    """Return the response at the frequency of ``guess`` to a stated error.

    Harmonics and samples grow from one harmonic of the guess until the estimated
    relative error of the amplitude is below ``error``, or until there are no more.

    Raises
    ------
    ContinuationError
        If the point does not converge.
    """
    frequency = guess.frequency
    small, still, shapes = _small(problem, rest, highest or RESOLVED * frequency)
    path = along_frequency(small, still, frequency, frequency)
    around = CurveOptions(frequency, 2.0 * frequency, error=error, stability=False)
    tracer = Tracer(small, path, around)
    rows = path.problem.map_from(problem.interface.displacement)
    first = guess.seen(rows)[:3].ravel()
    start = np.zeros(tracer.system.size)
    start[: first.size], start[-1] = first, frequency
    with one_thread(), placed(hertz):
        found = correct_at(tracer.system, start, tracer.control, tracer.system)
        made = next(tracer.curve.followed([found], tracer.pieces.metric))
    return replace(made, shapes=shapes)


def _driven(problem_at: Callable[[float], Problem], options: CurveOptions) -> Problem:
    """Return the problem at the end of a range, at its beginning if nothing drives it.

    Its loads say what is large.
    """
    last = problem_at(options.end)
    return last if last.drive.any() else problem_at(options.start)


def _most(options: CurveOptions) -> float:
    """Return the frequency up to which a sparse structure is resolved [rad/s]."""
    return RESOLVED * max(options.start, options.end)


def _small(
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
