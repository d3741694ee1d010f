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


def kept(points: Sequence[PeriodicResponse]) -> list[int]:
    """Return the places of the peaks that are kept."""
    found = prominent(oscillator(), points)
    assert [each for each in points if not each.event] == [
        each for each in found if not each.event
    ]
    return [int(each.parameter) for each in found if each.event == "peak"]


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


def test_the_highest_peak_is_kept_however_flat_it_is() -> None:
    assert kept(curve([1.0, 1.0 + 1e-6, 1.0], [1])) == [1]


def test_peaks_of_unknown_error_are_kept() -> None:
    assert kept(curve([1.0, 1.1, 1.0999, 1.2, 1.0], [1, 3], np.inf)) == [1, 3]


def test_no_points_have_no_peaks() -> None:
    assert kept([]) == []
