"""The multiplier that crosses the circle, among others that stay or take its place."""

import numpy as np
import pytest

from hbm.events.crossed import BRANCH, TORUS, crossed
from hbm.events.moving_multiplier import MovingMultiplier, outside
from microslip_mechanics.results.response import MARGIN

NEUTRAL = 0.999996
AWAY = 2.0 * MARGIN


def ordered(*values: complex) -> np.ndarray:
    """Return multipliers, the largest modulus first."""
    found = np.array(values, dtype=complex)
    return found[np.argsort(-np.abs(found))]


def test_one_at_plus_one_does_not_stand_for_what_has_moved_below_it() -> None:
    out, inside = ordered(1.05, NEUTRAL, 0.9), ordered(NEUTRAL, 0.93, 0.9)

    moving = MovingMultiplier(0, out, inside)

    assert moving.ends == pytest.approx((0.05, -0.07), abs=AWAY)
    assert moving.growth(ordered(NEUTRAL, 0.99, 0.9)) == pytest.approx(-0.01, abs=AWAY)
    assert moving.growth(ordered(1.01, NEUTRAL, 0.9)) == pytest.approx(0.01, abs=AWAY)
    assert moving.outside == pytest.approx(1.01)


def test_a_conjugate_pair_that_splits_leaves_one_outside() -> None:
    pair = ordered(1.03 + 0.02j, 1.03 - 0.02j, NEUTRAL, 0.7)
    split = ordered(1.2, NEUTRAL, 0.98, 0.7)

    moving = MovingMultiplier(1, pair, split)

    assert moving.ends[0] > 0.0
    assert moving.ends[1] == pytest.approx(-0.02, abs=AWAY)


def test_what_rounding_makes_of_a_double_multiplier_is_not_outside() -> None:
    # A free mass without a damper, its map scaled as those of structures are.
    free = np.array([[1.0 + 3e-12, 1.0], [0.0, 1.0]]) + np.array([[0, 0], [4e-12, 0]])
    double = np.linalg.eigvals(free).astype(complex)

    assert double.real.max() > 1.0 + 1e-6
    assert outside(double) == 0
    assert outside(ordered(1.00002, NEUTRAL)) == 1


def test_signs_are_those_of_the_number_outside() -> None:
    moving = MovingMultiplier(0, ordered(1.1, NEUTRAL), ordered(NEUTRAL, 0.8))

    assert moving.growth(ordered(1.3, 1.2)) > 0.0
    assert moving.growth(ordered(NEUTRAL, 0.2)) < 0.0


def test_what_pairs_with_a_neutral_multiplier_still_crosses_at_plus_one() -> None:
    assert crossed(1.00003 - 8e-5j) == BRANCH
    assert crossed(1.0022 - 0.0145j) == TORUS
    assert crossed(-1.0001 + 0.0j) == "period doubling"


def test_one_of_a_pair_that_crosses_alone_makes_no_torus() -> None:
    pair, parted = [1.02 + 0.1j, 1.02 - 0.1j], [1.1, 0.9]
    both = MovingMultiplier(0, ordered(*pair), ordered(0.9 + 0.1j, 0.9 - 0.1j))
    moving = MovingMultiplier(1, ordered(*pair), ordered(*parted))

    assert not both.alone
    assert moving.alone
    assert crossed(moving.outside) == TORUS
    assert crossed(moving.outside, alone=True) == BRANCH
