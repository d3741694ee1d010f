"""One step along a curve: how far it is shortened where settled points stray."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from hbm.continuation.arc_step import next_point
from hbm.continuation.continuation import trace
from hbm.continuation.correction import Correction
from hbm.continuation.newton import Small
from hbm.continuation.predictor import Predictor
from hbm.continuation.settler import Unsettled
from hbm.continuation.step_control import StepControl
from microslip_mechanics.arrays import Array
from systems import Dense

CONTROL = StepControl(initial=0.2, smallest=1e-5, largest=0.2, tolerance=1e-10)


def axis(point: Array) -> tuple[Array, Dense]:
    """Return x: the parameter's axis."""
    return point[:1], Dense([[1.0, 0.0]])


class Straying(Unsettled):
    """Settles points aside of the curve, as harmonics that lead elsewhere do."""

    def __init__(self, aside: Callable[[float], float]) -> None:
        """Take by how much, from the parameter of a point."""
        self._aside = aside

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
    ) -> Correction:
        """Return the point aside."""
        correction = super().settle(correction, normal, tolerance, small)
        parameter = correction.point[-1]
        return replace(correction, point=np.array([self._aside(parameter), parameter]))


@pytest.mark.parametrize(
    ("aside", "taken"),
    [
        pytest.param(lambda _: 1.0, 0.1, id="half of it is no better"),
        pytest.param(lambda step: 8.0 * step, 0.05, id="until it leads nowhere else"),
        pytest.param(lambda step: step, 0.2, id="not far"),
    ],
)
def test_a_step_that_strays_is_halved_as_long_as_that_helps(
    aside: Callable[[float], float], taken: float
) -> None:
    past = Predictor()
    past.append(np.zeros(2), np.array([0.0, 1.0]), np.ones(2), CONTROL.initial)

    found, step = next_point(axis, past, CONTROL.initial, CONTROL, Straying(aside))

    assert step == taken
    np.testing.assert_allclose(found.point, [aside(taken), taken])


@pytest.mark.parametrize("gap", [0.01, 0.06])
def test_a_step_does_not_lead_to_the_other_side_of_an_avoided_crossing(
    gap: float,
) -> None:
    """Two curves come as near to each other as ``gap`` and part again."""

    def parting(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        rows = [[2.0 * x, -2.0 * parameter]]
        return np.array([x**2 - parameter**2 - 0.25 * gap**2]), Dense(rows)

    start = np.array([1.0, -1.0])

    curve = trace(parting, start, 1.0, metric=np.ones_like, control=CONTROL)

    points = np.array([each.point for each in curve])
    assert (points[:, 0] > 0.0).all()
    assert points[-1] == pytest.approx([np.hypot(1.0, 0.5 * gap), 1.0])


def test_a_curve_goes_straight_through_a_branch_point() -> None:
    def crossing(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        return np.array([x**2 - parameter**2]), Dense([[2.0 * x, -2.0 * parameter]])

    start = np.array([1.0, -1.0])

    curve = trace(crossing, start, 1.01, metric=np.ones_like, control=CONTROL)

    points = np.array([each.point for each in curve])
    assert points[:, 0] == pytest.approx(-points[:, 1], abs=1e-9)
    assert points[-1, -1] == 1.01
