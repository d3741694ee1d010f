"""The points of a curve so far, to which it may come back (theory §6.2)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.continuation.arc import distance, plane_across
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import Small, correct
from hbm.continuation.step_control import StepControl
from hbm.errors import PLACE, ReturnedError
from microslip_mechanics.arrays import Array

FEWEST = 4
"""steps of a closed curve"""
ASIDE = 0.1
"""length of a step from which it may pass a point, over its own"""
ALIKE = 1e-3
"""of the length of a step: points of one plane that are one are not farther apart"""
BETTER = 0.1
"""of that: how well they are solved"""
HEAD = 64
"""components of points, the first ones, that are compared with all that is known"""
BACK = 10
"""points in a row that steps pass the other way, as a curve does that retraces itself:
one has found a corner behind seven"""
AWAY = 1.1
"""length of a step, over its own, beyond which it passes no point"""


class _Known(NamedTuple):
    """A point where the curve has been, without the zeros of orders that it leaves out.

    There is room for far more components than most points of a long curve have.
    """

    point: Array
    along: Array
    """its unit tangent there"""

    def whole(self, size: int) -> _Known:
        """Return it with all components."""
        return _Known(_lengthened(self.point, size), _lengthened(self.along, size))

    def with_only(self, has: NDArray[np.bool_]) -> _Known:
        """Return it without what a coarser point has not."""
        return _Known(np.where(has, self.point, 0.0), np.where(has, self.along, 0.0))


class _Passed(NamedTuple):
    """A point that a step passes."""

    number: int
    """of those known"""
    onwards: bool
    """whether in the direction that the curve had there"""


class Trail:
    """Knows whether a step passes where the curve has been."""

    def __init__(self, system: System, control: StepControl) -> None:
        """Begin without points of a ``system``, to be solved as ``control`` asks."""
        self._system, self._control = system, control
        self._known: list[_Known] = []
        self._heads: list[Array] = []
        self._last: Array = np.empty(0)
        self._first: Correction | None = None
        self._turns: list[float] = []  # of steps in a row that passed points backwards

    @property
    def first(self) -> Correction:
        """The first point, to which a closed curve comes back."""
        if self._first is None:
            raise IndexError("a trail without points has no first one")
        return self._first

    def append(self, correction: Correction) -> None:
        """Add the point that comes next."""
        self._first = self._first or correction
        self._last = correction.point
        known = _Known(_shortened(correction.point), _shortened(correction.along))
        self._known.append(known)
        self._heads.append(_head(correction.point))

    def comes_back(self, after: Array, scale: Array) -> bool:
        """Return whether a step to ``after`` passes the first point: the curve closes.

        Raises
        ------
        ReturnedError
            If it passes another one, or several in a row the other way: a curve does
            not run into itself, but steps may have led from one branch to another, and
            would go round for ever, or back the whole way.
        """
        passed = self._passed(after, scale)
        if passed is None:
            self._turns.clear()
            return False
        if passed == (0, True):
            return True
        if not passed.onwards:
            self._turns.append(self._turned(passed.number))
            if len(self._turns) < BACK:
                return False
        raise ReturnedError(
            f"the curve comes back at {PLACE} to where it has been: a step has led "
            "from one branch to another; a smaller tolerance, or more harmonics, may "
            "tell them apart",
            float(self._heads[passed.number][-1]) if passed.onwards else self._turns[0],
        )

    def has_been_at(self, point: Array, scale: Array) -> bool:
        """Return whether a point of the system lies between two that are known.

        What is between the last ones is not looked at.
        """
        heads = np.array(self._heads[:-FEWEST]) / _head(scale)
        if len(heads) < 2:
            return False
        chords, away = np.diff(heads, axis=0), _head(point) / _head(scale) - heads[:-1]
        lengths = np.linalg.norm(chords, axis=1)
        shares = np.einsum("ij,ij->i", chords, away) / lengths**2
        aside = np.linalg.norm(away - shares[:, None] * chords, axis=1)
        between = (shares >= 0.0) & (shares <= 1.0) & (aside <= ASIDE * lengths)
        for number in np.flatnonzero(between).tolist():
            one, two = (self._known[n].whole(point.size) for n in (number, number + 1))
            guess = one.point + shares[number] * (two.point - one.point)
            if self._is(
                _Known(point, one.along), guess, scale, ALIKE * lengths[number]
            ):
                return True
        return False

    def _turned(self, number: int) -> float:
        """Return the parameter farthest ahead since a point, where the curve turned."""
        ahead = math.copysign(1.0, self._known[number].along[-1])
        return max(
            (float(each[-1]) for each in self._heads[number:]), key=ahead.__mul__
        )

    def _passed(self, after: Array, scale: Array) -> _Passed | None:
        """Return the point that a step to ``after`` passes; None if none.

        Those that it has just left are not looked at.
        """
        before = self._last
        step = (after - before) / scale
        length = float(np.linalg.norm(step))
        if len(self._heads) <= FEWEST:
            return None
        away = (np.array(self._heads[:-FEWEST]) - _head(before)) / _head(scale)
        near = np.linalg.norm(away, axis=1) <= AWAY * length
        for number in np.flatnonzero(near).tolist():
            known = self._known[number].whole(before.size)
            passed = _share(known, before, step, scale)
            if passed is None:
                continue
            share, onwards = passed
            has = after != 0.0
            has[-1] = True
            guess = np.where(has, before + share * (after - before), 0.0)
            if self._is(known.with_only(has), guess, scale, ALIKE * length):
                return _Passed(number, onwards)
        return None

    def _is(self, known: _Known, guess: Array, scale: Array, little: float) -> bool:
        """Return whether the curve at a guess is that at a known point.

        The system may have become finer or coarser since: both are solved in one plane,
        better than to what is ``little``.
        """
        normal, control = plane_across(known.along, scale), self._control
        small = Small(lambda _: BETTER * little * scale, control.loose)
        one, other = (
            correct(
                self._system, each, normal, tolerance=control.tolerance, small=small
            )
            for each in (guess + _across(guess, known, scale), known.point)
        )
        solved = one.outcome is other.outcome is Outcome.CONVERGED
        return solved and distance(one.point, other.point, scale) <= little


def _share(
    known: _Known, before: Array, step: Array, scale: Array
) -> tuple[float, bool] | None:
    """Return the share of a step at which it passes a point along its tangent, or None.

    And whether it does so in the direction of that.

    ``step`` is in units of the ``scale``.
    """
    length = float(np.linalg.norm(step))
    away = (known.point - before) / scale
    share = float(step @ away) / length**2
    aside = float(np.linalg.norm(away - share * step))
    straight = float((known.along / scale) @ step) / length
    if not (0.0 < share <= 1.0 and aside < ASIDE * length and abs(straight) > 0.5):
        return None
    return share, straight > 0.0


def _across(guess: Array, known: _Known, scale: Array) -> Array:
    """Return what leads from a guess into the plane across a known point."""
    along = known.along / scale
    way = float(along @ ((known.point - guess) / scale))
    return way / float(along @ along) * known.along


def _head(vector: Array) -> Array:
    """Return the first components and the parameter."""
    return np.append(vector[: min(HEAD, vector.size - 1)], vector[-1])


def _shortened(vector: Array) -> Array:
    """Return a vector without the zeros before its parameter."""
    kept = np.flatnonzero(vector[:-1])
    return np.append(vector[: kept[-1] + 1 if kept.size else 0], vector[-1])


def _lengthened(vector: Array, size: int) -> Array:
    """Return a shortened vector as it was."""
    whole = np.zeros(size)
    whole[: vector.size - 1], whole[-1] = vector[:-1], vector[-1]
    return whole
