"""The points of a curve so far, to which it may come back (theory §6.2)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from hbm.continuation.arc import distance, plane_across
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.known import ASIDE, Known, head, shortened
from hbm.continuation.linearised import System
from hbm.continuation.newton import Small, correct
from hbm.continuation.step_control import StepControl
from hbm.errors import PLACE, RetracedError, ReturnedError
from microslip_mechanics.arrays import TINY, Array

FEWEST = 4
"""steps of a closed curve"""
ALIKE = 1e-3
"""of the length of a step: points of one plane that are one are not farther apart"""
BETTER = 0.1
"""of that: how well they are solved"""
BACK = 10
"""points in a row that steps pass the other way, as a curve does that retraces itself:
one has found a corner behind seven"""
AWAY = 1.1
"""length of a step, over its own, beyond which it passes no point"""


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
        self._known: list[Known] = []
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
        known = Known(shortened(correction.point), shortened(correction.along))
        self._known.append(known)
        self._heads.append(head(correction.point))

    def comes_back(self, after: Array, scale: Array) -> bool:
        """Return whether a step to ``after`` passes the first point: the curve closes.

        Raises
        ------
        ReturnedError
            If it passes another one: a curve does not run into itself, but steps may
            have led from one branch to another, and would go round for ever.
        RetracedError
            If it passes several in a row the other way, and would go back all the way.
        """
        passed = self._passed(after, scale)
        if passed is None:
            self._turns.clear()
            return False
        if passed == (0, True):
            return True
        text = (
            f"the curve comes back at {PLACE} to where it has been: a step has led "
            "from one branch to another; a smaller tolerance, or more harmonics, may "
            "tell them apart"
        )
        if passed.onwards:
            raise ReturnedError(text, float(self._heads[passed.number][-1]))
        self._turns.append(self._turned(passed.number))
        if len(self._turns) >= BACK:
            raise RetracedError(text, self._turns[0])
        return False

    def has_been_at(self, point: Array, scale: Array) -> bool:
        """Return whether a point of the system lies between two that are known.

        What is between the last ones is not looked at.
        """
        if len(self._heads) < FEWEST + 2:
            return False
        heads = np.array(self._heads[:-FEWEST]) / head(scale)
        chords, away = np.diff(heads, axis=0), head(point) / head(scale) - heads[:-1]
        lengths = np.linalg.norm(chords, axis=1)
        shares = np.einsum("ij,ij->i", chords, away) / (lengths**2).clip(min=TINY)
        aside = np.linalg.norm(away - shares[:, None] * chords, axis=1)
        between = (shares >= 0.0) & (shares <= 1.0) & (aside <= ASIDE * lengths)
        for number in np.flatnonzero(between).tolist():
            one, two = (self._known[n].whole(point.size) for n in (number, number + 1))
            guess = one.point + shares[number] * (two.point - one.point)
            if self._is(Known(point, one.along), guess, scale, ALIKE * lengths[number]):
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
        away = (np.array(self._heads[:-FEWEST]) - head(before)) / head(scale)
        near = np.linalg.norm(away, axis=1) <= AWAY * length
        for number in np.flatnonzero(near).tolist():
            known = self._known[number].whole(before.size)
            passed = known.passed(before, step, scale)
            if passed is None:
                continue
            share, onwards = passed
            has = after != 0.0
            has[-1] = True
            guess = np.where(has, before + share * (after - before), 0.0)
            if self._is(known.with_only(has), guess, scale, ALIKE * length):
                return _Passed(number, onwards)
        return None

    def _is(self, known: Known, guess: Array, scale: Array, little: float) -> bool:
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
            for each in (known.across(guess, scale), known.point)
        )
        solved = one.outcome is other.outcome is Outcome.CONVERGED
        return solved and distance(one.point, other.point, scale) <= little
