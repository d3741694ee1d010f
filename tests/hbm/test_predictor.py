"""Extrapolation: exact on polynomials, of the order that served best, never wild."""

import numpy as np
import pytest

from hbm.continuation.predictor import MOST, STEEPEST, Predictor
from microslip_mechanics.arrays import Array

ONES = np.ones(3)


class Polynomial:
    """A curve x(s) with polynomials of an order as components."""

    def __init__(self, order: int) -> None:
        """Draw the coefficients."""
        draw = np.random.default_rng(order)
        self.series = [np.polynomial.Polynomial(draw.normal(size=order + 1))] * 3

    def at(self, place: float) -> Array:
        """Return the point."""
        return np.array([each(place) for each in self.series])

    def tangent(self, place: float) -> Array:
        """Return dx/ds."""
        return np.array([each.deriv()(place) for each in self.series])


def followed(
    curve: Polynomial, places: list[float], scale: Array = ONES
) -> tuple[Predictor, list[float]]:
    """Return what has seen the points at some places, and how it missed each."""
    predictor, missed, last = Predictor(), [], places[0]
    for place in places:
        missed.append(
            predictor.append(curve.at(place), curve.tangent(place), scale, place - last)
        )
        last = place
    return predictor, missed


PLACES = [0.0, 0.01, 0.03, 0.04, 0.045]
"""of points on a curve, by unequal steps"""


def test_one_point_predicts_along_its_tangent() -> None:
    curve = Polynomial(3)
    predictor, missed = followed(curve, [0.3])

    predicted = predictor.predict(0.02)

    assert missed == [0.0]
    assert predictor.order == 1
    np.testing.assert_allclose(predicted, curve.at(0.3) + 0.02 * curve.tangent(0.3))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_polynomials_are_followed_exactly_by_as_many_earlier_points(order: int) -> None:
    curve = Polynomial(order)

    predictor, missed = followed(curve, PLACES)

    assert missed[-1] < 1e-13
    assert predictor.order >= order
    exact = curve.at(PLACES[-1] + 0.005)
    np.testing.assert_allclose(predictor.predict(0.005), exact, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_an_extrapolation_of_an_order_errs_with_the_next(order: int) -> None:
    errors = []
    for step in (0.04, 0.02, 0.01):
        predictor, _ = followed(Polynomial(6), [place * step for place in range(-3, 1)])
        predictor.order = order
        away = predictor.predict(step) - Polynomial(6).at(step)
        errors.append(float(np.abs(away).max()))

    rates = np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
    np.testing.assert_allclose(rates, order + 1.0, atol=0.35)


def test_the_order_drops_again_where_the_past_says_nothing() -> None:
    predictor, _ = followed(Polynomial(3), PLACES)
    high = predictor.order

    # A kink: the curve goes on straight, along another tangent.
    last, along = Polynomial(3).at(PLACES[-1] + 0.01), np.array([1.0, -2.0, 0.5])
    predictor.append(last, along, ONES, 0.01)
    missed = predictor.append(last + 0.01 * along, along, ONES, 0.01)

    assert high >= 3
    assert missed < 1e-13
    assert predictor.order == 1


def test_a_miss_is_measured_in_the_scale() -> None:
    scale = np.array([0.5, 4.0, 2.0])

    _, plain = followed(Polynomial(2), PLACES[:2])
    _, scaled = followed(Polynomial(2), PLACES[:2], scale)

    away = plain[-1] / np.sqrt(3.0)
    assert scaled[-1] == pytest.approx(away * np.linalg.norm(1.0 / scale))


def test_no_more_than_a_few_points_are_looked_back_upon() -> None:
    long, _ = followed(Polynomial(3), [-0.1, -0.05, *PLACES])
    short, _ = followed(Polynomial(3), PLACES[-MOST - 1 :])
    long.order = short.order = 99

    np.testing.assert_array_equal(long.predict(0.003), short.predict(0.003))


def test_an_extrapolation_that_leaves_the_tangent_by_much_is_not_trusted() -> None:
    predictor, _ = followed(Polynomial(2), PLACES)
    predictor.order = 2
    line = Polynomial(2).at(PLACES[-1]), Polynomial(2).tangent(PLACES[-1])
    second = Polynomial(2).series[0].deriv(2)(0.0)
    bend = float(np.linalg.norm(second / 2.0 * ONES))
    limit = STEEPEST / bend

    near, far = predictor.predict(0.99 * limit), predictor.predict(1.01 * limit)

    exact = Polynomial(2).at(PLACES[-1] + 0.99 * limit)
    np.testing.assert_allclose(near, exact, rtol=0.0, atol=1e-10)
    np.testing.assert_array_equal(far, line[0] + 1.01 * limit * line[1])
