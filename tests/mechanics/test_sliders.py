"""What contacts remember along a motion: where a point that touches begins to stick."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ELASTIC, PointLaw, contact_table
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides, slides_of

STEPS = 20_000
SHOE = PointLaw(stiffness=60.0, gap=0.3, friction=ELASTIC, dynamic=40.0, tangential=8.0)
EVERY = np.eye(3)


def touched(deeper: float, *, continuous: bool = True) -> Slides:
    """Return what a point remembers that comes down while it moves sideways."""
    moved, moving = np.zeros((2, STEPS + 1, 1, 3))
    time = np.linspace(0.0, 1.0, STEPS + 1)
    moved[:, 0, 0], moving[:, 0, 0] = time**2 + deeper, 2.0 * time
    moved[:, 0, 1], moving[:, 0, 1] = 0.3 * time, 0.3
    moved[:, 0, 2], moving[:, 0, 2] = -0.2 * time**2, -0.4 * time
    sliders = Sliders.of(contact_table([SHOE]), EVERY)
    return slides_of(sliders, moved, moving, np.zeros(2), 1.0, continuous=continuous)


def by_depth(slides: Slides) -> Array:
    """Return the change of the last tractions if all depths are greater by one."""
    deeper, change = EVERY[0], np.zeros(2)
    for place in range(1, STEPS + 1):
        change = (
            slides.traction_past[place] @ change - slides.past[place, :, :3] @ deeper
        )
        change += slides.motion[place, :, :3] @ deeper
    return change


def test_a_point_that_touches_sooner_sticks_sooner() -> None:
    touch = np.sqrt(0.3)
    slides = touched(0.0)

    assert slides.traction[-1] == pytest.approx(
        [8.0 * 0.3 * (1.0 - touch), -8.0 * 0.2 * (1.0 - touch**2)], rel=1e-3
    )
    # w_touch = w(t), and t = √(0.3 − deeper)
    exact = 8.0 * np.array([0.3, -0.4 * touch]) / (2.0 * touch)
    assert by_depth(slides) == pytest.approx(exact, rel=1e-3)
    step = 0.01
    ends = [touched(sign * step).traction[-1] for sign in (1.0, -1.0)]
    assert by_depth(slides) == pytest.approx(
        (ends[0] - ends[1]) / (2.0 * step), rel=1e-2
    )


def test_either_end_of_a_step_moves_the_touch_by_its_share() -> None:
    # A step from 0.1 m above the surface to 0.4 m below it touches at a fifth of it;
    # 1 m deeper it touches 1/ḋ sooner, where it is ẇ/ḋ less far: T = k_t (w − w_touch).
    # The depth there is that before the step by four fifths, that after it by one.
    moved, moving = np.zeros((2, 2, 1, 3))
    moved[:, 0, 0], moved[:, 0, 1] = [0.3 - 0.1, 0.3 + 0.4], [0.0, 0.25]
    moving[:, 0, 0], moving[:, 0, 1] = [1.0, 2.0], [0.4, 0.1]
    sliders = Sliders.of(contact_table([SHOE]), EVERY)

    known, unknown = (
        slides_of(sliders, moved, moving, np.zeros(2), 1.0, continuous=each)
        for each in (True, False)
    )

    stiffer = 8.0 * (0.8 * 0.4 + 0.2 * 0.1) / (0.8 * 1.0 + 0.2 * 2.0)
    by_depth_after = (known.motion - unknown.motion)[1, 0, 0]
    by_depth_before = -(known.past - unknown.past)[1, 0, 0]
    assert by_depth_after == pytest.approx(0.2 * stiffer)
    assert by_depth_before == pytest.approx(0.8 * stiffer)


def test_steps_that_touch_jump_and_know_nothing_of_it() -> None:
    assert by_depth(touched(0.0, continuous=False)) == pytest.approx(np.zeros(2))
