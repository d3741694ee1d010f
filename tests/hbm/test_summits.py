"""Peaks of a curve are no lower than the points about them, and none is left out."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from hbm.events.summits import Summits
from microslip_mechanics.results.response import PeriodicResponse
from small_problems import prescribed

PROBES = np.eye(1)


def at(place: float, size: float, event: str = "") -> PeriodicResponse:
    """Return a response of an amplitude at some place on a curve."""
    coefficients = size * np.array([[0.0], [0.6], [0.8]])
    return replace(prescribed(1.0, coefficients), parameter=place, event=event)


def told(*steps: list[PeriodicResponse]) -> Iterator[PeriodicResponse]:
    """Yield what is told of a curve: of each step what was found, then its end."""
    summits = Summits(PROBES)
    ((first,), *others) = steps
    summits.begin(first)
    yield first
    for *found, made in others:
        yield from summits.among(found, made)
        yield made


def peaks(*steps: list[PeriodicResponse]) -> list[tuple[float, float]]:
    """Return where peaks are told, and by how much they may be aside."""
    return [
        (each.parameter, each.parameter_error)
        for each in told(*steps)
        if each.event == "peak"
    ]


def test_a_peak_between_two_lower_points_is_told() -> None:
    found = peaks([at(1, 1.0)], [at(1.5, 1.3, "peak"), at(2, 1.2)], [at(3, 1.0)])

    assert [place for place, _ in found] == [1.5]


@pytest.mark.parametrize("sizes", [(1.0, 1.2), (1.2, 1.0)])
def test_a_peak_below_a_point_beside_it_is_none(sizes: tuple[float, float]) -> None:
    first, last = sizes

    assert not peaks([at(1, first)], [at(1.5, 1.1, "peak"), at(2, last)])


def test_a_point_above_its_neighbours_is_a_peak_between_them() -> None:
    points = [at(1, 1.0)], [at(2, 1.2)], [at(2.5, 1.1)], [at(4, 1.0)]

    assert peaks(*points) == [(2, 1.0)]
    order = [each.parameter for each in told(*points)]
    assert order == sorted(order)


def test_such_a_point_is_known_as_a_parabola_through_its_neighbours_is() -> None:
    places = (1.0, 2.0, 2.5)
    points = [
        replace(at(place, 1.2 - 0.3 * (place - 1.9) ** 2), error=1e-3)
        for place in places
    ]

    (peak,) = (each for each in told(*([each] for each in points)) if each.event)

    assert peak.parameter == 2.0
    assert peak.error == pytest.approx(1e-3 + 0.003 / 1.197)


def test_what_is_told_of_steep_neighbours_is_no_more_than_these_are_lower() -> None:
    points = [replace(at(*each), error=0.0) for each in ((1, 0.9), (1, 1), (2, 0.5))]

    (peak,) = (each for each in told(*([each] for each in points)) if each.event)

    assert peak.error == pytest.approx(0.5)


def test_a_point_beside_a_peak_is_none() -> None:
    before = [at(1, 1.0)], [at(1.8, 1.3, "peak"), at(2, 1.2)], [at(3, 1.0)]
    after = [at(1, 1.0)], [at(2, 1.2)], [at(2.2, 1.3, "peak"), at(3, 1.0)]

    assert [place for place, _ in peaks(*before)] == [1.8]
    assert [place for place, _ in peaks(*after)] == [2.2]


def test_a_point_beside_a_fold_above_it_is_none() -> None:
    assert not peaks([at(1, 1.0)], [at(2, 1.2)], [at(2.2, 1.3, "fold"), at(2, 1.1)])


def test_other_events_are_told_as_they_are() -> None:
    fold = at(1.5, 0.5, "fold")

    assert fold in list(told([at(1, 1.0)], [fold, at(2, 1.2)]))


def test_points_of_equal_amplitude_are_no_peaks() -> None:
    assert not peaks([at(1, 1.0)], [at(2, 1.0)], [at(3, 1.0)])


def test_a_curve_that_begins_anew_has_no_peak_where_it_does() -> None:
    summits = Summits(PROBES)
    summits.begin(at(1, 1.0))
    list(summits.among([], at(2, 1.2)))
    summits.begin(at(5, 1.0))

    assert list(summits.among([], at(6, 0.8))) == []
