"""Rigid friction: the nearest traction, and a mass that slides under it."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.rigid import nearest_traction, slide

LOSS = 0.05


def slid(state: Array) -> tuple[Array, Array]:
    """Return traction and momentum from (push, limit, momentum, loss), and slopes."""
    step, by = np.empty(4), np.empty((4, 6))
    slide(state[:2].copy(), state[2], state[5], state[3:5].copy(), step, by)
    return step, by


def states(count: int, *, line: bool) -> Array:
    """Return masses that speed up, slow down, stop, stand and lift off."""
    random = np.random.default_rng(5)
    drawn = random.normal(size=(count, 6))
    drawn[:, 3:5] *= random.choice([0.2, 1.0, 3.0], (count, 1))
    drawn[:, 2] = np.where(random.random(count) < 0.1, -0.3, np.abs(drawn[:, 2]))
    drawn[:, 5] = LOSS
    if line:
        drawn[:, [1, 4]] = 0.0
    return drawn


def test_nothing_on_the_disc_lies_nearer_to_a_trial() -> None:
    random = np.random.default_rng(6)
    turn = np.linspace(0.0, 2.0 * np.pi, 400)
    others = 0.8 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for trial in random.normal(size=(50, 2)):
        first, second, *_ = nearest_traction(float(trial[0]), float(trial[1]), 0.8)
        found: Array = np.array([first, second])
        assert np.hypot(*found) <= 0.8 + 1e-15
        # a convex set lies behind the plane across the way to it
        assert ((others - found) @ (trial - found)).max() <= 1e-15
        if np.hypot(*trial) <= 0.8:
            assert np.array_equal(found, trial)


@pytest.mark.parametrize("line", [False, True], ids=["plane", "line"])
def test_slopes_of_a_slide_are_central_differences(line: bool) -> None:
    kinds = set()
    for state in states(300, line=line):
        step, by = slid(state)
        stops = not step[2:].any()
        kinds.add((stops, bool(step[:2].any())))
        for column in range(6):
            push = np.zeros(6)
            push[column] = 1e-7
            slope = (slid(state + push)[0] - slid(state - push)[0]) / 2e-7
            np.testing.assert_allclose(by[:, column], slope, atol=1e-6, rtol=1e-6)
    assert kinds == {(True, True), (False, True), (False, False)}


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_mass_stops_within_a_step_when_its_impulse_is_spent(share: float) -> None:
    limit, push = 1.3, 0.4
    before = share * (limit - push)
    step, _ = slid(np.array([push, 0.0, limit, before, 0.0, 0.0]))
    assert step[2] == 0.0
    # µN until it stops, what the push asks for after that
    assert step[0] == pytest.approx(share * limit + (1.0 - share) * push)


def test_a_mass_turns_within_a_step_and_slides_back() -> None:
    limit, push, before = 0.5, -2.0, 1.0
    step, _ = slid(np.array([push, 0.0, limit, before, 0.0, 0.0]))
    share = before / (limit - push)
    assert step[0] == pytest.approx(limit * (2.0 * share - 1.0))
    assert step[2] == pytest.approx((1.0 - share) * (push + limit))


def test_momentum_without_dashpot_is_what_push_and_traction_leave() -> None:
    for state in states(100, line=False):
        state[5] = 0.0
        step, _ = slid(state)
        left = state[3:5] + state[:2] - step[:2]
        np.testing.assert_allclose(step[2:], left, atol=1e-14)
