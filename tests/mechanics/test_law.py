"""The force of a contact point: values, exact tangents, powers, energy."""

import numpy as np
import pytest

from contact_tables import (
    FRICTION_LAWS,
    REGIONS,
    Region,
    around_the_surface,
    around_the_threshold,
    around_zero_force,
    contact_points,
    every_combination,
    pulling,
    separated,
    sizes,
    slipping,
    sticking,
    written,
)
from microslip_mechanics.contact.hunt_crossley import spring_force
from microslip_mechanics.contact.law import contact_power
from microslip_mechanics.contact.normal import contact_energy, normal_law
from microslip_mechanics.contact.points import (
    BRISTLE,
    COULOMB,
    ELASTIC,
    FRICTIONLESS,
    GENERAL_KINETIC,
)

pytestmark = pytest.mark.kernels

SLIDING = [COULOMB, GENERAL_KINETIC]


@pytest.mark.parametrize("friction", FRICTION_LAWS.values(), ids=FRICTION_LAWS)
@pytest.mark.parametrize("region", REGIONS)
@pytest.mark.parametrize("seed", range(4))
def test_tangents_are_the_central_differences_of_the_force(
    region: Region, friction: int, seed: int
) -> None:
    points = every_combination(friction)
    motion = region(points, np.random.default_rng(seed))

    _, *exact = written(points, motion)

    spring, damper = sizes(points, motion)
    speed = np.hypot(motion[1][:, 1], motion[1][:, 2])
    rounding = 4e-15 * (
        spring + damper * np.abs(motion[1][:, 0]) + points.load + points.viscous * speed
    )
    for kind, tangent in enumerate(exact):
        for column in range(3):
            size = speed if kind == 1 and column else np.abs(motion[kind][:, column])
            step = 1e-6 * size
            ahead, behind = (np.array(motion) for _ in range(2))
            ahead[kind, :, column] += step
            behind[kind, :, column] -= step
            width = ahead[kind, :, column] - behind[kind, :, column]
            change = (
                written(points, (ahead[0], ahead[1]))[0]
                - written(points, (behind[0], behind[1]))[0]
            )
            difference = change / width[:, None]
            allowed = 1e-9 * np.abs(tangent[:, :, column]) + (rounding / width)[:, None]
            assert np.all(np.abs(difference - tangent[:, :, column]) <= allowed)


@pytest.mark.parametrize("friction", FRICTION_LAWS.values(), ids=FRICTION_LAWS)
def test_normal_force_is_hunt_and_crossleys_whatever_the_friction(
    friction: int,
) -> None:
    points = every_combination(friction)
    motion = around_zero_force(points, np.random.default_rng(1))

    force, *_ = written(points, motion)

    spring, damper = sizes(points, motion)
    printed = spring + damper * motion[1][:, 0]
    expected = np.where(points.clamped, np.maximum(printed, 0.0), printed)
    assert np.any(expected < 0.0)
    np.testing.assert_allclose(force[:, 0], expected, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("friction", FRICTION_LAWS.values(), ids=FRICTION_LAWS)
def test_nothing_acts_out_of_contact_with_a_computed_load(friction: int) -> None:
    points = every_combination(friction)
    points = points._replace(constant_load=np.zeros(len(points.load), dtype=bool))

    acting = written(points, separated(points, np.random.default_rng(2)))

    for array in acting:
        np.testing.assert_array_equal(array, 0.0)


def test_without_friction_the_tangential_force_vanishes() -> None:
    points = every_combination(FRICTIONLESS)

    force, *_ = written(points, slipping(points, np.random.default_rng(3)))

    np.testing.assert_array_equal(force[:, 1:], 0.0)


@pytest.mark.parametrize("friction", SLIDING)
def test_there_is_no_friction_while_the_computed_load_pulls(friction: int) -> None:
    points = every_combination(friction)
    pulled = ~points.clamped & ~points.constant_load
    motion = pulling(points, np.random.default_rng(4))

    force, by_displacement, by_velocity = written(points, motion)

    assert np.all(force[pulled, 0] < 0.0)
    for array in (force, by_displacement, by_velocity):
        np.testing.assert_array_equal(array[pulled, 1:], 0.0)


@pytest.mark.parametrize("friction", SLIDING)
@pytest.mark.parametrize("region", [slipping, separated, pulling])
def test_constant_load_rubs_whatever_the_normal_force(
    region: Region, friction: int
) -> None:
    points = every_combination(friction)
    points = points._replace(
        constant_load=np.ones(len(points.load), dtype=bool), viscous=0.0 * points.load
    )
    motion = region(points, np.random.default_rng(5))

    force, *_ = written(points, motion)

    coefficient = np.hypot(force[:, 1], force[:, 2]) / 1.7
    assert np.all(coefficient >= 0.3 * (1.0 - 1e-14))
    if friction == COULOMB:
        np.testing.assert_allclose(coefficient, 0.3, rtol=1e-14)


@pytest.mark.parametrize("region", [sticking, slipping, around_the_threshold])
def test_coulomb_friction_is_mu_times_load_times_the_regularised_direction(
    region: Region,
) -> None:
    points = every_combination(COULOMB)
    motion = region(points, np.random.default_rng(6))

    force, *_ = written(points, motion)

    speed = np.hypot(motion[1][:, 1], motion[1][:, 2])
    load = np.where(points.constant_load, 1.7, np.maximum(force[:, 0], 0.0))
    factor = 0.3 * load / np.maximum(speed, points.threshold)
    np.testing.assert_allclose(
        force[:, 1:], factor[:, None] * motion[1][:, 1:], rtol=1e-13, atol=1e-15
    )


@pytest.mark.parametrize("region", [sticking, slipping, around_the_threshold])
def test_general_kinetic_friction_is_stribecks_coefficient_times_load(
    region: Region,
) -> None:
    random = np.random.default_rng(15)
    count = 60
    dynamic, static, stribeck, exponent, threshold, viscous, load = random.uniform(
        0.2, 1.5, (7, count)
    )
    points = contact_points(
        count,
        friction=GENERAL_KINETIC,
        dynamic=dynamic,
        static=static,
        stribeck=stribeck,
        stribeck_exponent=exponent,
        viscous=viscous,
        threshold=threshold,
        constant_load=random.choice([False, True], count),
        load=load,
    )
    motion = region(points, random)

    force, *_ = written(points, motion)

    speed = np.hypot(motion[1][:, 1], motion[1][:, 2])
    fading = np.exp(-((speed / stribeck) ** exponent))
    size = dynamic + (static - dynamic) * fading
    normal = np.where(points.constant_load, load, np.maximum(force[:, 0], 0.0))
    drag = np.where(normal > 0.0, viscous, 0.0)
    factor = size * normal / np.maximum(speed, threshold) + drag
    np.testing.assert_allclose(
        force[:, 1:], factor[:, None] * motion[1][:, 1:], rtol=1e-13, atol=1e-15
    )


@pytest.mark.parametrize("friction", [ELASTIC, BRISTLE])
@pytest.mark.parametrize("region", REGIONS)
def test_what_remembers_is_dragged_only_while_it_is_pressed(
    region: Region, friction: int
) -> None:
    points = every_combination(friction)
    motion = region(points, np.random.default_rng(16))

    force, by_displacement, by_velocity = written(points, motion)

    drag = 0.04 * (points.constant_load | (force[:, 0] > 0.0))
    expected = drag[:, None] * motion[1][:, 1:]
    np.testing.assert_allclose(force[:, 1:], expected, rtol=1e-14, atol=0.0)
    np.testing.assert_array_equal(by_displacement[:, 1:], 0.0)
    np.testing.assert_array_equal(
        by_velocity[:, 1:, 1:], drag[:, None, None] * np.eye(2)
    )
    np.testing.assert_array_equal(by_velocity[:, 1:, 0], 0.0)


@pytest.mark.parametrize("region", [sticking, slipping])
def test_viscous_friction_is_added_to_general_kinetic_friction_alone(
    region: Region,
) -> None:
    random = np.random.default_rng(7)
    for friction, viscous in ((GENERAL_KINETIC, 0.04), (COULOMB, 0.0)):
        points = every_combination(friction)
        dry = points._replace(viscous=np.zeros_like(points.viscous))
        motion = region(points, random)

        force, *_ = written(points, motion)

        rubs = points.constant_load | (force[:, 0] > 0.0)
        drag = viscous * rubs[:, None] * motion[1][:, 1:]
        expected = written(dry, motion)[0][:, 1:] + drag
        np.testing.assert_allclose(force[:, 1:], expected, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("region", [sticking, slipping, around_the_surface])
def test_general_kinetic_friction_without_its_excess_is_coulombs(
    region: Region,
) -> None:
    coulomb = every_combination(COULOMB)
    kinetic = every_combination(GENERAL_KINETIC)._replace(
        static=coulomb.dynamic, viscous=np.zeros_like(coulomb.viscous)
    )
    motion = region(coulomb, np.random.default_rng(8))

    acting = written(kinetic, motion)

    for array, expected in zip(acting, written(coulomb, motion), strict=True):
        largest = np.abs(expected).max(axis=-1, keepdims=True)
        assert np.all(np.abs(array - expected) <= 1e-13 * largest)


@pytest.mark.parametrize("friction", SLIDING)
@pytest.mark.parametrize("region", REGIONS)
def test_friction_opposes_sliding_within_the_cone_of_the_static_coefficient(
    region: Region, friction: int
) -> None:
    points = every_combination(friction)
    points = points._replace(viscous=np.zeros_like(points.viscous))
    motion = region(points, np.random.default_rng(9))

    force, *_ = written(points, motion)

    speed = np.hypot(motion[1][:, 1], motion[1][:, 2])
    load = np.where(points.constant_load, 1.7, np.maximum(force[:, 0], 0.0))
    most = (0.6 if friction == GENERAL_KINETIC else 0.3) * load
    across = force[:, 1] * motion[1][:, 2] - force[:, 2] * motion[1][:, 1]
    assert np.all(np.hypot(force[:, 1], force[:, 2]) <= most * (1.0 + 1e-14))
    assert np.all(np.sum(force[:, 1:] * motion[1][:, 1:], axis=1) >= 0.0)
    assert np.all(np.abs(across) <= 1e-14 * most * speed)


@pytest.mark.parametrize("friction", SLIDING)
@pytest.mark.parametrize("region", [sticking, slipping, around_the_threshold])
def test_turning_both_tangents_turns_friction_and_its_tangents(
    region: Region, friction: int
) -> None:
    points = every_combination(friction)
    displacement, velocity = region(points, np.random.default_rng(10))
    cosine, sine = np.cos(0.7), np.sin(0.7)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])

    force, *tangents = written(points, (displacement @ turn.T, velocity @ turn.T))

    original, *expected = written(points, (displacement, velocity))
    largest = np.abs(original).max()
    np.testing.assert_allclose(force, original @ turn.T, rtol=0.0, atol=1e-14 * largest)
    for tangent, before in zip(tangents, expected, strict=True):
        scale = np.abs(before).max(axis=(1, 2), keepdims=True)
        error = np.abs(tangent - turn @ before @ turn.T)
        assert np.all(error <= 1e-14 * scale)


@pytest.mark.parametrize("friction", FRICTION_LAWS.values(), ids=FRICTION_LAWS)
@pytest.mark.parametrize("region", REGIONS)
def test_power_splits_into_friction_damping_and_what_the_spring_stores(
    region: Region, friction: int
) -> None:
    points = every_combination(friction)
    motion = region(points, np.random.default_rng(12))
    force, *_ = written(points, motion)

    powers = np.array(
        [
            contact_power(
                points, point, motion[0][point], motion[1][point], force[point]
            )
            for point in range(len(points.load))
        ]
    )

    rubbing = np.sum(force[:, 1:] * motion[1][:, 1:], axis=1)
    spring, damper = sizes(points, motion)
    stored = spring * motion[1][:, 0]
    given = np.sum(force * motion[1], axis=1)
    scale = np.abs(given) + np.abs(stored) + damper * motion[1][:, 0] ** 2
    np.testing.assert_allclose(powers[:, 0], rubbing, rtol=1e-14, atol=0.0)
    assert np.all(np.abs(powers.sum(axis=1) + stored - given) <= 1e-14 * scale)
    assert np.all(powers >= -1e-14 * scale[:, None])


def test_damping_takes_out_damper_force_times_approach() -> None:
    points = every_combination(FRICTIONLESS)
    printed = points._replace(clamped=np.zeros_like(points.clamped))
    motion = slipping(printed, np.random.default_rng(13))
    force, *_ = written(printed, motion)

    damping = [
        contact_power(printed, point, motion[0][point], motion[1][point], force[point])[
            1
        ]
        for point in range(len(printed.load))
    ]

    spring, damper = sizes(printed, motion)
    approach = motion[1][:, 0]
    rounding = 3e-15 * (spring + damper * np.abs(approach)) * np.abs(approach)
    assert np.all(np.abs(damping - damper * approach**2) <= rounding)


def test_energy_is_the_work_of_the_spring() -> None:
    points = every_combination(COULOMB)
    depths = 10.0 ** np.random.default_rng(14).uniform(-6.0, 0.5, len(points.load))

    for point, depth in enumerate(depths):
        energy = [contact_energy(points, point, factor * depth) for factor in
                  (1.0 - 1e-5, 1.0, 1.0 + 1e-5)]  # fmt: skip
        force = spring_force(normal_law(points, point), depth)

        slope = (energy[2] - energy[0]) / (2e-5 * depth)
        assert slope == pytest.approx(force, rel=1e-9, abs=0.0)
        power = points.exponent[point] + 1.0
        assert energy[1] == pytest.approx(
            3.0 * depth**power / power, rel=1e-14, abs=0.0
        )


@pytest.mark.parametrize("depth", [0.0, -1e-9, -2.0])
def test_nothing_is_stored_out_of_contact(depth: float) -> None:
    energy = contact_energy(contact_points(), 0, depth)

    assert energy == 0.0
