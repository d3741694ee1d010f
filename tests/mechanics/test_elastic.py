"""Elastic friction along curves: against closed forms, and at second order."""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import Press, traction
from microslip_mechanics.contact.points import ELASTIC, PointLaw, contact_table

POINTS = contact_table(
    [PointLaw(stiffness=1.0, friction=ELASTIC, dynamic=0.5, tangential=2.0)]
)
"""slip limit 0.5 N under 1 N, and a spring of 2 N/m"""


def one_step(
    slide: Array, loads: tuple[float, float], old: Array
) -> tuple[Array, Array]:
    """Return the traction after a slide under loads (before, after), and tangents."""
    new, by = np.empty(2), np.empty((2, 10))
    before, after = (Press(load, load) for load in loads)  # a spring of 1 N/m
    traction(POINTS, 0, slide, np.zeros(2), after, before, old, new, by)
    return new, by


def marched(
    path: Callable[[Array], Array], load: Callable[[Array], Array], steps: int
) -> Array:
    """Return the tractions at the ends of equal steps along a path, (steps + 1, 2)."""
    time = np.linspace(0.0, 1.0, steps + 1)
    motion, pressed, made = path(time), load(time), np.zeros((steps + 1, 2))
    for step in range(steps):
        loads = float(pressed[step]), float(pressed[step + 1])
        made[step + 1], _ = one_step(motion[step + 1] - motion[step], loads, made[step])
    return made


def test_along_a_circle_the_traction_lags_by_a_constant_angle() -> None:
    # R dψ = - k_t |dw| sin ψ, and the slide turns by |dw| / ρ: sin ψ = - R / (k_t ρ)
    radius, turn, lag = 0.75, 6.3, math.asin(0.5 / (2.0 * 0.75))

    def circle(time: Array) -> Array:
        return radius * np.column_stack([np.cos(turn * time), np.sin(turn * time)])

    angle = turn + 0.5 * math.pi - lag
    exact = 0.5 * np.array([math.cos(angle), math.sin(angle)])
    errors = [
        float(np.linalg.norm(marched(circle, np.ones_like, steps)[-1] - exact))
        for steps in (50, 100, 200)
    ]
    assert errors[0] < 0.005 * 0.5
    assert [a / b for a, b in pairwise(errors)] == (pytest.approx([4.0, 4.0], rel=0.01))


def test_of_second_order_under_a_load_that_varies() -> None:
    def path(time: Array) -> Array:
        along = np.cos(6.3 * time) + 0.5 * np.sin(12.0 * time)
        return np.column_stack([along, 0.75 * np.sin(6.3 * time + 0.3)])

    def load(time: Array) -> Array:
        varying: Array = 1.0 + 0.5 * np.sin(9.0 * time)
        return varying

    steps, finest = (100, 200, 400), 6400
    exact = marched(path, load, finest)
    errors = [
        math.sqrt(np.square(marched(path, load, n) - exact[:: finest // n]).mean())
        for n in steps
    ]
    ratios = [a / b for a, b in pairwise(errors)]
    assert ratios == pytest.approx([4.0, 4.0], rel=0.02)


@pytest.mark.parametrize("loads", [(1.0, 1.0), (1.0, 1.3), (1.0, 0.4), (0.0, 1.0)])
def test_one_tangent_is_a_clipped_spring(loads: tuple[float, float]) -> None:
    limit = 0.5 * loads[1]
    for before in np.linspace(-0.5, 0.5, 11) * loads[0]:
        for pull in np.linspace(-2.0, 2.0, 41):
            new, by = one_step(
                np.array([0.5 * pull, 0.0]), loads, np.array([before, 0.0])
            )
            spring = before + pull
            assert new == pytest.approx([np.clip(spring, -limit, limit), 0.0])
            assert np.isfinite(by).all()
            if abs(spring) > limit + 1e-9:  # only the load moves it
                assert by[0, [0, 5, 6]] == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
                assert by[0, 4] == pytest.approx(0.5 * np.sign(spring))


def test_a_traction_beyond_its_limit_comes_back_to_it() -> None:
    # a period is begun with a guess of the traction
    for slide in ([0.0, 0.0], [-0.2, 0.1], [-3.0, 0.0], [3.0, 0.4]):
        new, by = one_step(np.array(slide), (1.0, 1.0), np.array([2.0, 1.0]))
        assert math.hypot(*new) == pytest.approx(0.5)
        assert np.isfinite(by).all()
    # while it comes nearer nothing slips
    inward, _ = one_step(np.array([-0.2, 0.1]), (1.0, 1.0), np.array([2.0, 1.0]))
    assert inward == pytest.approx([0.4, 0.3])


def test_where_a_point_touches_the_slide_alone_gives_the_direction() -> None:
    new, by = one_step(np.array([3.0, 4.0]), (0.0, 1.0), np.zeros(2))
    assert new == pytest.approx([0.3, 0.4])
    # it turns with the slide, across it
    assert by[:, :2] == pytest.approx(
        0.5 / 5.0 * np.array([[0.64, -0.48], [-0.48, 0.36]])
    )


@pytest.mark.parametrize("slide", [[0.0, 0.0], [3.0, 4.0]])
def test_without_friction_there_is_no_traction(slide: list[float]) -> None:
    # whatever traction a period is begun with
    smooth = contact_table(
        [PointLaw(stiffness=1.0, friction=ELASTIC, dynamic=0.0, tangential=2.0)]
    )
    new, by = np.empty(2), np.empty((2, 10))
    press = Press(1.0, 1.0)
    old = np.array([2.0, 1.0])
    traction(smooth, 0, np.array(slide), np.zeros(2), press, press, old, new, by)
    assert (new == 0.0).all()
    assert (by == 0.0).all()
