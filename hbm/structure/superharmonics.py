"""Resonances of single harmonics that a step along a curve has passed (theory §6.2)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import ComplexArray

FAINT = 1e-3
"""size of a harmonic, in units of arc, below which it is not looked at"""


class Seen(NamedTuple):
    """The harmonics at a point of a curve."""

    harmonics: ComplexArray
    """in units of arc, the fundamental first, shape (harmonics, rank)"""
    step: float
    """arc that led to it"""


class Superharmonics:
    """Watches how the higher harmonics change from point to point.

    Before its resonance a harmonic grows; behind it the sign is the opposite one, seen
    from the fundamental. One that only changes its sign is smaller after half the step,
    not larger.
    """

    def __init__(self) -> None:
        """Begin without points."""
        self._kept: tuple[Seen, ...] = ()
        self._last: Seen | None = None
        self._refused: ComplexArray | None = None

    def passed(self, harmonics: ComplexArray, step: float) -> bool:
        """Return whether one turned about where the last points promised a larger one.

        Parameters
        ----------
        harmonics
            At a point, in units of arc, the fundamental first, shape (several, rank).
        step
            Arc from the point kept last.
        """
        self._last = Seen(harmonics, step)
        if len(self._kept) < 2:
            return False
        known = harmonics if self._refused is None else self._refused
        first, last = (each.harmonics for each in self._kept)
        count = min(len(each) for each in (first, last, harmonics, known))
        after = harmonics[:count]
        before, now = (_shifted(each[:count], after) for each in (first, last))
        expected = now + step / self._kept[-1].step * (now - before)
        turned = (expected.conj() * after).real.sum(axis=1) < 0.0
        if not turned.any():
            return False
        here, there, beyond = (
            np.linalg.norm(each[turned], axis=1) for each in (now, after, known[:count])
        )
        grows = there > beyond if self._refused is not None else True
        if not ((np.minimum(here, there) > FAINT) & grows).any():
            return False
        self._refused = harmonics
        return True

    def keep(self) -> None:
        """Take the point looked at last as one of the curve; begin anew without one."""
        if self._last is None:
            self._kept = ()
        else:
            self._kept = (*self._kept, self._last)[-2:]
        self._last = self._refused = None


def _shifted(harmonics: ComplexArray, other: ComplexArray) -> ComplexArray:
    """Return a motion begun when its fundamental has the phase of another one's."""
    turn = np.vdot(harmonics[:1], other[:1])
    if turn == 0.0:
        return harmonics
    orders = np.arange(1, len(harmonics) + 1)
    shifted: ComplexArray = harmonics * ((turn / abs(turn)) ** orders)[:, None]
    return shifted
