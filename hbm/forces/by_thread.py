"""Room that is made once for each thread, so that curves may be traced in several."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import lru_cache
from typing import Generic, TypeVar

Room = TypeVar("Room")
MOST = 8
"""kinds of room that a thread keeps"""


class ByThread(threading.local, Generic[Room]):
    """What makes room of a size, and gives the same room for it again.

    It is written to and read from while others run: each thread has its own.
    """

    def __init__(self, make: Callable[..., Room]) -> None:
        """Take what makes it; this runs in each thread that asks for room."""
        self._made = lru_cache(maxsize=MOST)(make)

    def __call__(self, *sizes: int) -> Room:
        """Return the room of a size."""
        return self._made(*sizes)
