"""The search for detached curves: what it has found, and where it has looked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from hbm.curves.drive_search import FAR, LEAST, MOST, Sought
from hbm.errors import drives
from hbm.options import CurveOptions
from hbm.solve import detached
from microslip.interruption import unmasked
from microslip.progress import Watch
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState

FREQUENCIES = 15
"""at which the drive is varied"""


@dataclass(frozen=True, slots=True)
class Searched:
    """What a search has come to."""

    responses: tuple[PeriodicResponse, ...]
    """on detached curves"""
    sought: tuple[Sought, ...]
    """for each frequency that was searched, and for each fold to either side"""
    folds: int
    """of all curves"""
    interrupted: bool

    @property
    def ending(self) -> str:
        """``"complete"``, also where the effort did not suffice, or why it ended."""
        if self.interrupted:
            return "interrupted"
        lost = [each.lost for each in self.sought if each.lost]
        return f"a detached curve was lost: {lost[0]}" if lost else "complete"

    def lines(self) -> list[str]:
        """Return in words what was searched, what was not, and what was found."""
        hertz = [each.frequency / math.tau for each in self.sought if not each.fold]
        if not hertz:
            return ["no detached curve was sought: the search was interrupted before"]
        found = sum(each.event == "detached" for each in self.responses)
        lines = [
            f"detached curves sought at {len(hertz)} of {FREQUENCIES} frequencies, "
            f"{min(hertz):.3f} to {max(hertz):.3f} Hz, by {LEAST:g} to {MOST:g} times "
            "the drive",
        ]
        if any(not each.fold and each.share > MOST for each in self.sought):
            lines[0] += f", and to {FAR:g} times where it is linear up to there"
        if self.folds:
            followed = sum(each.fold for each in self.sought) // 2
            lines.append(
                f"and from {followed} of {self.folds} folds, followed to {MOST:g} and "
                f"{LEAST:g} times the drive or until they come back"
            )
        lines += [_unfinished(each) for each in self.sought if each.cause]
        if found == 0:
            lines.append("no detached curve was found")
        return lines


def _unfinished(sought: Sought) -> str:
    """Return how far one search came, and why no further."""
    hertz, share = sought.frequency / math.tau, drives(sought.share)
    if sought.fold:
        return f"the fold at {hertz:.3f} Hz only to {share}: {sought.cause}"
    return f"at {hertz:.3f} Hz only up to {share}: {sought.cause}"


def search(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
    *,
    effort: float,
    watch: Watch,
) -> Searched:
    """Seek curves that do not hang together with a known one; keep what there is.

    Parameters
    ----------
    problem, rest, options
        As for :func:`hbm.solve.frequency_response`.
    known
        Responses on the known curve.
    effort
        What the search may cost, over the usual.
    watch
        Sees the responses, and what each step of the search has come to.
    """
    responses: list[PeriodicResponse] = []
    sought: list[Sought] = []
    found = detached(
        problem, rest, options, known, frequencies=FREQUENCIES, effort=effort
    )
    interrupted = False
    try:
        with unmasked():
            for each in watch(found):
                if isinstance(each, Sought):
                    sought.append(each)
                else:
                    responses.append(each)
    except KeyboardInterrupt:
        interrupted = True
    folds = sum(each.event == "fold" for each in (*known, *responses))
    return Searched(tuple(responses), tuple(sought), folds, interrupted)
