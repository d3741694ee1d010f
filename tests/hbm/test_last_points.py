"""What a curve has told of its last points, and takes back."""

import numpy as np
import pytest

from hbm.curves.last_points import LastPoints
from microslip_mechanics.results.response import PeriodicResponse


def at(parameter: float, event: str = "") -> PeriodicResponse:
    """Return a response at a parameter."""
    empty = np.zeros(0)
    return PeriodicResponse(
        *(parameter, np.zeros((3, 1)), empty, empty, 0.0, 0.0, 0.0, "converged", 1),
        event=event,
        parameter=parameter,
    )


def test_what_lies_beyond_the_limits_by_more_than_rounding_is_left_out() -> None:
    points = LastPoints((1.0, 2.0))

    found = points.added([at(0.9), at(1.0), at(2.0 + 1e-13), at(2.0 + 1e-11)])

    assert [each.parameter for each in found] == pytest.approx([1.0, 2.0], abs=1e-12)


def test_points_are_taken_back_with_the_events_before_them_that_were_told() -> None:
    points = LastPoints((1.0, 2.0))
    points.added([at(1.1)])
    points.added([at(1.2, "peak"), at(1.3)])
    points.added([at(1.9, "fold"), at(2.1)])

    found = points.taken_back(2)

    assert sorted(each.parameter for each in found) == [1.2, 1.3, 1.9]
    assert [each.parameter for each in points.taken_back(1)] == [1.1]
