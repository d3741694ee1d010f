"""Interruptions of which the call of a kernel has made another error."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator


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
