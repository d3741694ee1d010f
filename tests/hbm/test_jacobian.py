"""The Jacobian of the contact forces against products taken sample by sample."""

import numpy as np
import pytest

from contact_tables import FRICTION_LAWS, contact_points, every_combination
from hbm.balance.jacobian import assemble, terms
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis, to_complex, to_real
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, tangent_pattern
from microslip_mechanics.contact.points import ContactPoints

pytestmark = pytest.mark.kernels

FREQUENCY, HARMONICS, RANK = 11.0, 3, 7
SIZE = 2 * HARMONICS + 1
EVERYTHING = terms(np.ones((SIZE, RANK), dtype=bool))


def waves(samples: int) -> tuple[Array, Array]:
    """Return mean, cosines and sines at the samples, and their rates."""
    phase = 2.0 * np.pi * np.arange(samples) / samples
    orders = np.arange(1, HARMONICS + 1)
    values, rates = (np.zeros((samples, SIZE)) for _ in range(2))
    values[:, 0] = 1.0
    values[:, 1::2] = np.cos(np.outer(phase, orders))
    values[:, 2::2] = np.sin(np.outer(phase, orders))
    rates[:, 1::2] = -FREQUENCY * orders * values[:, 2::2]
    rates[:, 2::2] = FREQUENCY * orders * values[:, 1::2]
    return values, rates


def tangents_at(
    points: ContactPoints, displacement: Array, velocity: Array
) -> tuple[Array, Array]:
    """Return both tangents of all points at all samples, (samples, 3 n, 3 n) each."""
    samples, rows = displacement.shape
    tangents = np.zeros((2, samples, rows, rows))
    for sample in range(samples):
        for point in range(rows // 3):
            place = slice(3 * point, 3 * point + 3)
            force, by_both = np.zeros(3), np.zeros((2, 3, 3))
            contact_force(
                points,
                point,
                displacement[sample, place],
                velocity[sample, place],
                force,
                by_both[0],
                by_both[1],
            )
            tangents[:, sample, place, place] = by_both
    return tangents[0], tangents[1]


def scattered(points: ContactPoints, tangents: Array) -> tuple[Array, Array]:
    """Return sampled tangents as matrices, (samples, 3 n, 3 n) each."""
    rows = 3 * len(points.load)
    matrices = np.zeros((2, tangents.shape[1], rows, rows))
    left = iter(tangents)
    for point in range(len(points.load)):
        for kind, pattern in enumerate(tangent_pattern(points, point)):
            for row, column in np.argwhere(pattern) + 3 * point:
                matrices[kind, :, row, column] = next(left)
    assert next(left, None) is None
    return matrices[0], matrices[1]


def random_motion(points: ContactPoints) -> tuple[Array, Array]:
    """Return a basis of seven coordinates and coefficients that touch and separate."""
    rng = np.random.default_rng(5)
    basis = np.linalg.qr(rng.standard_normal((3 * len(points.load), RANK)))[0]
    motion = rng.standard_normal((SIZE, RANK))
    motion[0] += basis[0::3].sum(axis=0)
    return basis, motion


@pytest.mark.parametrize("law", FRICTION_LAWS)
@pytest.mark.parametrize("samples", [14, 15, 40])
def test_jacobian_is_exactly_the_multiplication_by_the_tangents(
    law: str, samples: int
) -> None:
    points = every_combination(FRICTION_LAWS[law])
    basis, motion = random_motion(points)
    fourier, nothing = FourierBasis(HARMONICS, samples), np.zeros((4, RANK, RANK))
    contact = AlternatingFrequencyTime(points, basis, fourier)

    contact(motion, FREQUENCY)
    spectra = contact.tangents.spectra(2 * HARMONICS)
    jacobian = assemble(*spectra, nothing, nothing, FREQUENCY, EVERYTHING)

    values, rates = waves(samples)
    stiffness, damping = (
        basis.T @ tangent @ basis
        for tangent in scattered(points, contact.tangents.samples)
    )
    weights = values * np.r_[1.0, np.full(SIZE - 1, 2.0)] / samples
    expected = np.einsum("sa,sij,sb->aibj", weights, stiffness, values)
    expected += np.einsum("sa,sij,sb->aibj", weights, damping, rates)
    expected = expected.reshape(SIZE * RANK, -1)
    # Exact at the smallest number of samples too; rounding only, measured 1e-15.
    np.testing.assert_allclose(
        jacobian, expected, rtol=0.0, atol=1e-14 * np.abs(expected).max()
    )


@pytest.mark.parametrize("law", FRICTION_LAWS)
def test_without_events_the_tangents_are_those_of_the_law_at_each_sample(
    law: str,
) -> None:
    # Pressed so that all touch and none lets go, moved too slowly to slide.
    points = every_combination(FRICTION_LAWS[law])
    points = points._replace(
        threshold=np.full_like(points.threshold, 1e4),
        clamped=np.zeros_like(points.clamped),
    )
    rows = 3 * len(points.load)
    basis = np.eye(rows)
    motion = np.random.default_rng(5).standard_normal((SIZE, rows))
    motion[0] += 20.0
    samples = 20
    contact = AlternatingFrequencyTime(points, basis, FourierBasis(HARMONICS, samples))

    contact(motion, FREQUENCY)
    by_frequency = contact.by_frequency()

    values, rates = waves(samples)
    expected = tangents_at(points, values @ motion, rates @ motion)
    for found, exact in zip(
        scattered(points, contact.tangents.samples), expected, strict=True
    ):
        np.testing.assert_allclose(found, exact, rtol=1e-12, atol=1e-12)
    weights = values * np.r_[1.0, np.full(SIZE - 1, 2.0)] / samples
    change = np.einsum("sa,sij,sj->ai", weights, expected[1], rates @ motion)
    np.testing.assert_allclose(
        by_frequency,
        change / FREQUENCY,
        rtol=0.0,
        atol=1e-14 * np.abs(change).max(initial=1.0),
    )


def separated_tangents() -> AlternatingFrequencyTime:
    """Return contacts that, with no motion at all, exert no force."""
    fourier = FourierBasis(HARMONICS, 16)
    basis = np.linalg.qr(np.random.default_rng(2).standard_normal((9, RANK)))[0]
    return AlternatingFrequencyTime(contact_points(3), basis, fourier)


def test_without_contact_the_jacobian_multiplies_by_the_dynamic_stiffness() -> None:
    rng = np.random.default_rng(8)
    elastic, viscous = rng.standard_normal((2, HARMONICS + 1, RANK, RANK))
    viscous[0] = 0.0
    motion = rng.standard_normal((SIZE, RANK))
    still = separated_tangents()
    still(np.zeros((SIZE, RANK)), FREQUENCY)

    spectra = still.tangents.spectra(2 * HARMONICS)
    jacobian = assemble(*spectra, elastic, viscous, FREQUENCY, EVERYTHING)

    amplitudes = to_complex(motion)[..., None]
    expected = to_real(((elastic + 1j * viscous) @ amplitudes)[..., 0])
    found = (jacobian @ motion.ravel()).reshape(SIZE, RANK)
    np.testing.assert_allclose(found, expected, atol=1e-13)


def test_the_jacobian_of_some_terms_is_a_part_of_the_whole() -> None:
    points = every_combination(FRICTION_LAWS["gkf"])
    basis, motion = random_motion(points)
    rng = np.random.default_rng(9)
    elastic, viscous = rng.standard_normal((2, HARMONICS + 1, RANK, RANK))
    active = np.zeros((SIZE, RANK), dtype=bool)
    active[0] = rng.random(RANK) < 0.5
    active[1::2] = active[2::2] = rng.random((HARMONICS, RANK)) < 0.5
    contact = AlternatingFrequencyTime(points, basis, FourierBasis(HARMONICS, 20))

    contact(motion, FREQUENCY)
    spectra = contact.tangents.spectra(2 * HARMONICS)
    whole = assemble(*spectra, elastic, viscous, FREQUENCY, EVERYTHING)
    part = assemble(*spectra, elastic, viscous, FREQUENCY, terms(active))

    chosen = np.flatnonzero(active)
    np.testing.assert_array_equal(terms(active).unknowns, chosen)
    np.testing.assert_array_equal(part, whole[np.ix_(chosen, chosen)])
