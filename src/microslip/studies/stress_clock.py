"""The time that a part of a case under stress may take."""

from __future__ import annotations

import contextlib
import math
import signal
from collections.abc import Iterator


class OutOfTimeError(KeyboardInterrupt):
    """An interruption, which no solver takes for a failure of its own."""


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
        raise OutOfTimeError("out of time")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
