"""General kinetic friction against its closed form."""

import math

import numpy as np
import pytest

from microslip_mechanics.contact.coulomb import Coulomb, coulomb_coefficients
from microslip_mechanics.contact.gkf import GKF, gkf_coefficients

pytestmark = pytest.mark.kernels

LAW = GKF(dynamic=0.3, static=0.6, stribeck=0.5, exponent=1.0, threshold=1e-3)
SPEEDS = [1e-9, 3e-4, 9.99e-4, 1.001e-3, 0.02, 0.5, 3.0]
EXPONENTS = [0.7, 1.0, 2.0]


def coefficient(speed: float, exponent: float) -> float:
    """Return µd + (µs − µd) exp(−(|v|/V_str)^γ)."""
    return 0.3 + 0.3 * math.exp(-((speed / 0.5) ** exponent))


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_friction_is_stribecks_coefficient_along_the_regularised_direction(
    speed: float, exponent: float
) -> None:
    law = LAW._replace(exponent=exponent)

    first, second, *_ = gkf_coefficients(law, 0.6 * speed, -0.8 * speed)

    size = coefficient(speed, exponent) * min(speed / 1e-3, 1.0)
    assert (first, second) == pytest.approx(
        (0.6 * size, -0.8 * size), rel=1e-13, abs=0.0
    )


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_slope_along_and_across_sliding_is_that_of_the_size(
    speed: float, exponent: float
) -> None:
    law = LAW._replace(exponent=exponent)

    _, _, d11, d12, d22 = gkf_coefficients(law, 0.6 * speed, -0.8 * speed)

    size = coefficient(speed, exponent) * min(speed / 1e-3, 1.0)
    fall = (0.3 - coefficient(speed, exponent)) * exponent * (speed / 0.5) ** exponent
    rise = size if speed < 1e-3 else 0.0
    along = (rise + fall * min(speed / 1e-3, 1.0)) / speed
    across = size / speed
    slope = np.array([[d11, d12], [d12, d22]])
    expected = along * np.outer([0.6, -0.8], [0.6, -0.8]) + across * np.outer(
        [0.8, 0.6], [0.8, 0.6]
    )
    np.testing.assert_allclose(slope, expected, rtol=0.0, atol=1e-13 * across)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_friction_at_rest_vanishes_with_the_slope_of_sticking(exponent: float) -> None:
    law = LAW._replace(exponent=exponent)

    at_rest, nearly = (gkf_coefficients(law, 0.0, speed) for speed in (0.0, 1e-30))

    assert at_rest == pytest.approx((0.0, 0.0, 600.0, 0.0, 600.0), rel=1e-15, abs=0.0)
    assert nearly[2:] == pytest.approx(at_rest[2:], rel=1e-14, abs=0.0)


def test_friction_falls_from_static_to_dynamic_with_speed() -> None:
    law = LAW._replace(threshold=1e-9)
    speeds = np.geomspace(1e-9, 10.0, 60)

    sizes = np.array([gkf_coefficients(law, speed, 0.0)[0] for speed in speeds])

    assert sizes[0] == pytest.approx(0.6, rel=2e-9, abs=0.0)
    assert sizes[-1] == pytest.approx(0.3, rel=1e-8, abs=0.0)
    assert np.all(np.diff(sizes) < 0.0)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_at_stribecks_velocity_the_excess_has_fallen_to_one_part_in_e(
    exponent: float,
) -> None:
    law = LAW._replace(exponent=exponent)

    size, *_ = gkf_coefficients(law, 0.5, 0.0)

    assert size == pytest.approx(0.3 + 0.3 / math.e, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("speed", [0.0, *SPEEDS])
def test_equal_static_and_dynamic_coefficients_make_it_coulombs_law(
    speed: float,
) -> None:
    law = LAW._replace(static=0.3)

    written = gkf_coefficients(law, 0.6 * speed, -0.8 * speed)

    coulomb = coulomb_coefficients(Coulomb(0.3, 1e-3), 0.6 * speed, -0.8 * speed)
    scale = 0.3 / max(speed, 1e-3)
    np.testing.assert_allclose(written, coulomb, rtol=0.0, atol=1e-14 * max(scale, 1.0))
