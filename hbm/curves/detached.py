"""Curves that do not hang together with a known one, sought by the drive (theory §6.2).

At a few frequencies the drive grows from little to a multiple of its value, through
folds; and the known folds are followed as it grows and falls. A response that is passed
at the wanted drive and does not lie on a known curve is a point of another one, which
is followed to both sides until it closes. What that may cost is bounded.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from hbm.curves.drive_search import LEAST, MOST, DriveSearch, Sought
from hbm.curves.tracer import Tracer
from hbm.errors import ContinuationError, hertz
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import BEGINNINGS, PeriodicResponse

ALIKE = 0.03
"""relative difference up to which two responses are one"""
FOLLOWING = 1e5
"""evaluations for a detached curve"""
FOLDS = 15
"""that are followed along the drive at most"""


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

        After those that are found at a frequency, or from a fold, comes what the search
        there was.

        Parameters
        ----------
        known
            Responses along the known curve, in order.
        frequencies
            At which the drive is varied [rad/s].
        """
        search = DriveSearch(self.problem, self.path, self.options, self.effort)
        found, places = list(known), list(frequencies)
        for number, frequency in enumerate(places):
            candidates, sought = search.at_frequency(frequency)
            done = (number + 1) / (len(places) + len(_folds(found)))
            yield from self._unknown(candidates, replace(sought, done=done), found)
        number = 0
        while number < len(_folds(found)):  # those of what is found here as well
            fold, number = _folds(found)[number], number + 1
            done = (len(places) + number) / (len(places) + len(_folds(found)))
            for end in (MOST, LEAST):
                candidates, sought = search.from_fold(fold, end)
                yield from self._unknown(candidates, replace(sought, done=done), found)

    def _unknown(
        self,
        candidates: Sequence[PeriodicResponse],
        sought: Sought,
        found: list[PeriodicResponse],
    ) -> Iterator[PeriodicResponse | Sought]:
        """Yield the curves of candidates that do not lie on what was found, added to.

        At last comes what the search was.
        """
        for candidate in candidates:
            if self._lies_on(found, candidate):
                continue
            try:
                for each in self._followed(candidate):
                    found.append(each)
                    yield each
            except ContinuationError as cause:
                sought = replace(sought, lost=str(cause.placed(hertz)))
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


def _folds(curve: Sequence[PeriodicResponse]) -> list[PeriodicResponse]:
    """Return the folds that are followed."""
    return [each for each in curve if each.event == "fold"][:FOLDS]
