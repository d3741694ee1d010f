"""Gaps of a curve: found, told, and in its ending where they are not narrow."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from microslip.cli import main
from microslip.studies.gaps import broken, gaps, lines, told, uncovered
from microslip_mechanics.results.response_curve import ResponseCurve


@pytest.mark.parametrize(
    ("frequencies", "restarts", "share"),
    [
        ([1.0, 2.0, 1.5, 3.0], [], 0.0),
        ([1.0, 2.0, 1.5, 2.4, 3.0], [3], 0.2),
        ([1.0, 1.6, 1.4, 3.0, 2.0, 1.0], [3], 0.0),
        ([1.0, 1.2, 1.3, 1.5, 1.9, 3.0], [2, 4], 0.25),
        ([1.0, 3.0, 1.5, 2.0, 2.8, 4.0], [2, 4], 0.0),
        ([1.0], [], 0.0),
    ],
    ids=[
        "whole",
        "a gap behind a fold",
        "traced back from its end",
        "two gaps",
        "a piece within another",
        "a point",
    ],
)
def test_a_gap_is_what_no_piece_covers(
    small_curve: ResponseCurve,
    frequencies: list[float],
    restarts: list[int],
    share: float,
) -> None:
    curve = _pieces(small_curve, frequencies, dict.fromkeys(restarts, "restart"))

    assert uncovered(curve) == pytest.approx(share)


def test_a_branch_covers_no_gap_of_the_curve(small_curve: ResponseCurve) -> None:
    curve = _pieces(
        small_curve, [1.0, 1.2, 1.5, 3.0, 1.1, 1.9], {2: "restart", 4: "branch"}
    )

    assert gaps(curve) == [(1.2, 1.5)]


@pytest.mark.parametrize(
    ("ending", "begins", "said"),
    [
        ("complete", 1.018, "complete"),
        ("complete", 1.022, "no curve is found between 1 and 1.022 of mass: another"),
        ("interrupted", 1.5, "interrupted"),
    ],
)
def test_a_gap_that_is_not_narrow_stands_in_the_ending(
    small_curve: ResponseCurve, ending: str, begins: float, said: str
) -> None:
    curve = _pieces(small_curve, [0.0, 1.0, begins, 2.0], {2: "restart"})

    found = told(replace(curve, along="mass", ending=ending))

    assert found.ending.startswith(said)


@pytest.mark.parametrize(
    ("sizes", "begins", "whole"),
    [
        ([0.1, 1.0, 4.0, 0.5], 1.005, False),
        ([0.1, 3.9, 1.0, 4.0], 1.005, False),
        ([0.1, 1.0, 2.0, 4.0], 1.005, True),
        ([0.1, 1.0, 4.0, 0.5], 1.001, True),
    ],
    ids=["behind it", "before it, nearly", "elsewhere", "slight"],
)
def test_a_gap_beside_the_largest_amplitude_counts_earlier(
    small_curve: ResponseCurve, sizes: list[float], begins: float, whole: bool
) -> None:
    curve = _pieces(small_curve, [0.0, 1.0, begins, 2.0], {2: "restart"})
    amplitude = np.outer(sizes, np.ones(curve.amplitude.shape[1]))

    found = told(replace(curve, amplitude=amplitude, ending="complete"))

    assert (found.ending == "complete") is whole


@pytest.mark.parametrize(
    ("places", "sizes", "restarts", "expected"),
    [
        ([1.0, 2.0, 1.5, 2.0, 3.0], [1.0, 4.0, 3.0, 0.1, 0.1], [3], [1.5]),
        ([1.0, 2.0, 1.5, 1.6, 3.0], [1.0, 4.0, 3.0, 3.1, 0.1], [3], []),
        ([1.0, 2.0, 1.5, 3.0, 1.8, 1.0], [1.0, 4.0, 3.0, 0.1, 3.9, 2.0], [3], []),
        ([1.0, 2.0, 1.0, 3.0, 1.0], [1.0, 4.0, 0.5, 0.1, 0.1], [3], []),
        ([1.0, 1.5, 2.0, 2.0, 3.0], [1.0, 2.0, 4.0, 0.1, 0.1], [3], [2.0]),
        ([3.0, 2.5, 2.0, 2.1, 1.0], [1.0, 2.0, 4.0, 0.1, 0.1], [3], [2.0]),
        ([1.0, 1.5, 2.0, 1.9, 3.0], [1.0, 2.0, 4.0, 4.1, 0.1], [3], []),
        ([1.0, 1.5, 2.0, 2.01, 3.0], [1.0, 2.0, 4.0, 0.1, 0.1], [3], []),
        ([3.0, 2.0, 2.5, 2.0, 1.0], [1.0, 4.0, 3.0, 0.1, 0.1], [3], [2.5]),
        ([1.0, 3.0, 3.0, 2.0, 2.5], [1.0, 4.0, 0.1, 3.0, 3.5], [2], [2.5]),
        ([1.0, 3.0, 3.0, 1.9, 2.5], [1.0, 4.0, 0.1, 0.3, 0.19], [2], [1.9]),
        ([3.0, 1.9, 2.5, 1.9, 3.0], [0.1, 0.3, 0.19, 0.3, 0.5], [3], []),
    ],
    ids=[
        "behind a fold",
        "goes on beside",
        "comes from the other end",
        "back to where it began",
        "ahead",
        "ahead, downwards",
        "ahead, goes on beside",
        "ahead, behind a gap",
        "downwards",
        "behind a fold, the last piece",
        "on itself",
        "on itself, taken up where it turned",
    ],
)
def test_a_piece_that_breaks_off_is_told(
    small_curve: ResponseCurve,
    places: list[float],
    sizes: list[float],
    restarts: list[int],
    expected: list[float],
) -> None:
    curve = _pieces(small_curve, places, dict.fromkeys(restarts, "restart"))
    size = np.outer(sizes, np.ones(curve.amplitude.shape[1]))
    curve = replace(curve, amplitude=size, along="mass")

    assert broken(curve) == expected
    for place in expected:
        said = f"breaks off at {place:g} of mass, and what lies behind"
        assert said in told(curve).ending
        assert said in "\n".join(lines(curve))


def test_gaps_along_frequency_are_told_in_hertz(small_curve: ResponseCurve) -> None:
    curve = _pieces(small_curve, [math.tau, 2.0 * math.tau, 20.0], {2: "restart"})

    assert lines(curve) == ["no curve is found between 2 and 3.1830989 Hz"]


@pytest.mark.long
def test_a_curve_without_its_peak_is_not_whole(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # without friction the element rattles from where its points open: in 0.6 % of the
    # range, less than would make the curve one that is not whole elsewhere
    scene = ["two-blades", "--set", "friction.law=none"]

    assert main(["frc", *scene, "-o", str(tmp_path / "none")]) == 1

    said = capsys.readouterr()
    assert "no curve is found between 136.7" in said.out
    assert "no curve is found between 136.7" in said.err


def _pieces(
    curve: ResponseCurve, parameter: list[float], events: dict[int, str]
) -> ResponseCurve:
    names = tuple(events.get(place, "") for place in range(len(parameter)))
    return replace(curve, parameter=np.array(parameter), event=names)
