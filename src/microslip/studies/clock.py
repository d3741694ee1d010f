"""Processor time that something may take, and its interruption when that is over."""

from __future__ import annotations

import contextlib
import math
import signal
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

from microslip.interruption import unmasked

LEAST = 1e-3
"""seconds for a part whose time is over before it begins"""
LATE = "out of time"
"""what is said of it"""


class OutOfTimeError(KeyboardInterrupt):
    """An interruption, which no solver takes for a failure of its own."""


@dataclass(frozen=True, slots=True)
class Clock:
    """Processor time for parts of a whole; what one leaves is for those after it."""

    seconds: float
    """for all of it"""
    began: float = field(default_factory=time.process_time)

    @contextlib.contextmanager
    def until(self, share: float) -> Iterator[None]:
        """Interrupt what is going on when a share of the time is over.

        Raises
        ------
        OutOfTimeError
            Then, as :func:`limited` does.
        """
        left = self.began + share * self.seconds - time.process_time()
        with limited(max(left, LEAST)):
            yield


@contextlib.contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Interrupt what takes more processor time, at the next return from a kernel.

    Where the system has no such timer it is not interrupted.

    Raises
    ------
    OutOfTimeError
        When the time is over.
    """
    if not hasattr(signal, "setitimer") or math.isinf(seconds):
        yield
        return

    def stop(*_: object) -> None:
        raise OutOfTimeError(LATE)

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        with unmasked():
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
