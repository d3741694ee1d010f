"""Regularised Coulomb friction against its closed form."""

import math

import numpy as np
import pytest

from microslip_mechanics.contact.coulomb import Coulomb, coulomb_coefficients

pytestmark = pytest.mark.kernels

LAW = Coulomb(coefficient=0.3, threshold=1e-3)
ANGLES = np.linspace(0.1, 2.0 * np.pi, 9)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("speed", [1e-9, 4e-4, 9.99e-4])
def test_friction_is_proportional_to_velocity_below_the_threshold(
    speed: float, angle: float
) -> None:
    velocity = speed * math.cos(angle), speed * math.sin(angle)

    first, second, d11, d12, d22 = coulomb_coefficients(LAW, *velocity)

    assert (first, second) == pytest.approx(
        (300.0 * velocity[0], 300.0 * velocity[1]), rel=1e-14, abs=0.0
    )
    assert (d11, d12, d22) == pytest.approx((300.0, 0.0, 300.0), rel=1e-14, abs=0.0)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("speed", [1.001e-3, 0.3, 1e4])
def test_friction_has_the_size_mu_and_the_direction_of_sliding_above_the_threshold(
    speed: float, angle: float
) -> None:
    along, across = math.cos(angle), math.sin(angle)

    first, second, d11, d12, d22 = coulomb_coefficients(
        LAW, speed * along, speed * across
    )

    assert (first, second) == pytest.approx(
        (0.3 * along, 0.3 * across), rel=1e-13, abs=0.0
    )
    # µ/|v| across the sliding direction, nothing along it
    slope = 0.3 / speed * np.array([across**2, -along * across, along**2])
    np.testing.assert_allclose([d11, d12, d22], slope, rtol=0.0, atol=1e-14 / speed)


def test_friction_at_rest_vanishes_with_the_slope_of_sticking() -> None:
    written = coulomb_coefficients(LAW, 0.0, 0.0)

    assert written == pytest.approx((0.0, 0.0, 300.0, 0.0, 300.0), rel=1e-15, abs=0.0)


def test_friction_is_continuous_at_the_threshold() -> None:
    below, above = (
        coulomb_coefficients(LAW, factor * 6e-4, factor * -8e-4)[:2]
        for factor in (1.0 - 1e-12, 1.0 + 1e-12)
    )

    assert below == pytest.approx(above, rel=1e-11, abs=0.0)
    assert above == pytest.approx((0.18, -0.24), rel=1e-11, abs=0.0)
