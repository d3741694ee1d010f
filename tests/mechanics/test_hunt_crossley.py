"""Hunt and Crossley's normal law against its closed form."""

import numpy as np
import pytest

from microslip_mechanics.contact.hunt_crossley import (
    HuntCrossley,
    normal_force,
    power,
    spring_force,
)

pytestmark = pytest.mark.kernels

EXPONENTS = [1.0, 1.5, 2.0, 2.7]
DAMPING_EXPONENTS = [0.5, 0.75, 1.0]


def law(
    exponent: float = 2.0, damping_exponent: float = 0.5, *, clamped: bool = False
) -> HuntCrossley:
    """Return a law with the stiffness and damping of a point of the soft face A."""
    return HuntCrossley(3.3333e8, exponent, 4.73e2, damping_exponent, clamped)


@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.5, 2.0, 2.7, 3.0])
@pytest.mark.parametrize("base", [1e-9, 0.3, 7.0])
def test_power_is_the_power(base: float, exponent: float) -> None:
    value = power(base, exponent)

    assert value == pytest.approx(base**exponent, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("damping_exponent", DAMPING_EXPONENTS)
@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("approach", [-1e-5, 0.0, 0.02])
def test_force_in_contact_is_spring_plus_damper(
    exponent: float, damping_exponent: float, clamped: bool, approach: float
) -> None:
    depth = 2e-5

    force, _, _ = normal_force(
        law(exponent, damping_exponent, clamped=clamped), depth, approach
    )

    spring = 3.3333e8 * depth**exponent
    damper = 4.73e2 * depth**damping_exponent * approach
    assert force == pytest.approx(spring + damper, rel=1e-14, abs=0.0)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("damping_exponent", DAMPING_EXPONENTS)
def test_tangents_in_contact_are_the_derivatives_of_the_powers(
    exponent: float, damping_exponent: float
) -> None:
    depth, approach = 2e-5, 0.02

    _, by_depth, by_approach = normal_force(
        law(exponent, damping_exponent), depth, approach
    )

    spring = exponent * 3.3333e8 * depth ** (exponent - 1.0)
    damper = damping_exponent * 4.73e2 * depth ** (damping_exponent - 1.0) * approach
    assert by_depth == pytest.approx(spring + damper, rel=1e-14, abs=0.0)
    assert by_approach == pytest.approx(
        4.73e2 * depth**damping_exponent, rel=1e-14, abs=0.0
    )


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("depth", [0.0, -1e-300, -1e-6, -1.0])
@pytest.mark.parametrize("approach", [-3.0, 0.0, 3.0])
def test_there_is_neither_force_nor_tangent_out_of_contact(
    depth: float, approach: float, clamped: bool
) -> None:
    written = normal_force(law(clamped=clamped), depth, approach)

    assert written == (0.0, 0.0, 0.0)
    assert spring_force(law(clamped=clamped), depth) == 0.0


def test_printed_law_pulls_at_fast_separation() -> None:
    depth, approach = 2e-5, -1.0

    force, _, _ = normal_force(law(), depth, approach)

    expected = 3.3333e8 * depth**2 - 4.73e2 * depth**0.5
    assert expected < 0.0
    assert force == pytest.approx(expected, rel=1e-14, abs=0.0)


@pytest.mark.parametrize("approach", [-0.07, -1.0, -100.0])
def test_clamped_law_neither_pulls_nor_resists_at_fast_separation(
    approach: float,
) -> None:
    written = normal_force(law(clamped=True), 2e-5, approach)

    assert written == (0.0, 0.0, 0.0)


def test_clamped_law_is_the_printed_one_until_the_force_vanishes() -> None:
    depth = 2e-5
    vanishing = -3.3333e8 * depth**2 / (4.73e2 * depth**0.5)

    printed, clamped = (
        [
            normal_force(law(clamped=clamped), depth, factor * vanishing)
            for factor in (0.999999, 1.000001)
        ]
        for clamped in (False, True)
    )

    assert clamped[0] == printed[0]
    assert clamped[1] == (0.0, 0.0, 0.0)
    assert printed[1][0] < 0.0 < printed[0][0]


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("clamped", [False, True])
def test_spring_force_is_the_force_at_rest(exponent: float, clamped: bool) -> None:
    depths = np.geomspace(1e-9, 1e-3, 13)
    resting = law(exponent, clamped=clamped)

    springs = [spring_force(resting, depth) for depth in depths]

    forces = [normal_force(resting, depth, 0.0)[0] for depth in depths]
    assert springs == forces
    np.testing.assert_allclose(springs, 3.3333e8 * depths**exponent, rtol=1e-14)
