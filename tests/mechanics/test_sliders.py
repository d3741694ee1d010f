"""What contacts remember along a motion: where a point that touches begins to stick."""

from dataclasses import replace

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import BRISTLE, ELASTIC, PointLaw, contact_table
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides, slides_of

SHOE = PointLaw(stiffness=60.0, gap=0.3, friction=ELASTIC, dynamic=40.0, tangential=8.0)
EVERY = np.eye(3)


def touched(deeper: float, steps: int) -> Slides:
    """Return what a point remembers that comes down while it moves sideways."""
    moved, moving = np.zeros((2, steps + 1, 1, 3))
    time = np.linspace(0.0, 1.0, steps + 1)
    moved[:, 0, 0], moving[:, 0, 0] = time**2 + deeper, 2.0 * time
    moved[:, 0, 1], moving[:, 0, 1] = 0.3 * time, 0.3
    moved[:, 0, 2], moving[:, 0, 2] = -0.2 * time**2, -0.4 * time
    sliders = Sliders.of(contact_table([SHOE]), EVERY)
    return slides_of(sliders, moved, moving, np.zeros(2), 1.0)


def by_depth(slides: Slides) -> Array:
    """Return the change of the last tractions if all depths are greater by one."""
    deeper, change = EVERY[0], np.zeros(2)
    for place in range(1, len(slides.motion)):
        change = (
            slides.traction_past[place] @ change - slides.past[place, :, :3] @ deeper
        )
        change += slides.motion[place, :, :3] @ deeper
    return change


def held(deeper: float) -> Array:
    """Return the tractions at the end, k_t (w − w_touch)."""
    touch = np.sqrt(0.3 - deeper)
    return 8.0 * np.array([0.3 * (1.0 - touch), -0.2 * (1.0 - touch**2)])


def test_a_point_that_touches_sooner_sticks_sooner() -> None:
    touch = np.sqrt(0.3)
    # w_touch = w(t), and t = √(0.3 − deeper)
    exact = 8.0 * np.array([0.3, -0.4 * touch]) / (2.0 * touch)

    assert by_depth(touched(0.0, 1000)) == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize("friction", [ELASTIC, BRISTLE])
def test_a_step_that_touches_slides_from_there_on(friction: int) -> None:
    # from 0.1 m above the surface to 0.4 m below it: it touches at a fifth of the step
    shoe = replace(SHOE, friction=friction, static=40.0, stribeck=1.0)
    moved, moving = np.zeros((2, 2, 1, 3))
    moved[:, 0] = [[0.3 - 0.1, 0.0, 0.0], [0.3 + 0.4, 0.25, -0.1]]

    def made(moved: Array) -> Slides:
        sliders = Sliders.of(contact_table([shoe]), EVERY)
        return slides_of(sliders, moved, moving, np.zeros(2), 1.0)

    slides = made(moved)

    # a mean load of 12 N, of 40 times which the bristles bend by a hundredth
    stuck = 8.0 * 0.8 * np.array([0.25, -0.1])
    accuracy = 1e-14 if friction == ELASTIC else 1e-2
    assert slides.traction[1] == pytest.approx(stuck, rel=accuracy)
    for end, found in ((0, -slides.past[1]), (1, slides.motion[1])):
        for axis in range(3):
            changed = np.zeros((2, 2, 1, 3))
            changed[0, end, 0, axis], changed[1, end, 0, axis] = 1e-6, -1e-6
            ahead, behind = (made(moved + each).traction[1] for each in changed)
            slope = (ahead - behind) / 2e-6
            assert found[:, axis] == pytest.approx(slope, rel=1e-7, abs=1e-7), axis


@pytest.mark.parametrize(("beyond", "sticks"), [(1e-14, True), (1e-6, False)])
def test_what_slips_by_rounding_sticks(beyond: float, sticks: bool) -> None:
    moved, moving = np.zeros((2, 65, 1, 3))
    moved[:, 0, 0] = 0.4
    moved[:, 0, 1] = 0.1 * (1.0 - np.cos(np.linspace(0.0, 2.0 * np.pi, 65)))
    sliders = Sliders.of(contact_table([SHOE]), EVERY)
    limit = 40.0 * 60.0 * (0.4 - 0.3)  # the load, times the friction coefficient
    first = np.array([limit * (1.0 + beyond) - 8.0 * 0.2, 0.0])

    slides = slides_of(sliders, moved, moving, first, 1.0)

    assert slides.stuck.tolist() == [sticks, sticks]
    assert (slides.traction_past[1:] == np.eye(2)).all() == sticks


def test_tractions_err_with_the_square_of_the_steps_where_a_point_touches() -> None:
    # where in its step the touch lies is an accident: the worst of some counts
    depths = np.linspace(0.0, 0.1, 21)
    errors = [
        max(np.abs(touched(d, steps).traction[-1] - held(d)).max() for d in depths)
        for steps in (20, 40, 80, 160)
    ]

    assert errors[-1] < 1e-4 * np.abs(held(0.0)).max()
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.3)


def test_a_direction_that_moves_by_rounding_alone_is_no_slider() -> None:
    rounded = EVERY.copy()
    rounded[2] *= 1e-17

    sliders = Sliders.of(contact_table([SHOE]), rounded)

    assert sliders.axis.tolist() == [0]
