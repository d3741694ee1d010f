"""Progress bars: what passes through them, and where they are seen."""

import contextlib
import io
import sys
from collections.abc import Iterator

import pytest

from microslip.progress import shown


class Terminal(io.StringIO):
    """A text stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def bar(items: Iterator[float]) -> Iterator[float]:
    """Return items behind a bar that ends at eight."""
    return shown(items, total=8.0, done=lambda item: item, unit="Hz", name="curve")


def on_terminal(items: Iterator[float], monkeypatch: pytest.MonkeyPatch) -> str:
    """Return what a terminal in place of standard error shows of a bar."""
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with contextlib.suppress(KeyboardInterrupt):
        list(bar(items))
    return screen.getvalue()


def test_items_pass_unchanged_and_one_by_one() -> None:
    taken: list[float] = []

    def items() -> Iterator[float]:
        for item in (1.0, 5.0, 8.0):
            taken.append(item)
            yield item

    passed = bar(items())

    assert next(passed) == 1.0
    assert taken == [1.0]
    assert list(passed) == [5.0, 8.0]


def test_bar_is_off_where_there_is_no_terminal(
    capsys: pytest.CaptureFixture[str],
) -> None:
    list(bar(iter([1.0, 8.0])))

    assert capsys.readouterr() == ("", "")


def test_bar_shows_name_share_and_unit(monkeypatch: pytest.MonkeyPatch) -> None:
    text = on_terminal(iter([2.0, 8.0]), monkeypatch)

    assert "curve:   0%" in text
    assert "curve: 100%" in text
    assert "8/8 Hz" in text


def test_bar_does_not_run_over_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    text = on_terminal(iter([2.0, 9.0]), monkeypatch)

    assert "curve: 100%" in text
    assert "9/8" not in text


def test_bar_does_not_run_back_behind_a_fold(monkeypatch: pytest.MonkeyPatch) -> None:
    text = on_terminal(iter([6.0, 2.0]), monkeypatch)

    assert "6/8 Hz" in text.splitlines()[-1]


def test_bar_ends_its_line_when_it_is_interrupted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def items() -> Iterator[float]:
        yield 4.0
        raise KeyboardInterrupt

    text = on_terminal(items(), monkeypatch)

    assert "curve:  50%" in text
    assert text.endswith("\n")


def test_error_passes_through_the_bar() -> None:
    def items() -> Iterator[float]:
        yield 1.0
        raise KeyboardInterrupt

    passed = bar(items())

    assert next(passed) == 1.0
    with pytest.raises(KeyboardInterrupt):
        next(passed)


def test_no_time_is_told_from_a_first_step_of_rounding(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert "<?" in on_terminal(iter([1e-14]), monkeypatch).splitlines()[-1]
