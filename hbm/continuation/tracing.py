"""What is traced and how, wherever a trace begins (theory §6.2)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from hbm.continuation.arc import Metric
from hbm.continuation.continuation import trace
from hbm.continuation.correction import Correction
from hbm.continuation.linearised import System
from hbm.continuation.settler import Settler
from hbm.continuation.step_control import StepControl
from hbm.continuation.trail import Trail
from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Tracing:
    """All that :func:`~hbm.continuation.continuation.trace` asks but where to begin."""

    system: System
    end: float
    """value of the parameter at which the curve ends"""
    begin: float
    """the other one, if it folds back"""
    metric: Metric
    control: StepControl
    settler: Settler

    def points(
        self, guess: Array, direction: Array | None, trail: Trail | None = None
    ) -> Iterator[Correction]:
        """Yield the corrections from a guess in a direction, after a ``trail``."""
        return trace(
            self.system,
            guess,
            self.end,
            metric=self.metric,
            control=self.control,
            settler=self.settler,
            begin=self.begin,
            direction=direction,
            trail=trail,
        )
