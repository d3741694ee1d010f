"""Which peaks of a curve its errors tell from ripples."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from microslip.studies.prominent import prominent
from microslip_mechanics.results.response import PeriodicResponse
from small_problems import oscillator, prescribed

ERROR = 1e-3


def curve(
    sizes: Sequence[float], peaks: Sequence[int], error: float = ERROR
) -> list[PeriodicResponse]:
    """Return responses of some amplitudes, of which some are peaks."""
    return [
        replace(
            prescribed(1.0, size * np.array([[0.0], [0.6], [0.8]])),
            error=error,
            event="peak" if place in peaks else "",
            parameter=float(place),
        )
        for place, size in enumerate(sizes)
    ]


def kept(points: Sequence[PeriodicResponse]) -> list[float]:
    """Return the places of the peaks that are kept."""
    found = prominent(oscillator(), points)
    others = [each for each in points if each.event != "peak"]
    assert [each for each in found if each.event != "peak"] == others
    return [each.parameter for each in found if each.event == "peak"]


def test_a_ripple_on_a_slope_is_no_peak() -> None:
    sizes = [1.0, 1.1, 1.0999, 1.2, 1.0]

    assert kept(curve(sizes, [1, 3])) == [3]
    assert kept(curve(sizes[::-1], [1, 3])) == [1]


def test_a_lower_peak_that_stands_out_is_kept() -> None:
    assert kept(curve([1.0, 1.1, 1.09, 1.2, 1.0], [1, 3])) == [1, 3]


@pytest.mark.parametrize("deep", [1.9e-3, 2.3e-3])
def test_the_way_down_is_longer_than_both_errors_together(deep: float) -> None:
    found = kept(curve([0.5, 1.0, 1.0 - deep, 1.2, 0.5], [1, 3]))

    assert found == ([1, 3] if deep > 2.0 * ERROR else [3])


def test_how_much_higher_a_peak_may_be_does_not_flatten_its_point() -> None:
    points = curve([1.0, 1.1, 1.1, 1.09, 1.2, 1.0], [1, 4])
    points[1] = replace(points[1], error=0.02, parameter=2.0)

    assert kept(points) == [2, 4]


def test_the_highest_peak_is_kept_however_flat_it_is() -> None:
    assert kept(curve([1.0, 1.0 + 1e-6, 1.0], [1])) == [1]


def test_peaks_of_unknown_error_are_kept() -> None:
    assert kept(curve([1.0, 1.1, 1.0999, 1.2, 1.0], [1, 3], np.inf)) == [1, 3]


def test_a_point_from_which_the_curve_is_taken_up_a_step_back_is_no_peak() -> None:
    points = curve([1.0, 1.2, 1.2, 1.1, 1.15, 1.3, 1.0], [2, 5])
    places = (1.0, 2.0, 2.0, 1.8, 1.9, 2.1, 3.0)
    back = [
        replace(each, parameter=place)
        for each, place in zip(points, places, strict=True)
    ]
    fold = [*back[:3], replace(back[2], event="fold"), *back[3:]]

    assert kept(back) == [2.1]
    assert kept(fold) == [2, 2.1]


def folded(places: Sequence[float], folds: Sequence[int]) -> list[PeriodicResponse]:
    """Return responses along a curve that turns back at some of them."""
    return [
        replace(
            prescribed(1.0),
            event="fold" if at in folds else "",
            parameter=place,
            parameter_error=ERROR if at in folds else np.nan,
        )
        for at, place in enumerate(places)
    ]


def folds(places: Sequence[float], folds: Sequence[int]) -> list[float]:
    """Return where folds are kept."""
    found = prominent(oscillator(), folded(places, folds))
    return [each.parameter for each in found if each.event == "fold"]


@pytest.mark.parametrize("back", [1e-4, 0.1])
def test_a_way_back_within_the_errors_of_two_folds_has_none(back: float) -> None:
    places = [1.0, 2.0, 2.0 - back / 2.0, 2.0 - back, 3.0]
    told = [2.0, 2.0 - back] if back > 2.0 * ERROR else []

    assert folds(places, [1, 3]) == told
    assert folds(places[::-1], [1, 3]) == told[::-1]


def test_a_fold_without_its_partner_has_to_lead_back_as_far() -> None:
    assert folds([1.0, 2.0, 1.9999, 3.0], [1]) == []
    assert folds([1.0, 2.0, 1.9, 3.0], [1]) == [2.0]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_points_that_are_farther_by_less_than_a_fold_errs_leave_it(side: float) -> None:
    beyond, back, fold = 2.0, 2.0 + 0.2 * ERROR, 2.0 + 0.1 * ERROR
    places = [side * place for place in (3.0, beyond, back, fold, 2.5, 3.0)]

    assert folds(places, [3]) == [side * fold]
    assert folds(places[::-1], [2]) == [side * fold]
    # where the curve goes on beyond, it is a ripple
    assert folds([*places[:4], side, 0.0], [3]) == []


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_where_ripples_turn_a_curve_its_only_fold_stays(side: float) -> None:
    ripples = [2.0 + each * ERROR for each in (-0.3, -0.1, -0.4, 0.0, -0.2, -0.3)]
    back, on = ([side * each for each in [3.0, *ripples, end]] for end in (2.5, 1.5))

    assert folds(back, [4]) == [side * 2.0]
    assert folds(back[::-1], [3]) == [side * 2.0]
    assert folds(on, [4]) == []


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_fold_whose_partner_is_a_ripple_is_one_too(side: float) -> None:
    places = [side * each for each in (1.0, 1.9, 2.0, 1.99, 2.0005, 2.5, 3.0)]
    points = folded(places, [2, 4])
    points[4] = replace(points[4], parameter_error=0.05)

    found = prominent(oscillator(), points)

    assert [each.event for each in found if each.event] == []


def test_how_far_a_peak_is_aside_says_nothing_of_folds() -> None:
    points = folded([1.0, 2.0, 2.0, 1.9, 1.8, 3.0], [2, 4])
    points[1] = replace(points[1], event="peak", parameter_error=1.0)

    events = [each.event for each in prominent(oscillator(), points) if each.event]

    assert events == ["peak", "fold", "fold"]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_fold_lies_where_a_point_beside_it_is_farther(side: float) -> None:
    places = [side * place for place in (1.0, 2.1, 2.0, 1.1, 1.0, 1.1, 1.11, 3.0)]

    found = prominent(oscillator(), folded(places, [2, 5]))

    errors = {each.parameter: each.parameter_error for each in found if each.event}
    assert errors == {
        side * 2.0: pytest.approx(0.1),
        side * 1.1: pytest.approx(0.1),
    }


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_fold_lies_where_both_points_beside_it_are_farther(side: float) -> None:
    places = [side * place for place in (1.0, 2.1, 2.0, 2.05, 1.0)]

    sizes = curve([1.0, 1.2, 1.0, 1.0, 1.0], [])
    points = [
        replace(each, error=ERROR, coefficients=size.coefficients)
        for each, size in zip(folded(places, [2]), sizes, strict=True)
    ]

    (fold,) = (each for each in prominent(oscillator(), points) if each.event)

    assert fold.parameter_error == pytest.approx(0.1)
    assert fold.error == pytest.approx(0.2)


@pytest.mark.parametrize(("aside", "told"), [(0.5, False), (2.0, True)])
def test_a_branch_point_that_may_be_a_fold_is_none(aside: float, told: bool) -> None:
    points = folded([1.0, 2.0 - aside * ERROR, 1.999, 2.0, 1.0], [3])
    points[1] = replace(points[1], event="branch point")

    events = [each.event for each in prominent(oscillator(), points)]

    assert ("branch point" in events) == told
    assert "fold" in events


@pytest.mark.parametrize(("behind", "told"), [(1.5, False), (0.5, True)])
def test_what_alone_crosses_for_a_fold_is_no_branch_point(
    behind: float, told: bool
) -> None:
    """The multiplier passes +1 a step before the curve of few harmonics folds."""
    points = folded([1.0, 1.5, 1.9, 2.0, 1.8, 1.0], [3])
    multipliers = [0.5, 1.0, 1.5, 1.0, behind, behind]
    points = [
        replace(each, multipliers=np.array([value], complex))
        for each, value in zip(points, multipliers, strict=True)
    ]
    points[1] = replace(points[1], event="branch point")

    events = [each.event for each in prominent(oscillator(), points)]

    assert ("branch point" in events) == told
    assert "fold" in events


@pytest.mark.parametrize("step", [1, -1])
@pytest.mark.parametrize(
    ("outside", "back", "told"),
    [
        ([0, 1, 1, 0, 0, 0], "", False),  # to and fro, and only to is told
        ([0, 1, 1, 0, 0, 0], "Neimark-Sacker", True),
        ([0, 1, 1, 1, 1, 0], "", True),
    ],
)
def test_what_comes_undone_without_a_word_is_no_branch_point(
    outside: list[int], back: str, told: bool, step: int
) -> None:
    events = ["", "branch point", "", back, "", ""]
    points = [
        replace(each, event=event, multipliers=np.array([0.5 + count], complex))
        for each, event, count in zip(
            folded([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], []), events, outside, strict=True
        )
    ]

    found = prominent(oscillator(), points[::step])

    assert ("branch point" in [each.event for each in found]) == told


@pytest.mark.parametrize("larger", [1e-4, 0.1])
def test_a_branch_point_on_a_fold_is_none_however_many_points_lie_between(
    larger: float,
) -> None:
    points = folded([1.0, 2.0, 1.99, 2.001, 1.99, 2.0, 1.0], [5])
    sizes = curve([1.0, 1.0, 1.0, 1.0, 1.0, 1.0 + larger, 1.0], [])
    points = [
        replace(each, error=ERROR, coefficients=size.coefficients)
        for each, size in zip(points, sizes, strict=True)
    ]
    points[1] = replace(points[1], event="branch point")

    events = [each.event for each in prominent(oscillator(), points)]

    assert ("branch point" in events) == (larger > 2.0 * ERROR)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_peak_told_at_the_point_before_a_fold_hides_no_fold(side: float) -> None:
    """The fold is reported a little behind the points beside it (a ripple of them)."""
    places = [1.0, 1.99, 2.0005, 2.0005, 2.0, 2.0004, 1.9, 1.0, 3.0]
    points = folded([side * place for place in places], [4, 7])
    points[3] = replace(points[3], event="peak")

    events = [each.event for each in prominent(oscillator(), points)]

    assert events.count("fold") == 2


def test_other_pieces_of_a_curve_say_nothing() -> None:
    points = curve([1.0, 1.1, 1.0999, 1.2, 1.0], [1])
    points[3] = replace(points[3], event="restart")

    assert kept(points) == [1]


def test_no_points_have_no_peaks() -> None:
    assert kept([]) == []
