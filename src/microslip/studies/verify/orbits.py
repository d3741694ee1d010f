"""Whether shooting finds the orbits of a traced curve, and which one it does not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from microslip.studies.curve import Traced
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.comparison import COVERAGE, FLOOR, Comparison, compared

CURVES = {"branch": "branch", "detached": "detached curve"}
"""events with which another curve begins, and what it is called"""
UNKNOWN = "of unknown stability"


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of one orbit."""

    response: PeriodicResponse
    """by harmonic balance"""
    whereabouts: str
    """on which part of the curve it lies"""
    comparison: Comparison | None
    """None if shooting reached no orbit"""
    cause: str
    """why the two disagree; empty if they agree"""

    @property
    def doubted(self) -> bool:
        """Whether shooting denies the stability that harmonic balance reports."""
        return self.comparison is not None and not self.comparison.as_stable


def verdicts(
    problem: Problem, traced: Traced, chosen: Sequence[int], *, tolerance: float
) -> Iterator[Verdict]:
    """Yield the verdict on each chosen point of a curve.

    Parameters
    ----------
    problem
        What was traced.
    traced
        The curve, and what was found beside it.
    chosen
        Places on it.
    tolerance
        Relative difference of an amplitude that is not accepted even where the
        estimates account for it.
    """
    names = whereabouts(traced.responses)
    for place in chosen:
        response, where = traced.responses[place], names[place]
        try:
            comparison = compared(problem, response)
        except ShootingError as error:
            yield Verdict(response, where, None, str(error))
        else:
            where = where.replace(UNKNOWN, _shot(comparison))
            yield Verdict(response, where, comparison, _cause(comparison, tolerance))


def beyond(found: Sequence[Verdict]) -> list[Verdict]:
    """Return those whose amplitudes differ by more than both estimates.

    A quarter may, since estimates are no bounds; see :func:`too_many`.
    """
    return [
        each
        for each in found
        if each.comparison is None or not each.comparison.as_estimated
    ]


def too_many(found: Sequence[Verdict]) -> bool:
    """Return whether more than one, and more than a quarter, are beyond them."""
    return len(beyond(found)) > max(1, len(found) // 4)


def spread(traced: Traced, count: int) -> list[int]:
    """Return places spread evenly along all that was traced, stable or not.

    Even in arc: half of the weight is frequency, half is amplitude, so that the flanks
    of a resonance get their share; the peak and both ends are always among them. Points
    at which events were located are left out but for peaks: at a fold, orbits end, and
    what is as near to it as that may be wrong may be beyond.
    """
    curve = traced.curve
    ends = _folding(curve)
    kept = [
        place
        for place, name in enumerate(curve.event)
        if name in ("", "peak") and place not in ends
    ]
    amplitude, frequency = curve.amplitude[kept].max(axis=1), curve.frequency[kept]
    arc = _arc(amplitude) + _arc(frequency)
    wanted = np.linspace(arc[0], arc[-1], count)
    places = {int(np.abs(arc - place).argmin()) for place in wanted}
    places |= {0, int(amplitude.argmax()), len(kept) - 1}
    return [kept[place] for place in sorted(places)]


def _folding(curve: ResponseCurve) -> set[int]:
    """Return the places of folds, and of points that may be beyond one next to them."""
    ends: set[int] = set()
    for fold in (place for place, name in enumerate(curve.event) if name == "fold"):
        away = np.abs(curve.parameter - curve.parameter[fold])
        outside = np.flatnonzero(away > np.nan_to_num(curve.parameter_error[fold]))
        first = outside[outside < fold].max(initial=-1)
        last = outside[outside > fold].min(initial=len(away))
        ends.update(range(first + 1, last))
    return ends


def whereabouts(responses: Sequence[PeriodicResponse]) -> list[str]:
    """Return in words on which part of the curve each point lies.

    Stable or not; on a branch or a detached curve; before or after which fold of it.
    """
    names, begun = [], dict.fromkeys(CURVES, 0)
    curve, folds = "", 0
    total = _folds(responses, 0)
    for place, response in enumerate(responses):
        if response.event in CURVES:
            begun[response.event] += 1
            curve = f"{CURVES[response.event]} {begun[response.event]}"
            folds, total = 0, _folds(responses, place)
        folds += response.event == "fold"
        parts = [_stability(response), curve, _side(folds, total)]
        names.append(", ".join(part for part in parts if part))
    return names


def _folds(responses: Sequence[PeriodicResponse], first: int) -> int:
    """Return the number of folds on the curve that begins at a place."""
    count = 0
    for place, response in enumerate(responses[first:]):
        if place > 0 and response.event in CURVES:
            break
        count += response.event == "fold"
    return count


def _stability(response: PeriodicResponse) -> str:
    if response.unstable < 0:
        return UNKNOWN
    return "unstable" if response.unstable else "stable"


def _shot(comparison: Comparison) -> str:
    """Return what shooting says of the stability, as far as its multipliers tell."""
    if comparison.found_stable is None:
        return UNKNOWN
    return f"{'stable' if comparison.found_stable else 'unstable'} by shooting"


def _side(folds: int, total: int) -> str:
    if total == 0:
        return ""
    return f"after fold {folds}" if folds else "before the first fold"


def _arc(values: Array) -> Array:
    """Return the share of the way that values have gone at each point."""
    way = np.cumsum(np.abs(np.diff(values, prepend=values[0])))
    arc: Array = way / max(float(way[-1]), TINY)
    return arc


def _cause(comparison: Comparison, tolerance: float) -> str:
    """Return why the two disagree; empty if they agree."""
    apart = f"amplitudes differ by {comparison.difference:.1e}"
    orders = ", ".join(
        f"{order} ({comparison.harmonics[order]:.0e})" for order in comparison.worst()
    )
    if not comparison.agrees:
        return (
            f"{apart}, more than {COVERAGE:g} x the estimate "
            f"{comparison.predicted_error:.1e} of harmonic balance, that of shooting "
            f"{comparison.found_error:.1e} and the floor {FLOOR:g} together; "
            f"harmonics that differ most: {orders}"
        )
    if comparison.difference > tolerance:
        return (
            f"{apart}, more than the tolerance {tolerance:g}; "
            f"harmonics that differ most: {orders}"
        )
    return ""
