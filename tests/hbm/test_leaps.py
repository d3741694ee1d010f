"""A trace across a gap of its curve."""

import math

import numpy as np
import pytest

from hbm.continuation.continuation import trace
from hbm.continuation.leaps import Leaping
from hbm.continuation.linearised import System
from hbm.continuation.settler import UNSETTLED
from hbm.continuation.step_control import StepControl
from hbm.continuation.tracing import Tracing
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array
from systems import Dense

CONTROL = StepControl(smallest=1e-5, largest=0.02, tolerance=1e-10)
START = np.array([0.0, 0.0])


def parabola(last: float) -> System:
    """Return y = x², which has no residual from x = 0.5 to ``last``."""

    def residual(point: Array) -> tuple[Array, Dense]:
        y, x = point
        value = math.nan if 0.5 < x < last else y - x**2
        return np.array([value]), Dense([[1.0, -2.0 * x]])

    return residual


def metric(point: Array) -> Array:
    return np.ones_like(point)


def tracing(system: System) -> Tracing:
    """Return what traces a system from where it starts to one."""
    return Tracing(system, 1.0, float(START[-1]), metric, CONTROL, UNSETTLED)


def test_a_gap_is_passed_along_the_tangent() -> None:
    system = parabola(0.55)
    with pytest.raises(ContinuationError):
        list(trace(system, START, 1.0, metric=metric, control=CONTROL))

    points = [each.point for each in Leaping(tracing(system), START)]

    places = np.array([x for _, x in points])
    assert np.all(np.diff(places) >= 0.0)
    assert places[-1] == 1.0
    assert np.diff(places).max() < 0.3
    for y, x in points:
        assert y == pytest.approx(x**2, abs=1e-9)


def test_what_is_wider_than_a_leap_ends_the_curve() -> None:
    leaping = Leaping(tracing(parabola(0.9)), START)

    points: list[Array] = []
    with pytest.raises(ContinuationError, match="not even past it"):
        points.extend(each.point for each in leaping)

    assert points[-1][1] == pytest.approx(0.5, abs=1e-3)
