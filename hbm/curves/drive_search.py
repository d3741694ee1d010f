"""Responses at the wanted drive, sought by less and by more of it (theory §6.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hbm.continuation.corrected import correct_at
from hbm.curves.moved_fold import beside, moved_fold
from hbm.curves.response import response
from hbm.curves.tracer import Tracer
from hbm.errors import ContinuationError, drives
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from hbm.paths.path import AlongFrequency
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import BEGINNINGS, PeriodicResponse

LEAST, MOST, FAR = 0.05, 4.0, 40.0
"""drives between which is sought, over the wanted one; the last where the response is
linear up to the one before it, so that contact begins with more"""
COARSE = 1e-2
"""relative error of amplitude while seeking"""
HARMONICS = 31
"""most while seeking"""
SEEKING, MOVING = 2e3, 500.0
"""evaluations for a curve of drives, and for a fold to either side, each of which has
three Jacobians"""


@dataclass(frozen=True, slots=True)
class Sought:
    """What the search at one frequency, or from one fold, has come to."""

    frequency: float
    """[rad/s]"""
    share: float
    """largest drive up to which responses were followed, or that at which a fold was
    seen last, over the wanted one"""
    cause: str
    """why no more was reached; empty if all was"""
    lost: str
    """why a detached curve was not followed to its end; empty if none was lost"""
    fold: bool = False
    """whether it began at a fold"""
    done: float = 0.0
    """share of the whole search that is done with it"""


@dataclass(frozen=True, slots=True)
class DriveSearch:
    """Seeks responses of one problem by the drive."""

    problem: Problem
    path: AlongFrequency
    options: CurveOptions
    effort: float
    """that is granted, over the usual one"""

    def at_frequency(self, frequency: float) -> tuple[list[PeriodicResponse], Sought]:
        """Return the responses at the wanted drive that lie on one curve of drives.

        And how far that curve was followed.
        """
        passed, sought, linear = self._up_to(MOST, frequency)
        if linear:
            passed, sought, _ = self._up_to(FAR, frequency)
        return passed, sought

    def _up_to(
        self, most: float, frequency: float
    ) -> tuple[list[PeriodicResponse], Sought, bool]:
        """Return what a curve of drives up to ``most`` passes, and how far it came.

        And whether all of it is linear.
        """
        options = replace(
            self.options,
            start=LEAST,
            end=most,
            error=COARSE,
            stability=False,
            events=False,
            residual_range=False,
            contact_errors=False,
            most_harmonics=HARMONICS,
            effort=SEEKING * self.effort,
        )
        path = AlongParameter(self._driven, frequency, LEAST, most)
        passed: list[PeriodicResponse] = []
        first: PeriodicResponse | None = None
        share, cause, stopped, linear = 0.0, "", False, True
        try:
            for each in Tracer(self.problem, path, options).responses():
                stopped |= each.event in BEGINNINGS and each.parameter == most
                if first is None:
                    first = before = each
                if _between(before, each):
                    passed += self._wanted(before, each)
                linear &= _proportional(first, each)
                # a curve that stops is followed from the other end too
                before, share = each, share if stopped else max(share, each.parameter)
        except ContinuationError as error:
            cause, linear = str(error.placed(drives)), False
        return passed, Sought(frequency, share, cause, ""), linear

    def from_fold(
        self, fold: PeriodicResponse, end: float
    ) -> tuple[list[PeriodicResponse], Sought]:
        """Return a response beside the fold of another curve to which one leads.

        And how far it was followed towards the drive ``end``, over the wanted one.
        """
        harmonics = self.options.harmonics or min(fold.harmonics, HARMONICS)
        options = replace(
            self.options,
            start=1.0,
            end=end,
            harmonics=harmonics,
            effort=MOVING * self.effort,
        )
        moved = moved_fold(self._driven, fold, options)
        sought = Sought(fold.frequency, moved.share, moved.cause, "", fold=True)
        lowest, highest = sorted((self.options.start, self.options.end))
        if moved.back is None or not lowest < moved.back.frequency < highest:
            return [], sought
        tolerance = self.options.control(self.problem.force_scale).tolerance
        near = beside(self.problem, self.path, moved.back, tolerance)
        return [] if near is None else [near], sought

    def _wanted(
        self, before: PeriodicResponse, after: PeriodicResponse
    ) -> list[PeriodicResponse]:
        """Return the response at the wanted drive between two, if it converges."""
        finer = max(before, after, key=lambda each: each.harmonics)
        fourier = FourierBasis(finer.harmonics, finer.samples)
        balance = self.path.balance(fourier)
        share = (1.0 - before.parameter) / (after.parameter - before.parameter)
        motion = np.zeros((fourier.coefficients, self.problem.structure.dofs))
        for part, each in ((1.0 - share, before), (share, after)):
            count = min(len(each.coefficients), len(motion))
            motion[:count] += part * each.coefficients[:count]
        relative = motion @ self.path.problem.selection.T
        guess = balance.point(relative, before.frequency)
        try:
            correction = correct_at(
                balance, guess, self.options.control(self.problem.force_scale)
            )
            return [response(self.problem, balance, correction)]
        except ContinuationError:
            return []

    def _driven(self, share: float) -> Problem:
        return replace(self.problem, drive=share * self.problem.drive)


def _between(before: PeriodicResponse, after: PeriodicResponse) -> bool:
    """Return whether the wanted drive lies between two responses, or is the second."""
    first, last = before.parameter - 1.0, after.parameter - 1.0
    return first * last < 0.0 or (last == 0.0 and first != 0.0)


def _proportional(one: PeriodicResponse, other: PeriodicResponse) -> bool:
    """Return whether the vibrations of two responses are as their drives."""
    orders = slice(1, min(len(one.coefficients), len(other.coefficients)))
    expected = one.coefficients[orders] * (other.parameter / one.parameter)
    beside = np.linalg.norm(other.coefficients[orders] - expected)
    return bool(beside <= COARSE * np.linalg.norm(expected))
