"""The search for detached curves: what it has found, and where it has looked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from hbm.curves.detached import LEAST, MOST, Sought
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
    """for each frequency that was searched"""
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
        hertz = [each.frequency / math.tau for each in self.sought]
        if not hertz:
            return ["no detached curve was sought: the search was interrupted before"]
        found = sum(each.event == "detached" for each in self.responses)
        lines = [
            f"detached curves sought at {len(hertz)} of {FREQUENCIES} frequencies, "
            f"{min(hertz):.3f} to {max(hertz):.3f} Hz, by {LEAST:g} to {MOST:g} times "
            "the drive",
            *(
                f"at {each.frequency / math.tau:.3f} Hz only up to {each.share:.3g} "
                f"times the drive: {each.cause}"
                for each in self.sought
                if each.cause
            ),
        ]
        if found == 0:
            lines.append("no detached curve was found")
        return lines


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
        Sees the responses and the frequencies that are done.
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
    return Searched(tuple(responses), tuple(sought), interrupted)
