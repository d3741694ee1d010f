"""Extremes of a history, and what its rows may miss of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.between_rows import bent, halves, largest
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory


@dataclass(frozen=True, slots=True)
class Extremes:
    """Extremes of probes and of contacts."""

    largest: Array
    """displacement [m] and velocity [m/s], shape (2, probes)"""
    halves: Array
    """the same with every second row, shape (2, 2, probes)"""
    normal: Array
    """least and largest normal force at the rows [N], shape (2, contacts)"""
    bent: Array
    """what they may be between the rows [N], shape (2, contacts)"""

    @property
    def errors(self) -> Array:
        """Relative ones of the largest displacement and of the largest velocity.

        They are what half of the rows change, the worse ones: far more than all rows
        err by if they are dense.
        """
        away = np.abs(self.halves - self.largest).max(axis=(0, 2), initial=0.0)
        size = self.largest.max(axis=1, initial=0.0)
        found: Array = away / np.where(size > 0.0, size, 1.0)
        return found

    @property
    def force_error(self) -> float:
        """About what rows miss of the extremes of normal forces, over the largest."""
        missed = float(np.abs(self.bent - self.normal).max(initial=0.0))
        return missed / (float(np.abs(self.normal).max(initial=0.0)) or 1.0)


def extremes(history: TimeHistory | Envelope) -> Extremes:
    """Return the extremes of a history, or of an envelope, which misses none."""
    if isinstance(history, Envelope):
        return _enveloped(history)
    rows = history.time, history.displacement, history.velocity
    normal = history.normal_force
    return Extremes(
        largest(*rows),
        halves(*rows),
        np.stack([normal.min(axis=0), normal.max(axis=0)]),
        bent(normal),
    )


def _enveloped(envelope: Envelope) -> Extremes:
    """Return the extremes of an envelope."""
    far = np.maximum(-envelope.lowest, envelope.highest).max(axis=0)
    found = np.stack([far, envelope.fastest.max(axis=0)])
    ends = envelope.normal_smallest.min(axis=0), envelope.normal_largest.max(axis=0)
    return Extremes(found, np.stack([found, found]), np.stack(ends), np.stack(ends))


def of_all(parts: Sequence[Extremes]) -> Extremes:
    """Return the extremes of a history from those of its parts."""

    def ends(name: str) -> Array:
        values = np.array([getattr(each, name) for each in parts])
        return np.stack([values[:, 0].min(axis=0), values[:, 1].max(axis=0)])

    return Extremes(
        np.stack([each.largest for each in parts]).max(axis=0),
        np.stack([each.halves for each in parts]).max(axis=0),
        ends("normal"),
        ends("bent"),
    )
