"""A scene's curve with and without what is left out of it: time and difference."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice

import numpy as np

from hbm.curves.cyclic import along_sector, cyclic_response
from hbm.curves.dense_problem import RESOLVED
from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency, along_frequency
from hbm.solve import frequency_response
from microslip.progress import Watch
from microslip.scenes.rigs import problem_of, sector_of, unpruned_of
from microslip.scenes.scene import Scene
from microslip.studies.curve import curve_options
from microslip.studies.gathered import gathered
from microslip_mechanics.arrays import TINY
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve, response_curve
from microslip_mechanics.static import static_equilibrium

HARMONICS = 31
"""that are fixed where a scene's number follows from its tolerance"""


@dataclass(frozen=True, slots=True)
class Timed:
    """A curve and what it took."""

    seconds: float
    """of processor time"""
    curve: ResponseCurve
    problem: Problem
    """of which it is the curve"""
    responses: Sequence[PeriodicResponse]
    """its points"""


def path_of(scene: Scene, problem: Problem | None = None) -> AlongFrequency:
    """Return the path of a scene's curve, in what moves; of its problem if known."""
    options = curve_options(scene.curve)
    sector = sector_of(scene)
    if sector is not None:
        return along_sector(sector, options.start, options.end)
    return _path(problem or problem_of(scene), options)


def unpruned_path_of(scene: Scene, whole: Problem | None = None) -> AlongFrequency:
    """Return the path from which nothing is left out; of that problem if known."""
    options = replace(curve_options(scene.curve), pruned=False)
    return _path(whole or unpruned_of(scene), options)


def _path(problem: Problem, options: CurveOptions) -> AlongFrequency:
    if problem.structure.sparse:
        problem = reduced(problem, RESOLVED * options.end).problem
    rest = static_equilibrium(problem)
    return along_frequency(
        problem, rest, options.start, options.end, pruned=options.pruned
    )


def timed(scene: Scene, watch: Watch = iter) -> Iterator[Timed]:
    """Yield the curve of a scene as it is, then without pruning.

    Both have the same harmonics, those of the scene or :data:`HARMONICS`, no estimate
    of what more of them would change and, for one sector of a disk, no stability.

    Raises
    ------
    KeyboardInterrupt
        After the first curve, if that is interrupted.
    """
    sector, whole = sector_of(scene), unpruned_of(scene)
    fixed = replace(scene.curve, harmonics=scene.curve.harmonics or HARMONICS)
    options = replace(curve_options(fixed), errors=False, stability=sector is None)
    if sector is None:
        problem = problem_of(scene)
        some = _timed(problem, partial(_responses, problem), options, watch)
    else:
        trace = partial(cyclic_response, sector)
        some = _timed(sector.standing(), trace, options, watch)
    yield some
    if some.curve.ending == "interrupted":
        raise KeyboardInterrupt
    unpruned = replace(options, pruned=False)
    yield _timed(whole, partial(_responses, whole), unpruned, watch)


def _responses(problem: Problem, options: CurveOptions) -> Iterator[PeriodicResponse]:
    return frequency_response(problem, static_equilibrium(problem), options)


def _timed(
    problem: Problem,
    trace: Callable[[CurveOptions], Iterator[PeriodicResponse]],
    options: CurveOptions,
    watch: Watch,
) -> Timed:
    """Trace a curve and note its time, machine code being there before."""
    for _ in islice(trace(replace(options, harmonics=1, samples=32)), 3):
        pass
    began = time.process_time()
    responses, ending = gathered(watch(trace(options)))
    seconds = time.process_time() - began
    curve = response_curve(problem, responses, ending)
    return Timed(seconds, curve, problem, responses)


def difference(some: Timed, every: Timed) -> float:
    """Return by how much the amplitudes of two curves differ at most, relative.

    They are compared at both ends, and where the first has its largest amplitude: there
    an orbit is found from the two points of the second between which it lies.

    Raises
    ------
    ContinuationError
        If the second has none there.
    """
    count = min(len(some.curve.probes), len(every.curve.probes))
    largest = int(some.curve.amplitude.max(axis=1).argmax())
    there = _unpruned_at(
        every,
        float(some.curve.frequency[largest]),
        float(some.curve.amplitude[largest].max()),
    )
    one = some.curve.amplitude[[0, largest, -1], :count]
    ends = every.curve.amplitude[[0, -1], :count]
    other = np.insert(ends, 1, there.amplitude[0, :count], axis=0)
    return float(np.abs(other - one).max() / max(one.max(), TINY))


def _unpruned_at(every: Timed, frequency: float, amplitude: float) -> ResponseCurve:
    """Return the unpruned orbit at a frequency [rad/s], as a curve of one point.

    Of several its begins between points nearest to an amplitude [m].
    """
    places, sizes = every.curve.frequency, every.curve.amplitude.max(axis=1)
    low, high = np.minimum(places[:-1], places[1:]), np.maximum(places[:-1], places[1:])
    inside = np.clip(frequency, places.min(), places.max())
    sides = np.flatnonzero((low <= inside) & (inside <= high))
    left = int(sides[np.abs(sizes[sides] - amplitude).argmin()])
    share = (inside - places[left]) / ((places[left + 1] - places[left]) or 1.0)
    before, after = every.responses[left : left + 2]
    between = (1.0 - share) * before.coefficients + share * after.coefficients
    found = periodic_response(
        every.problem,
        static_equilibrium(every.problem),
        replace(before, frequency=frequency, coefficients=between),
        harmonics=before.harmonics,
        samples=before.samples,
        pruned=False,
    )
    return response_curve(every.problem, [found], "complete")
