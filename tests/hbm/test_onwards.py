"""Where a curve goes on that few harmonics have led to and fro."""

from collections.abc import Sequence

import numpy as np
import pytest

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.step_control import StepControl
from hbm.curves.onwards import onwards
from microslip_mechanics.arrays import Array
from systems import Dense

APART = 0.05
"""of the two lines"""
ALONG = np.array([1.0, 1.0]) / np.sqrt(2.0)
RIPPLE = 1e-3
"""by which points are beside a line"""


def lines(point: Array) -> tuple[Array, Dense]:
    """Return what is zero on two lines side by side, as more harmonics have them."""
    x, parameter = point
    one, other = x - parameter, x - parameter - APART
    return np.array([one * other]), Dense(
        (one + other) * np.array([[1.0, -1.0]]),
    )


def walked(places: Sequence[float], beside: Sequence[float]) -> list[Correction]:
    """Return what fewer harmonics have: points about the lines, with their ripples."""
    way = []
    for number, (place, aside) in enumerate(zip(places, beside, strict=True)):
        point = np.array([place + aside + (-1) ** number * RIPPLE, place])
        residual, linearised = lines(point)
        heads = np.sign(places[number] - places[number - 1]) if number else 1.0
        way.append(
            Correction(
                point, residual, linearised, Outcome.CONVERGED, (0.0,), heads * ALONG
            )
        )
    return way


@pytest.mark.parametrize(
    ("places", "beside", "on"),
    [
        ([0.1, 0.2, 0.3, 0.4], [0.0] * 4, 1.0),
        ([0.9, 0.8, 0.7, 0.4], [0.0] * 4, -1.0),
        ([0.9, 0.6, 0.3, 0.2, 0.3, 0.4], [0.0] * 6, -1.0),
        ([0.1, 0.5, 0.6, 0.2, 0.3, 0.4], [0.0] * 6, 1.0),
        ([0.1, 0.6, 0.7, 0.5, 0.4], [0.0] * 5, 1.0),
        ([0.9, 0.6, 0.3, 0.2, 0.3, 0.4], [APART] * 3 + [0.0] * 3, 1.0),
    ],
    ids=[
        "straight on",
        "downwards",
        "down, then back up",
        "up, back and up again",
        "up, then back down",
        "down another line, then up this one",
    ],
)
def test_a_curve_goes_on_away_from_where_it_has_begun(
    places: list[float], beside: list[float], on: float
) -> None:
    way = walked(places, beside)
    found = np.array([0.4, 0.4])

    along = onwards(lines, way, found, np.ones(2), StepControl(tolerance=1e-12))

    assert np.array_equal(along, on * ALONG)


def test_a_way_of_one_point_goes_on_as_it_does() -> None:
    way = walked([0.4], [0.0])

    along = onwards(lines, way, np.array([0.4, 0.4]), np.ones(2), StepControl())

    assert np.array_equal(along, ALONG)
