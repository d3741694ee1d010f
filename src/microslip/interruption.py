"""Interruptions that kernels turn into something else, or that come too early."""

from __future__ import annotations

import _thread
import contextlib
import signal
import sys
from collections.abc import Iterator
from threading import Timer

STOPS = {signal.SIGINT, signal.SIGTERM}
"""signals that interrupt"""
LATER = 0.05
"""seconds after which an interruption that was lost comes again"""


@contextlib.contextmanager
def unmasked() -> Iterator[None]:
    """Raise an interruption as what it is.

    A signal that comes while a kernel works is handled where numba makes the arrays
    that the kernel returns. If there are several, what is raised there becomes the
    cause of a ``SystemError``, which nobody would take for an interruption.
    """
    try:
        yield
    except SystemError as error:
        cause: BaseException = error
        while cause.__cause__ is not None:
            cause = cause.__cause__
        if isinstance(cause, KeyboardInterrupt):
            raise cause from None
        raise


@contextlib.contextmanager
def heeded() -> Iterator[None]:
    """Let an interruption come again that was lost where nothing can be raised.

    While kernels compile, a signal is handled in functions that LLVM calls, from which
    an exception does not come back: Python reports it, and goes on. What fails for want
    of what such a function should have done is an interruption too.
    """
    before, lost = sys.unraisablehook, list[Timer]()

    def hook(seen: sys.UnraisableHookArgs) -> None:
        if seen.exc_type is KeyboardInterrupt:  # not one that ends a part of the work
            lost.append(Timer(LATER, _thread.interrupt_main))
            lost[-1].daemon = True
            lost[-1].start()
        else:
            before(seen)

    sys.unraisablehook = hook
    try:
        yield
    except Exception:
        if lost:
            raise KeyboardInterrupt from None
        raise
    finally:
        sys.unraisablehook = before
        for again in lost:
            again.cancel()


@contextlib.contextmanager
def held_back() -> Iterator[None]:
    """Hold interruptions back; a process that starts meanwhile does so too."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
