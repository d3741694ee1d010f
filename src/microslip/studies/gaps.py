"""What lies between the pieces of a curve, where none was found (theory §6.2)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hbm.errors import REMEDY
from microslip_mechanics.results.response_curve import ResponseCurve

NARROW = 0.01
"""share of its range that a whole curve may leave out"""
SLIGHT = 1e-3
"""share of its range that it may leave out beside its largest amplitude"""
MISSING = "no curve is found between"
"""begins the ending of a curve that comes to its end with a gap"""
BROKEN = "the curve breaks off at"
"""begins the ending of one that comes to its end without what a fold has begun"""
ALIKE = 0.05
"""relative difference of the amplitudes of points that may be beside each other"""
SAME = 0.01
"""the same where a piece has been before, between points of which it is interpolated"""
OTHERS = ("branch", "detached")
"""marks of the first point of what does not belong to the curve itself"""


def told(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve whose ending says where it is missing, if that is not narrow."""
    wide = uncovered(curve) > NARROW or _may_hide_peak(curve)
    lost = [*(_gap_lines(curve) if wide else []), *_broken_lines(curve)]
    if curve.ending != "complete" or not lost:
        return curve
    return replace(curve, ending=f"{' and '.join(lost)}: {REMEDY}")


def lines(curve: ResponseCurve) -> list[str]:
    """Return what is said of each gap, and of each end that is none."""
    return [*_gap_lines(curve), *_broken_lines(curve)]


def _gap_lines(curve: ResponseCurve) -> list[str]:
    unit, aside = _unit(curve)
    return [
        f"{MISSING} {low / unit:.8g} and {high / unit:.8g}{aside}"
        for low, high in gaps(curve)
    ]


def _broken_lines(curve: ResponseCurve) -> list[str]:
    unit, aside = _unit(curve)
    return [
        f"{BROKEN} {place / unit:.8g}{aside}, and what lies behind is missing"
        for place in broken(curve)
    ]


def _unit(curve: ResponseCurve) -> tuple[float, str]:
    """Return the unit of what the curve is followed along, and its name."""
    return (1.0, f" of {curve.along}") if curve.along else (math.tau, " Hz")


def uncovered(curve: ResponseCurve) -> float:
    """Return the share of a curve's range that lies between its pieces."""
    found = gaps(curve)
    if not found:
        return 0.0
    own = _own(curve)
    return sum(high - low for low, high in found) / float(own.max() - own.min())


def _may_hide_peak(curve: ResponseCurve) -> bool:
    """Return whether a curve's largest amplitude may lie between its pieces."""
    own, size = _own(curve), curve.amplitude.max(axis=1, initial=0.0)
    for low, high in gaps(curve):
        beside = size[: own.size][(own == low) | (own == high)].max()
        wide = high - low > SLIGHT * float(own.max() - own.min())
        if wide and beside >= (1.0 - ALIKE) * size.max(initial=0.0):
            return True
    return False


def missing(curve: ResponseCurve, lowest: float, highest: float) -> float:
    """Return the share of a range of the parameter in which a curve has no point."""
    own = _own(curve)
    covered = float(own.max() - own.min()) * (1.0 - uncovered(curve))
    return max(0.0, 1.0 - covered / (highest - lowest))


def gaps(curve: ResponseCurve) -> list[tuple[float, float]]:
    """Return the ends of what no piece covers, along what the curve is followed."""
    own = _own(curve)
    begins = [n for n, name in enumerate(curve.event[: own.size]) if name == "restart"]
    pieces = sorted(
        (float(piece.min()), float(piece.max()))
        for piece in np.split(own, begins)
        if piece.size
    )
    found: list[tuple[float, float]] = []
    reached = math.inf
    for low, high in pieces:
        if low > reached:
            found.append((reached, low))
        reached = high if math.isinf(reached) else max(reached, high)
    return found


def broken(curve: ResponseCurve) -> list[float]:
    """Return where pieces break off, along what the curve is followed.

    That is within the range, and where no later piece goes on with about that
    amplitude, though one should: behind a fold, whose way back does not lead there;
    where the next piece begins no farther on, so that no gap lies between; or where
    what comes in at an end ends, the last of a curve that is complete without it. Of a
    piece that goes back on itself it is where it turned.
    """
    own = _own(curve)
    size = curve.amplitude[: own.size].max(axis=1, initial=0.0)
    begins = [n for n, name in enumerate(curve.event[: own.size]) if name == "restart"]
    found: list[float] = []
    for first, after in zip([0, *begins], [*begins, own.size], strict=True):
        last = after - 1
        steps = np.diff(own[first:after])
        back = steps.size > 1 and steps[0] * steps[-1] < 0.0
        if after == own.size:
            back |= curve.ending == "complete"
        else:
            back |= (own[after] - own[last]) * steps.sum() <= 0.0
        end = first + _end(own[first:after], size[first:after])
        inside = own.min() < own[last] < own.max()
        if back and inside and not _goes_on(own, size, end, after):
            found.append(float(own[end]))
    return found


def _end(own: np.ndarray, size: np.ndarray) -> int:
    """Return the point at which a piece ends: where it turned to go back on itself.

    That is what lies between its end and where it had been there before.
    """
    place = float(own[-1])
    before, sizes = own[:-1], size[:-1]
    passes = np.flatnonzero((before[:-1] - place) * (before[1:] - place) < 0.0)
    shares = (place - before[passes]) / (before[passes + 1] - before[passes])
    there = sizes[passes] + shares * (sizes[passes + 1] - sizes[passes])
    alike = passes[np.abs(there - size[-1]) <= SAME * size[-1]]
    if not alike.size:
        return own.size - 1
    since = int(alike[-1]) + 1
    return since + int(np.abs(before[since:] - place).argmax())


def _goes_on(own: np.ndarray, size: np.ndarray, end: int, after: int) -> bool:
    """Return whether a piece from ``after`` on begins where one ends, or passes there.

    ``end`` is the number of the point at which it ends.
    """
    later, sizes = own[after:], size[after:]
    passing = (later[:-1] - own[end]) * (later[1:] - own[end]) <= 0.0
    near = np.append(sizes[:1], 0.5 * (sizes[:-1] + sizes[1:])[passing])
    alike = np.abs(near - size[end]) <= ALIKE * np.maximum(near, size[end])
    return bool(alike.any())


def _own(curve: ResponseCurve) -> np.ndarray:
    """Return the parameter of the curve's points, without what hangs off it."""
    first = next((n for n, name in enumerate(curve.event) if name in OTHERS), None)
    return curve.parameter[:first]
