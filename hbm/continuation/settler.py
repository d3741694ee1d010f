"""What is done to a converged point before a trace keeps it."""

from __future__ import annotations

import math
from typing import Protocol

from hbm.continuation.correction import Correction
from hbm.continuation.newton import Small
from microslip_mechanics.arrays import Array


class Settler(Protocol):
    """What makes a converged point good enough to keep."""

    @property
    def changed(self) -> bool:
        """Whether the system is finer or coarser than at the last point kept."""

    @property
    def finer(self) -> bool:
        """Whether the system is finer than at the last point kept."""

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
    ) -> Correction:
        """Return the point to keep, in the plane normal to ``normal``; it may fail.

        ``tolerance`` and ``small`` are those of
        :func:`~hbm.continuation.newton.correct`.
        """

    def straightened(self, correction: Correction, scale: Array) -> Array | None:
        """Return a guess for a settled point whose tangent is not where the curve goes.

        The system is finer then. None if it is. ``scale`` is the unit of arc of each
        component.
        """

    def overlooks(self, point: Array, scale: Array, step: float) -> bool:
        """Return whether a step to a point was too long to see what lies on its way."""

    def keep(self, step: float = math.inf) -> None:
        """Learn that the last point is kept, and the step that led to it."""

    def retreat(self, times: int) -> None:
        """Learn that the last point was not kept, for the n-th time in a row."""

    def hold(self) -> None:
        """Learn that the last point kept has been solved with the present system."""


class Unsettled:
    """Keeps each point as it is."""

    changed = finer = False

    def settle(
        self,
        correction: Correction,
        normal: Array,  # noqa: ARG002
        tolerance: float,  # noqa: ARG002
        small: Small | None = None,  # noqa: ARG002
    ) -> Correction:
        """Return the point."""
        return correction

    def straightened(
        self,
        correction: Correction,  # noqa: ARG002
        scale: Array,  # noqa: ARG002
    ) -> Array | None:
        """Return that it is."""
        return None

    def overlooks(
        self,
        point: Array,  # noqa: ARG002
        scale: Array,  # noqa: ARG002
        step: float,  # noqa: ARG002
    ) -> bool:
        """Return that it was not."""
        return False

    def keep(self, step: float = math.inf) -> None:
        """Do nothing."""

    def retreat(self, times: int) -> None:
        """Do nothing."""

    def hold(self) -> None:
        """Do nothing."""


UNSETTLED = Unsettled()
