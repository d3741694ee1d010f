"""Contact forces of a periodic motion against closed forms."""

import numpy as np
import pytest

from contact_tables import contact_points
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.contact_cycle import ContactCycle
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import (
    COULOMB,
    FRICTIONLESS,
    TWO_SIDED,
    ContactPoints,
)

pytestmark = pytest.mark.kernels

FREQUENCY, AMPLITUDE, LOAD, FRICTION = 11.0, 0.02, 1.7, 0.3
MEAN, COSINE, SINE = 0, 1, 2
"""places of the coefficients of the mean and of the first harmonic"""


def one_point(points: ContactPoints, *, samples: int = 256) -> AlternatingFrequencyTime:
    return AlternatingFrequencyTime(points, np.eye(3), FourierBasis(3, samples))


def moved(harmonics: int = 3, **coefficients: tuple[int, float]) -> Array:
    """Return coefficients (2H + 1, 3) from (place, value) of each direction."""
    motion = np.zeros((2 * harmonics + 1, 3))
    for axis, direction in enumerate(("normal", "first", "second")):
        if direction in coefficients:
            place, value = coefficients[direction]
            motion[place, axis] = value
    return motion


def sliding(samples: int, threshold: float) -> tuple[Array, ContactCycle]:
    """Return force coefficients and energies of X sin θ at constant normal load."""
    points = contact_points(
        constant_load=True, load=LOAD, dynamic=FRICTION, threshold=threshold
    )
    contact = one_point(points, samples=samples)
    motion = moved(first=(SINE, AMPLITUDE))
    return contact(motion, FREQUENCY), contact.cycle(motion, FREQUENCY)


@pytest.mark.parametrize("order", [1, 3])
def test_sliding_friction_has_the_harmonics_of_a_square_wave(order: int) -> None:
    samples, threshold = 1022, 1e-9

    force, _ = sliding(samples, threshold)

    # The velocity X ω cos θ makes a square wave of cosines: 4 µN / π, −4 µN / 3π, …
    # Samples see it with an error of (k π / samples)² / 3 at order k: below 3e-5.
    expected = FRICTION * LOAD * 4.0 / (np.pi * order) * (1.0 if order == 1 else -1.0)
    assert force[2 * order - 1, 1] == pytest.approx(expected, rel=3e-5)
    assert force[2 * order, 1] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("friction", "smooth"), [(FRICTIONLESS, True), (COULOMB, False)]
)
def test_what_a_law_has_no_transitions_for_is_left_out_and_does_not_matter(
    friction: int, smooth: bool
) -> None:
    points = contact_points(
        normal=TWO_SIDED, friction=friction, damping=0.0, exponent=3.0
    )
    motion = moved(normal=(COSINE, AMPLITUDE), first=(SINE, AMPLITUDE))

    every, pruned = (
        AlternatingFrequencyTime(points, np.eye(3), FourierBasis(3, 64), pruned=pruned)
        for pruned in (False, True)
    )

    assert (every.smooth, pruned.smooth) == (False, smooth)
    np.testing.assert_array_equal(
        pruned(motion, FREQUENCY), every(motion, FREQUENCY), strict=True
    )
    assert pruned.cycle(motion, FREQUENCY) == every.cycle(motion, FREQUENCY)


def test_impulses_beyond_an_order_are_those_of_the_square_wave() -> None:
    points = contact_points(
        constant_load=True, load=LOAD, dynamic=FRICTION, threshold=1e-9
    )
    contact = one_point(points, samples=1022)
    contact(moved(first=(SINE, AMPLITUDE)), FREQUENCY)

    # of the orders 5 and 7, over their numbers
    expected = FRICTION * LOAD * 4.0 / np.pi * np.hypot(1.0 / 25.0, 1.0 / 49.0)
    assert contact.impulses(3, 7) == pytest.approx(expected, rel=1e-3)


def test_sliding_friction_has_neither_mean_nor_even_harmonics() -> None:
    force, _ = sliding(1022, 1e-9)

    np.testing.assert_allclose(force[[0, 3, 4], 1], 0.0, atol=1e-12)
    np.testing.assert_allclose(force[:, [0, 2]], 0.0, atol=1e-12)


def test_sliding_friction_takes_four_times_force_times_amplitude_per_cycle() -> None:
    _, cycle = sliding(1022, 1e-9)

    # Samples of |cos θ| miss its mean by (π / samples)² / 3: 3e-6.
    expected = 4.0 * FRICTION * LOAD * AMPLITUDE
    assert cycle.friction == pytest.approx(expected, rel=1e-5)


def test_friction_below_its_threshold_velocity_is_a_viscous_damper() -> None:
    threshold = 2.0 * AMPLITUDE * FREQUENCY
    damper = FRICTION * LOAD / threshold

    force, cycle = sliding(64, threshold)

    assert force[COSINE, 1] == pytest.approx(damper * FREQUENCY * AMPLITUDE)
    energy = np.pi * damper * FREQUENCY * AMPLITUDE**2
    assert cycle.friction == pytest.approx(energy)


def test_a_contact_that_opens_half_of_the_time_rectifies_the_motion() -> None:
    stiffness, samples = 50.0, 1022
    points = contact_points(friction=0, stiffness=stiffness, exponent=1.0, damping=0.0)
    contact, motion = one_point(points, samples=samples), moved(normal=(COSINE, 1.0))

    force, cycle = (
        contact(motion, FREQUENCY)[:, 0],
        contact.cycle(motion, FREQUENCY),
    )

    # K max(cos θ, 0) = K (1/π + cos θ / 2 + 2 cos 2θ / 3π − …); at a kink samples err
    # by (π / samples)² / 3 of the mean, k² times as much at order k.
    expected = stiffness * np.array([1.0 / np.pi, 0.5, 0.0, 2.0 / (3.0 * np.pi), 0.0])
    np.testing.assert_allclose(force[:5], expected, atol=5e-5 * stiffness)
    assert cycle.normal_smallest == pytest.approx(0.0)
    assert cycle.normal_largest == pytest.approx(stiffness)


def test_separated_faces_exchange_no_force() -> None:
    contact = one_point(contact_points(threshold=1e-3))
    motion = moved(normal=(MEAN, -1.0), first=(SINE, 1.0))

    force = contact(motion, FREQUENCY)
    by_frequency = contact.by_frequency()
    cycle = contact.cycle(motion, FREQUENCY)

    for each in (
        force,
        by_frequency,
        contact.tangents.samples,
        *contact.tangents.spectra(3),
    ):
        assert not each.any()
    assert cycle.friction == cycle.normal_damping == 0.0
    assert cycle.normal_largest == 0.0


def test_linear_normal_damping_takes_the_energy_of_a_dashpot() -> None:
    damping = 0.8
    points = contact_points(friction=0, damping=damping, damping_exponent=0.0)
    motion = moved(normal=(COSINE, AMPLITUDE))
    motion[MEAN, 0] = 2.0 * AMPLITUDE

    cycle = one_point(points, samples=32).cycle(motion, FREQUENCY)

    assert cycle.normal_damping == pytest.approx(
        damping * np.pi * FREQUENCY * AMPLITUDE**2
    )
    assert cycle.friction == 0.0


def test_normal_forces_range_from_the_smallest_to_the_largest_penetration() -> None:
    points = contact_points(friction=0, stiffness=3.0, damping=0.0)
    motion = moved(normal=(COSINE, AMPLITUDE))
    motion[MEAN, 0] = 2.0 * AMPLITUDE

    cycle = one_point(points, samples=32).cycle(motion, FREQUENCY)

    assert cycle.normal_smallest == pytest.approx(3.0 * AMPLITUDE**2)
    assert cycle.normal_largest == pytest.approx(3.0 * (3.0 * AMPLITUDE) ** 2)


def test_each_point_has_its_own_forces_and_energies_add_up() -> None:
    fourier, rng = FourierBasis(2, 32), np.random.default_rng(4)
    stiffness = [3.0, 5.0]
    motion = rng.standard_normal((5, 6))

    both = AlternatingFrequencyTime(
        contact_points(2, stiffness=stiffness), np.eye(6), fourier
    )
    alone = [
        AlternatingFrequencyTime(contact_points(stiffness=each), np.eye(3), fourier)
        for each in stiffness
    ]

    cycle = both.cycle(motion, FREQUENCY)
    cycles = [
        each.cycle(motion[:, 3 * place : 3 * place + 3], FREQUENCY)
        for place, each in enumerate(alone)
    ]
    for place, each in enumerate(cycles):
        assert cycle.normal_smallest[place] == each.normal_smallest[0]
        assert cycle.normal_largest[place] == each.normal_largest[0]
    assert cycle.friction == pytest.approx(sum(each.friction for each in cycles))
    assert cycle.normal_damping == pytest.approx(
        sum(each.normal_damping for each in cycles)
    )


def test_force_on_the_coordinates_is_that_of_the_points_brought_back() -> None:
    points = contact_points(2, stiffness=[3.0, 5.0])
    rng = np.random.default_rng(6)
    fourier = FourierBasis(2, 32)
    basis = np.linalg.qr(rng.standard_normal((6, 4)))[0]
    motion = rng.standard_normal((5, 4))

    force = AlternatingFrequencyTime(points, basis, fourier)(motion, FREQUENCY)

    at_points = AlternatingFrequencyTime(points, np.eye(6), fourier)
    expected = at_points(motion @ basis.T, FREQUENCY) @ basis
    np.testing.assert_allclose(force, expected, atol=1e-14)


@pytest.mark.parametrize("rank", [1, 2, 4], ids="{} coordinates".format)
def test_tangents_of_the_coordinates_are_those_of_the_points_brought_back(
    rank: int,
) -> None:
    # with one and two coordinates theirs are fewer than those of the points
    points = contact_points(2, stiffness=[3.0, 5.0])
    rng = np.random.default_rng(8)
    fourier = FourierBasis(2, 32)
    basis = np.linalg.qr(rng.standard_normal((6, rank)))[0]
    motion = rng.standard_normal((5, rank))
    contact = AlternatingFrequencyTime(points, basis, fourier)
    at_points = AlternatingFrequencyTime(points, np.eye(6), fourier)

    contact(motion, FREQUENCY)
    at_points(motion @ basis.T, FREQUENCY)

    pairs = zip(contact.tangents.spectra(4), at_points.tangents.spectra(4), strict=True)
    for found, whole in pairs:
        expected = np.einsum("ia,ijk,jb->abk", basis, whole, basis)
        assert np.abs(expected).max() > 0.0
        np.testing.assert_allclose(found, expected, atol=1e-13)


def test_values_that_were_zero_have_their_tangents_when_they_are_not() -> None:
    still = contact_points(friction=0, stiffness=3.0, damping=0.0)
    damped = still._replace(damping=np.array([0.7]))
    motion = moved(normal=(COSINE, AMPLITUDE))
    motion[MEAN, 0] = 2.0 * AMPLITUDE

    made = one_point(still).with_points(damped, np.zeros(3))
    anew = one_point(damped)

    for contact in (made, anew):
        contact(motion, FREQUENCY)
    for found, expected in zip(
        made.tangents.spectra(3), anew.tangents.spectra(3), strict=True
    ):
        assert np.abs(expected).max() > 0.0
        np.testing.assert_allclose(found, expected, atol=1e-14)
