"""The points of a curve so far, to which it may come back (theory §6.2)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hbm.continuation.arc import distance, plane_across
from hbm.continuation.corrected import neglected
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import correct
from hbm.continuation.step_control import StepControl
from hbm.errors import PLACE, ReturnedError
from microslip_mechanics.arrays import Array

FEWEST = 4
"""steps of a closed curve"""
ASIDE = 0.1
"""length of a step from which it may pass a point, over its own"""
ALIKE = 1e-3
"""of the length of a step: points of one plane that are one are not farther apart"""


class _Known(NamedTuple):
    """A point where the curve has been."""

    point: Array
    along: Array
    """its unit tangent there"""


class Trail:
    """Knows whether a step passes, the same way, where the curve has been."""

    def __init__(self, system: System, control: StepControl) -> None:
        """Begin without points of a ``system``, to be solved as ``control`` asks."""
        self._system, self._control = system, control
        self._known: list[_Known] = []
        self._places: list[float] = []

    def append(self, correction: Correction) -> None:
        """Add the point that comes next."""
        self._known.append(_Known(correction.point, correction.along))
        self._places.append(float(correction.point[-1]))

    def comes_back(self, after: Array, scale: Array) -> bool:
        """Return whether a step to ``after`` passes the first point: the curve closes.

        Raises
        ------
        ReturnedError
            If it passes another one: a curve does not run into itself, but steps may
            have led from one branch to another, and would go round for ever.
        """
        number = self._passed(after, scale)
        if number:
            raise ReturnedError(
                f"the curve comes back at {PLACE} to where it has been: a step has led "
                "from one branch to another; a smaller tolerance, or more harmonics, "
                "may tell them apart",
                self._places[number],
            )
        return number == 0

    def _passed(self, after: Array, scale: Array) -> int | None:
        """Return the number of the point that a step to ``after`` passes; None if none.

        Those that it has just left are not looked at.
        """
        before = self._known[-1].point
        step = (after - before) / scale
        length = float(np.linalg.norm(step))
        places = np.array(self._places[:-FEWEST])
        near = np.abs(places - before[-1]) <= 2.0 * length * scale[-1]
        for number in np.flatnonzero(near).tolist():
            known = self._known[number]
            share = _share(known, before, step, scale)
            if share is None:
                continue
            guess = before + share * (after - before)
            if self._is(known, guess, scale, ALIKE * length):
                return int(number)
        return None

    def _is(self, known: _Known, guess: Array, scale: Array, little: float) -> bool:
        """Return whether the curve at a guess is that at a known point.

        The system may have become finer since: both are solved in one plane.
        """
        normal, control = plane_across(known.along, scale), self._control
        small = neglected(control, lambda _: scale)
        one, other = (
            correct(
                self._system, each, normal, tolerance=control.tolerance, small=small
            )
            for each in (guess + _across(guess, known, scale), known.point)
        )
        solved = one.outcome is other.outcome is Outcome.CONVERGED
        return solved and distance(one.point, other.point, scale) <= little


def _share(known: _Known, before: Array, step: Array, scale: Array) -> float | None:
    """Return the share of a step at which it passes a point in its direction, or None.

    ``step`` is in units of the ``scale``.
    """
    length = float(np.linalg.norm(step))
    away = (known.point - before) / scale
    share = float(step @ away) / length**2
    aside = float(np.linalg.norm(away - share * step))
    same = float((known.along / scale) @ step) > 0.5 * length
    return share if 0.0 < share <= 1.0 and aside < ASIDE * length and same else None


def _across(guess: Array, known: _Known, scale: Array) -> Array:
    """Return what leads from a guess into the plane across a known point."""
    along = known.along / scale
    way = float(along @ ((known.point - guess) / scale))
    return way / float(along @ along) * known.along
