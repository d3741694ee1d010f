"""A process that works on items, each with an end to its time."""

from __future__ import annotations

import contextlib
import faulthandler
import math
import multiprocessing
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from typing import Any, Generic, TypeVar

from microslip.interruption import STOPS, held_back

Item = TypeVar("Item")
Task = Callable[[Any, float], Iterator[Any]]
"""yields better and better results of an item within seconds; the last one counts"""
STARTING = 600.0
"""seconds that a process may take until it is ready: machine code is made"""
CROWDED = 10.0
"""times its processor time that an item may take where others use the processors"""
LATE = () if sys.platform == "win32" else (-signal.SIGXCPU,)
"""exit codes of a process that has used its time"""
GONE = 5.0
"""seconds for a process that has closed its end to be gone"""
READY, RESULT, DONE = "ready", "result", "done"


@dataclass(frozen=True, slots=True)
class Ended(Generic[Item]):
    """What became of an item."""

    item: Item
    result: Any
    """the last one there was; None if there was none"""
    cause: str
    """why there is no better one; empty if the task came to its end"""
    seconds: float
    """of processor time; of wall time if its process died"""


class Worker(Generic[Item]):
    """One process, and what it is doing."""

    def __init__(self, task: Task, prepare: Callable[[], None]) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self._process: SpawnProcess = context.Process(
            target=_serve, args=(theirs, task, prepare), daemon=True
        )
        if sys.platform != "win32":
            from multiprocessing.resource_tracker import ensure_running

            ensure_running()  # it would let interruptions through when it starts
        with held_back():
            self._process.start()
        theirs.close()
        self._items: list[Item] = []
        self._result: Any = None
        self._began, self._seconds = time.monotonic(), 0.0
        self.ready = self.lost = False
        self.deadline = 0.0

    @property
    def busy(self) -> bool:
        """Whether it has an item."""
        return bool(self._items)

    def begin(self, item: Item, seconds: float) -> None:
        """Give it an item."""
        self._items, self._result, self._seconds = [item], None, seconds
        self.pipe.send((item, seconds))
        self._start()

    def _start(self) -> None:
        self._began = time.monotonic()
        most = self._seconds if sys.platform == "win32" else CROWDED * self._seconds
        self.deadline = self._began + (most if self.ready else STARTING)

    def listened(self) -> Ended[Item] | None:
        """Take what it tells; return how its item ended, if it has."""
        try:
            while self.pipe.poll():
                word, told = self.pipe.recv()
                if word == READY:
                    self.ready = True
                    self._start()
                elif word == DONE:
                    return self._ended(*told)
                else:
                    self._result = told
        except (EOFError, ConnectionError):
            self.stop()
            late = self._process.exitcode in LATE
            died = f"its process ended with {self._process.exitcode}"
            return self._late() if late else self._ended(died, self._since)
        if time.monotonic() < self.deadline:
            return None
        self.stop()
        return self._late()

    @property
    def _since(self) -> float:
        return time.monotonic() - self._began

    def _late(self) -> Ended[Item]:
        return self._ended(f"out of time after {self._seconds:g} s", self._seconds)

    def _ended(self, cause: str, seconds: float) -> Ended[Item]:
        (item,), self._items = self._items, []
        return Ended(item, self._result, cause, seconds)

    def stop(self) -> None:
        """End the process."""
        if self.lost:
            return
        self.lost = True
        self._process.join(GONE if self.pipe.poll() else 0.0)
        self._process.kill()
        self._process.join()
        self.pipe.close()


def _serve(pipe: Connection, task: Task, prepare: Callable[[], None]) -> None:
    """Work on items until the other end closes."""
    # the interruption is the parent's to handle: it ends this process
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)
    faulthandler.enable()  # a process that dies says where
    warnings.simplefilter("error", RuntimeWarning)
    with contextlib.suppress(EOFError, ConnectionError):
        prepare()
        pipe.send((READY, None))
        while True:
            (item, seconds), cause = pipe.recv(), ""
            began = time.process_time()
            _limit(seconds)
            try:
                for result in task(item, seconds):
                    pipe.send((RESULT, result))
            except Exception as error:
                cause = f"{type(error).__name__}: {' '.join(str(error).split())}"
            pipe.send((DONE, (cause, time.process_time() - began)))


def _limit(seconds: float) -> None:
    """Have the system end this process when it has used its time."""
    if sys.platform != "win32":
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_CPU)
        used = math.ceil(time.process_time() + seconds)
        resource.setrlimit(resource.RLIMIT_CPU, (used, most))
