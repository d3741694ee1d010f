"""The Jacobian of the contact forces against products taken sample by sample."""

import numpy as np
import pytest

from contact_tables import FRICTION_LAWS, contact_points, every_combination
from hbm.aft import AlternatingFrequencyTime
from hbm.fourier import FourierBasis, to_complex, to_real
from hbm.jacobian import assemble, terms
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import ContactPoints, contact_force

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

    seen = AlternatingFrequencyTime(points, basis, fourier)(motion, FREQUENCY)
    jacobian = assemble(seen.tangents, nothing, nothing, FREQUENCY, EVERYTHING)

    values, rates = waves(samples)
    stiffness, damping = (
        basis.T @ tangent @ basis
        for tangent in tangents_at(
            points, values @ motion @ basis.T, rates @ motion @ basis.T
        )
    )
    weights = values * np.r_[1.0, np.full(SIZE - 1, 2.0)] / samples
    expected = np.einsum("sa,sij,sb->aibj", weights, stiffness, values)
    expected += np.einsum("sa,sij,sb->aibj", weights, damping, rates)
    expected = expected.reshape(SIZE * RANK, -1)
    # Exact at the smallest number of samples too; rounding only, measured 1e-15.
    np.testing.assert_allclose(
        jacobian[:, :-1], expected, rtol=0.0, atol=1e-14 * np.abs(expected).max()
    )
    change = np.einsum("sa,sij,sj->ai", weights, damping, rates @ motion) / FREQUENCY
    np.testing.assert_allclose(
        seen.by_frequency,
        change,
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
    still = separated_tangents()(np.zeros((SIZE, RANK)), FREQUENCY)

    jacobian = assemble(still.tangents, elastic, viscous, FREQUENCY, EVERYTHING)

    amplitudes = to_complex(motion)[..., None]
    expected = to_real(((elastic + 1j * viscous) @ amplitudes)[..., 0])
    found = (jacobian[:, :-1] @ motion.ravel()).reshape(SIZE, RANK)
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

    tangents = contact(motion, FREQUENCY).tangents
    whole = assemble(tangents, elastic, viscous, FREQUENCY, EVERYTHING)
    part = assemble(tangents, elastic, viscous, FREQUENCY, terms(active))

    chosen = np.flatnonzero(active)
    np.testing.assert_array_equal(terms(active).unknowns, chosen)
    np.testing.assert_array_equal(part[:, :-1], whole[np.ix_(chosen, chosen)])
