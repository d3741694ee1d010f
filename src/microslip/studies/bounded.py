"""Tasks in processes of their own, each with an end to its time."""

from __future__ import annotations

import contextlib
import faulthandler
import math
import multiprocessing
import signal
import sys
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from typing import Any, Generic, TypeVar

from microslip.interruption import held_back

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


def bounded(
    task: Task,
    items: Sequence[Item],
    *,
    seconds: Callable[[Sequence[Item]], float],
    processes: int,
    prepare: Callable[[], None],
) -> Iterator[Ended[Item]]:
    """Yield what becomes of each item, in the order in which they end.

    A process that takes longer, or that dies, is replaced; the others go on. Nothing
    interrupts a kernel but the end of its process.

    Parameters
    ----------
    task, prepare
        Functions of a module, which the processes import; ``prepare`` is called once in
        each, before the time of its first item begins.
    items
        What the task is given, one after the other.
    seconds
        Of processor time for the first of the items that are still to begin; of wall
        time where the system sets no limit.
    processes
        That work at the same time.
    """
    waiting = deque(items)
    crew: list[_Worker[Item]] = []
    try:
        while waiting or any(worker.busy for worker in crew):
            idle = [worker for worker in crew if not worker.busy]
            # the first makes the machine code that the others then find
            most = processes if any(worker.ready for worker in crew) else 1
            while waiting and (idle or len(crew) < most):
                if not idle:
                    idle.append(_Worker(task, prepare))
                    crew.append(idle[-1])
                allowed = seconds(waiting)
                idle.pop().begin(waiting.popleft(), allowed)
            yield from _heard(crew)
            crew = [worker for worker in crew if not worker.lost]
    finally:
        for worker in crew:
            worker.stop()


def _heard(crew: Sequence[_Worker[Item]]) -> Iterator[Ended[Item]]:
    """Wait until one of them tells something or is late; yield what has ended."""
    busy = [worker for worker in crew if worker.busy]
    soonest = min(worker.deadline for worker in busy)
    wait([each.pipe for each in busy], max(0.0, soonest - time.monotonic()))
    for worker in busy:
        ended = worker.listened()
        if ended is not None:
            yield ended


class _Worker(Generic[Item]):
    """One process, and what it is doing."""

    def __init__(self, task: Task, prepare: Callable[[], None]) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self._process: SpawnProcess = context.Process(
            target=_serve, args=(theirs, task, prepare), daemon=True
        )
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
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
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
