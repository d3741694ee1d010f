"""Tasks in processes of their own, each with an end to its time."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from multiprocessing.connection import wait

from microslip.studies.worker import Ended, Item, Task, Worker


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
    crew: list[Worker[Item]] = []
    try:
        while waiting or any(worker.busy for worker in crew):
            idle = [worker for worker in crew if not worker.busy]
            # the first makes the machine code that the others then find
            most = processes if any(worker.ready for worker in crew) else 1
            while waiting and (idle or len(crew) < most):
                if not idle:
                    idle.append(Worker(task, prepare))
                    crew.append(idle[-1])
                allowed = seconds(waiting)
                idle.pop().begin(waiting.popleft(), allowed)
            yield from _heard(crew)
            crew = [worker for worker in crew if not worker.lost]
    finally:
        for worker in crew:
            worker.stop()


def _heard(crew: Sequence[Worker[Item]]) -> Iterator[Ended[Item]]:
    """Wait until one of them tells something or is late; yield what has ended."""
    busy = [worker for worker in crew if worker.busy]
    soonest = min(worker.deadline for worker in busy)
    wait([each.pipe for each in busy], max(0.0, soonest - time.monotonic()))
    for worker in busy:
        ended = worker.listened()
        if ended is not None:
            yield ended
