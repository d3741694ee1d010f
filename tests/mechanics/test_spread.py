"""Forces that jump as faces touch, spread over the steps of a march."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.jump import contact_jump
from microslip_mechanics.contact.law import sudden
from microslip_mechanics.contact.points import GENERAL_KINETIC, PointLaw, contact_table
from microslip_mechanics.contact.spread import spread_force

STEP, GAP = 1e-3, 2e-4
DASHPOT = PointLaw(gap=GAP, stiffness=5e4, damping=7.0)
RUBBING = PointLaw(
    gap=GAP, stiffness=5e4, damping=7.0, friction=GENERAL_KINETIC, dynamic=0.3,
    static=0.4, viscous=2.0, threshold=0.05,
)  # fmt: skip


def force_of(law: PointLaw, moved: Array, moving: Array) -> tuple[Array, Array]:
    """Return the force of a point and its tangents."""
    force, tangents = np.zeros(3), np.zeros((5, 3, 3))
    spread_force(contact_table([law]), 0, STEP, moved, moving, force, tangents)
    return force, tangents[:2]


@pytest.mark.parametrize("law", [DASHPOT, RUBBING])
@pytest.mark.parametrize("inside", [-0.9, -0.3, 0.2, 0.7, 1.5])
@pytest.mark.parametrize("speed", [-0.3, 0.2])
def test_tangents_are_those_of_the_force(
    law: PointLaw, inside: float, speed: float
) -> None:
    moved = np.array([GAP + inside * STEP * abs(speed), 0.0, 0.0])
    moving = np.array([speed, 0.4, -0.1])

    _, (elastic, viscous) = force_of(law, moved, moving)

    for axis, nudge in enumerate(1e-6 * np.eye(3)):
        size = 1e-3 * nudge  # of a displacement
        more, less = (force_of(law, moved + each, moving)[0] for each in (size, -size))
        slope = (more - less) / (2.0 * size[axis])
        np.testing.assert_allclose(elastic[:, axis], slope, rtol=1e-5, atol=1e-2)
        more, less = (
            force_of(law, moved, moving + each)[0] for each in (nudge, -nudge)
        )
        slope = (more - less) / (2.0 * nudge[axis])
        np.testing.assert_allclose(viscous[:, axis], slope, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("speed", [0.2, -0.2])
@pytest.mark.parametrize("late", [0.0, 0.25, 0.6, 0.99])
def test_the_impulse_of_a_jump_and_its_moment_are_right_wherever_in_a_step_it_is(
    speed: float, late: float
) -> None:
    # a force of 1.4 N from the moment of touch on, or up to that of parting
    law = PointLaw(gap=GAP, damping=7.0)
    times = STEP * (np.arange(21) - 10.0)
    touch = late * STEP

    moving = np.array([speed, 0.0, 0.0])
    places = GAP + speed * (times - touch)
    jumps = np.array(
        [force_of(law, np.array([each, 0.0, 0.0]), moving)[0][0] for each in places]
    )

    weights = np.full(times.size, STEP)
    weights[[0, -1]] /= 2.0
    begin, end = (touch, times[-1]) if speed > 0.0 else (times[0], touch)
    assert weights @ jumps == pytest.approx(7.0 * speed * (end - begin), rel=1e-9)
    moment = 7.0 * speed * (end**2 - begin**2) / 2.0
    assert (weights * times) @ jumps == pytest.approx(moment, rel=1e-9)


def test_a_law_without_a_jump_is_as_it_is() -> None:
    law = PointLaw(gap=GAP, stiffness=5e4)
    moved, moving = np.array([GAP + 1e-6, 0.0, 0.0]), np.array([0.3, 0.0, 0.0])

    force, _ = force_of(law, moved, moving)

    assert force[0] == pytest.approx(5e4 * 1e-6)


@pytest.mark.parametrize("power", [0.0, 0.25, 1.0])
def test_damping_jumps_unless_it_grows_with_penetration(power: float) -> None:
    points = contact_table([PointLaw(damping=7.0, damping_exponent=power)])
    near, far = (
        abs(contact_jump(points, 0, np.array([0.3, 0.0, 0.0]), depth)[0])
        for depth in (1e-15, 1e-9)
    )

    assert sudden(points, 0) == (near > 0.9 * far)
