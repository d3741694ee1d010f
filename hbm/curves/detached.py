"""Curves that do not hang together with a known one, sought by the drive (theory §6.2).

At a few frequencies the drive grows from little to a multiple of its value, through
folds. A response that is passed at the wanted drive and does not lie on a known curve
is a point of another one, which is followed to both sides until it closes. What that
may cost is bounded.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from hbm.continuation.corrected import correct_at
from hbm.curves.curve import response
from hbm.curves.tracer import Tracer
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from hbm.paths.path import AlongFrequency
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import BEGINNINGS, PeriodicResponse

LEAST, MOST = 0.05, 4.0
"""drives between which is sought, over the wanted one"""
COARSE = 1e-2
"""relative error of amplitude while seeking"""
HARMONICS = 31
"""most while seeking"""
ALIKE = 0.03
"""relative difference up to which two responses are one"""
SEEKING, FOLLOWING = 2e3, 1e5
"""evaluations for a curve of drives, and for a detached curve"""


@dataclass(frozen=True, slots=True)
class Sought:
    """What the search at one frequency has come to."""

    frequency: float
    """[rad/s]"""
    share: float
    """largest drive up to which responses were followed, over the wanted one"""
    cause: str
    """why no larger one was reached; empty if all were"""
    lost: str
    """why a detached curve was not followed to its end; empty if none was lost"""


@dataclass(frozen=True, slots=True)
class Search:
    """Where detached curves of one problem are sought."""

    problem: Problem
    path: AlongFrequency
    options: CurveOptions
    effort: float = 1.0
    """that is granted, over the usual one"""

    def curves(
        self,
        known: Sequence[PeriodicResponse],
        frequencies: Iterable[float],
    ) -> Iterator[PeriodicResponse | Sought]:
        """Yield the responses on detached curves, the first of each side marked so.

        After those that are found at a frequency comes what the search there was.

        Parameters
        ----------
        known
            Responses along the known curve, in order.
        frequencies
            At which the drive is varied [rad/s].
        """
        found = list(known)
        for frequency in frequencies:
            candidates, sought = self._at_frequency(frequency)
            for candidate in candidates:
                if self._lies_on(found, candidate):
                    continue
                try:
                    for each in self._followed(candidate):
                        found.append(each)
                        yield each
                except ContinuationError as cause:
                    sought = replace(sought, lost=str(cause))
            yield sought

    def _followed(self, candidate: PeriodicResponse) -> Iterator[PeriodicResponse]:
        """Yield the responses to both sides of one.

        Raises
        ------
        ContinuationError
            If they cannot be followed to their end.
        """
        options = replace(self.options, effort=FOLLOWING * self.effort)
        tracer = Tracer(self.problem, self.path, options)
        selection = self.path.problem.selection
        yield from tracer.from_response(candidate, selection, "detached")

    def _at_frequency(self, frequency: float) -> tuple[list[PeriodicResponse], Sought]:
        """Return the responses at the wanted drive that lie on one curve of drives.

        And how far that curve was followed.
        """
        options = replace(
            self.options,
            start=LEAST,
            end=MOST,
            error=COARSE,
            stability=False,
            events=False,
            residual_range=False,
            most_harmonics=HARMONICS,
            effort=SEEKING * self.effort,
        )
        path = AlongParameter(self._driven, frequency, LEAST, MOST)
        tracer = Tracer(self.problem, path, options)
        passed: list[PeriodicResponse] = []
        before: PeriodicResponse | None = None
        share, cause, stopped = 0.0, "", False
        try:
            for each in tracer.responses():
                stopped |= each.event in BEGINNINGS and each.parameter == MOST
                if before is not None and _between(before, each):
                    passed += self._wanted(before, each)
                # a curve that stops is followed from the other end too
                before, share = each, share if stopped else max(share, each.parameter)
        except ContinuationError as error:
            cause = str(error)
        return passed, Sought(frequency, share, cause, "")

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

    def _lies_on(
        self, curve: Sequence[PeriodicResponse], candidate: PeriodicResponse
    ) -> bool:
        """Return whether a response, in its probes' first harmonic, lies on a curve."""
        sought = self._first_harmonic(candidate)
        size = float(np.abs(sought).max())
        for before, after in pairwise(curve):
            width = after.frequency - before.frequency
            share = (candidate.frequency - before.frequency) / width if width else 0.0
            if after.event not in BEGINNINGS and 0.0 <= share <= 1.0:
                one, two = self._first_harmonic(before), self._first_harmonic(after)
                away = np.abs(one + share * (two - one) - sought).max()
                if away <= ALIKE * size + 0.5 * np.abs(two - one).max():
                    return True
        return False

    def _first_harmonic(self, response: PeriodicResponse) -> ComplexArray:
        """Return order 1 of the probes [m]."""
        cosine, sine = response.coefficients[1:3] @ self.problem.probes.rows.T
        amplitudes: ComplexArray = cosine - 1j * sine
        return amplitudes


def _between(before: PeriodicResponse, after: PeriodicResponse) -> bool:
    """Return whether the wanted drive lies between two responses, or is the second."""
    first, last = before.parameter - 1.0, after.parameter - 1.0
    return first * last < 0.0 or (last == 0.0 and first != 0.0)
