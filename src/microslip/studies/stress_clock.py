"""The time that a curve under stress may take."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

from hbm.continuation import ContinuationError

TRACING = 0.4
"""share of a case's time after which its curve is left"""


class Clock:
    """Ends a curve at its share of the time, between two points."""

    def __init__(self, seconds: float) -> None:
        self._end = time.process_time() + seconds
        self._traced = time.process_time() + TRACING * seconds

    @property
    def over(self) -> bool:
        """Whether the curve's share is over."""
        return time.process_time() > self._traced

    def watch(self, items: Any) -> Iterator[Any]:  # noqa: ANN401  (what a watch takes)
        """Pass items through until the time is over."""
        for item in items:
            yield item
            if self.over:
                raise ContinuationError("out of time on the curve")
