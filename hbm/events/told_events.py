"""Events of a curve that have been told, which it may pass again (theory §6.4)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from microslip_mechanics.results.response import PeriodicResponse

ALIKE = 0.03
"""relative difference up to which two motions at one place are one"""
ROUNDED = 1e-6
"""relative difference of places that are one, beside their errors"""


class ToldEvents:
    """Tells each event once, though pieces of a curve may lie on one another.

    Beside a branch point a step may lead back to what the curve has passed, too.
    """

    def __init__(self) -> None:
        """Begin without any."""
        self._told: list[tuple[PeriodicResponse, bool]] = []

    def fresh(
        self, found: Iterable[PeriodicResponse], *, rising: bool
    ) -> Iterator[PeriodicResponse]:
        """Yield the events of a step that have not been told.

        ``rising`` is whether the parameter does so where the step begins: folds at
        which it is largest and smallest are two, close as they may be.
        """
        for each in found:
            largest = rising and each.event == "fold"
            if not any(
                _same(each, other) and largest == known for other, known in self._told
            ):
                self._told.append((each, largest))
                yield each

    def forget(self, undone: Iterable[PeriodicResponse]) -> None:
        """Let events be told again that are taken back."""
        gone = {id(each) for each in undone}
        self._told = [known for known in self._told if id(known[0]) not in gone]


def _same(one: PeriodicResponse, other: PeriodicResponse) -> bool:
    """Return whether two events are one, as far as they are known."""
    if one.event != other.event:
        return False
    errors = np.nan_to_num([one.parameter_error, other.parameter_error], posinf=0.0)
    near = float(errors.sum()) + ROUNDED * abs(one.parameter)
    if abs(one.parameter - other.parameter) > near:
        return False
    moved, known = one.coefficients[:3], other.coefficients[:3]
    return bool(np.linalg.norm(moved - known) <= ALIKE * np.linalg.norm(known[1:]))
