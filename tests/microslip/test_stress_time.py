"""The time of cases under stress: shares of it, and what does not heed them."""

import contextlib
import multiprocessing
import os
import signal
import time
from collections.abc import Iterator
from threading import Thread

import pytest

from microslip.studies.bounded import bounded
from microslip.studies.clock import Clock, OutOfTimeError, limited
from microslip.studies.stress.budget import LEAST, MOST, WHOLE, Budget
from microslip.studies.stress.case import Case


def test_cases_share_what_is_left_of_ten_minutes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    solved = [Case("parameter", f"{value}", ()) for value in range(100)]
    refused = [Case("nan", "table", (), refusals=(("model=B",),))] * 60
    budget = Budget(2, began=0.0)

    assert budget.share([*solved, *refused]) == pytest.approx(4.0 * WHOLE / 100.0)
    assert budget.share(solved[:20]) == MOST
    assert Budget.each(123.0, 2).share(solved) == 123.0
    for left in range(100, 0, -2):  # two at a time, and all take what they may
        now[0] += budget.share(solved[:left])
    assert now[0] < WHOLE + 20.0 * LEAST


def ready() -> None:
    """Prepare nothing."""


def work(item: str, seconds: float) -> Iterator[str]:
    """Do as an item says."""
    assert seconds == 3.0
    yield f"half of {item}"
    while item == "hangs":
        time.process_time()
    if item == "dies":
        os._exit(3)
    if item == "fails":
        raise RuntimeError("a defect")
    yield item


def test_what_hangs_dies_or_fails_does_not_stop_the_others() -> None:
    items = ["first", "hangs", "dies", "fails", "last"]
    ended = bounded(work, items, seconds=lambda _: 3.0, processes=2, prepare=ready)

    found = {each.item: (each.result, each.cause) for each in ended}

    assert found["first"] == ("first", "")
    assert found["hangs"] == ("half of hangs", "out of time after 3 s")
    assert found["dies"] == ("half of dies", "its process ended with 3")
    assert found["fails"] == ("half of fails", "RuntimeError: a defect")
    assert found["last"] == ("last", "")


def interrupt_children() -> None:
    """Send an interruption to the first process that starts, again and again."""
    while not (children := multiprocessing.active_children()):
        time.sleep(1e-3)
    for _ in range(50):
        with contextlib.suppress(ProcessLookupError):
            os.kill(children[0].pid or 0, signal.SIGINT)
        time.sleep(1e-2)


@pytest.mark.skipif(os.name == "nt", reason="no signals to processes")
def test_a_process_that_starts_leaves_interruptions_to_its_parent(
    capfd: pytest.CaptureFixture[str],
) -> None:
    sender = Thread(target=interrupt_children)
    sender.start()

    (ended,) = bounded(work, ["one"], seconds=lambda _: 3.0, processes=1, prepare=ready)

    sender.join()
    assert (ended.result, ended.cause) == ("one", "")
    assert capfd.readouterr().err == ""


def use_processor(until: float) -> None:
    while time.process_time() < until:
        pass


def test_what_uses_its_processor_time_is_interrupted_and_nothing_after_it() -> None:
    began = time.process_time()

    with pytest.raises(OutOfTimeError), limited(0.2):
        use_processor(until=began + 5.0)

    assert 0.1 < time.process_time() - began < 1.0
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)


def test_what_a_part_leaves_of_its_time_is_for_those_after_it() -> None:
    clock = Clock(1.0)
    with clock.until(0.4):
        use_processor(until=clock.began + 0.05)

    with pytest.raises(OutOfTimeError), clock.until(0.5):
        use_processor(until=clock.began + 5.0)

    assert 0.45 < time.process_time() - clock.began < 0.7

    # what is over before it begins ends at once
    began = time.process_time()
    with pytest.raises(OutOfTimeError), clock.until(0.5):
        use_processor(until=began + 5.0)

    assert time.process_time() - began < 0.1
