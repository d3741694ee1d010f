"""Two Newton steps at a finer resolution, and what they say that they leave."""

import math

import numpy as np
import pytest

from hbm.balance.refined import (
    FIRM,
    MOST,
    PATIENT,
    SAFE,
    WARY,
    Patience,
    Refined,
    refined,
)
from hbm.continuation.linearised import Linearised
from microslip_mechanics.arrays import Array

UPRIGHT = np.array([0.0, 1.0])
FEW, MANY = 7, 31
"""harmonics"""


class Slope:
    """A derivative by the first of two components."""

    exact = True

    def __init__(self, slope: float) -> None:
        self._slope = slope

    def solve(self, normal: Array, right: Array) -> Array:
        del normal
        return np.array([right[0] / self._slope, right[1]])

    def orientation(self, tangent: Array) -> float:
        del tangent
        return 0.0

    def forget(self) -> None:
        """Keep the slope."""


class Root:
    """x² = 2, or what steps lead away from, with contact impulses that are given."""

    def __init__(self, *impulses: float, away: bool = False) -> None:
        self._impulses, self._away = list(impulses), away

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        slope = 2.0 * point[0] if not self._away else -0.3 * point[0]
        return self.residual(point), Slope(slope)

    def residual(self, point: Array) -> Array:
        return point[:1] ** 2 - 2.0

    def impulses(self, above: int, most: int) -> float:
        assert most == 2 * above + 1
        return self._impulses.pop(0)

    def answer(self, point: Array, residual: Array, above: int) -> Array:
        raise NotImplementedError(point, residual, above)


class Beyond(Root):
    """x = 3, with a hollow about x = 0 from which steps lead away and come back."""

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        place = point[0]
        slope = 3.0 * place**2 - 6.0 * place + 0.05
        return self.residual(point), Slope(slope)

    def residual(self, point: Array) -> Array:
        place = point[:1]
        return (place**2 + 0.05) * (place - 3.0)


class Bending(Root):
    """arctan x = 0, beyond which whole steps go farther and farther."""

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        return self.residual(point), Slope(1.0 / (1.0 + point[0] ** 2))

    def residual(self, point: Array) -> Array:
        return np.arctan(point[:1])


def steps(
    start: float,
    system: Root,
    harmonics: int = MANY,
    patience: Patience | None = None,
) -> Refined:
    point = np.array([start, 5.0])
    return refined(system, point, harmonics, UPRIGHT, patience=patience)


@pytest.mark.parametrize("start", [2.5, 1.5])
def test_the_steps_leave_what_the_next_ones_change(start: float) -> None:
    found = steps(start, Root(1.0, 0.1))

    last = found.corrected[0] - found.before[0]
    assert abs(found.left * last) == pytest.approx(
        abs(math.sqrt(2.0) - found.corrected[0]), rel=0.1
    )
    assert found.corrected[1] == 5.0


def test_steps_that_lead_away_leave_everything() -> None:
    assert steps(3.0, Root(1.0, 0.1, away=True)).left == math.inf


def test_steps_that_take_back_a_rise_go_on() -> None:
    found = steps(2.4, Beyond(1.0, 0.1))

    told = found.left * abs(found.corrected[0] - found.before[0])
    true = abs(found.corrected[0] - 3.0)
    # the third of them has brought the residual from 2.2 to 0.4 of what it was
    assert true < 0.02
    assert told == pytest.approx(true, rel=0.1)


def test_a_rise_that_is_taken_back_near_the_point_does_not_matter() -> None:
    start = np.array([2.4, 5.0])

    near, far = (
        refined(Beyond(1.0, 0.1), start, MANY, UPRIGHT, seen)
        for seen in (lambda _: False, lambda _: True)
    )

    assert abs(near.corrected[0] - 3.0) > 0.1
    assert abs(far.corrected[0] - 3.0) < 0.02


def test_a_rise_that_is_not_taken_back_leaves_everything() -> None:
    assert steps(0.1, Beyond(1.0, 0.1)).left == math.inf


def test_with_the_most_harmonics_steps_that_would_lead_away_are_halved() -> None:
    whole, halved = (
        steps(1.5, Bending(1.0, 0.1), harmonics) for harmonics in (255, 511)
    )

    assert whole.left == math.inf
    assert halved.left < 0.1
    assert halved.corrected[0] == pytest.approx(0.0, abs=1e-3)


def test_patience_finds_what_is_farther_away() -> None:
    firm, patient = (
        steps(10.0, Bending(1.0, 0.1), patience=each) for each in (FIRM, PATIENT)
    )

    assert firm.left == math.inf
    told = patient.left * abs(patient.corrected[0] - patient.before[0])
    assert abs(patient.corrected[0]) <= max(told, 1e-9) < 0.5


def test_many_steps_that_lead_away_leave_everything() -> None:
    away = Root(1.0, 0.1, away=True)

    assert steps(3.0, away, patience=PATIENT).left == math.inf


def test_steps_of_rounding_are_not_taken_for_steps_that_lead_away() -> None:
    assert steps(math.sqrt(2.0), Root(1.0, 0.1)).left == 1.0


@pytest.mark.parametrize("share", [0.01, 0.1])
def test_series_that_fall_faster_leave_less_by_the_square(share: float) -> None:
    assert steps(2.5, Root(2.0, 2.0 * share)).beyond == (SAFE * share) ** 2
    few = steps(2.5, Root(2.0, 2.0 * share), FEW).beyond
    assert few == pytest.approx((WARY * share) ** 2)


def test_slow_series_of_many_harmonics_leave_twice_what_was_found() -> None:
    assert steps(2.5, Root(1.0, 0.9)).beyond == MOST
    assert steps(2.5, Root(1.0, 0.9), FEW).beyond > MOST
