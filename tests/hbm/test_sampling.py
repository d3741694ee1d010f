"""Forces at samples, transitions resolved: coefficients against closed forms."""

from collections.abc import Callable

import numpy as np
import pytest

from contact_tables import contact_points
from convergence import observed_order
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis, derivative, to_complex
from hbm.forces.refinement import (
    GAUSS_PLACES,
    GAUSS_WEIGHTS,
    GRADED_PLACES,
    GRADED_WEIGHTS,
)
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import FRICTIONLESS, ContactPoints
from sliding import (
    FREQUENCY,
    FRICTION,
    HARMONICS,
    LOAD,
    SAMPLES,
    SPEED,
    TURN,
    coefficients,
    motion,
    sliding_point,
    turned,
)

pytestmark = pytest.mark.kernels

PHASES = np.linspace(0.0, TURN / SAMPLES, 17)
"""of the motion: its events lie anywhere between two samples"""
RATIOS = [1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9]
"""of threshold and largest speed"""


@pytest.mark.parametrize("power", range(6))
def test_the_rule_between_events_is_exact_up_to_the_fifth_power(power: int) -> None:
    found = GAUSS_WEIGHTS @ GAUSS_PLACES**power

    assert found == pytest.approx(1.0 / (power + 1.0), rel=1e-14)


@pytest.mark.parametrize("power", range(8))
def test_the_graded_rule_is_exact_up_to_the_seventh_power(power: int) -> None:
    found = GRADED_WEIGHTS @ GRADED_PLACES**power

    assert found == pytest.approx(1.0 / (power + 1.0), rel=1e-14)


def regularised_square_wave(ratio: float) -> ComplexArray:
    """Return the amplitudes of clip(sin θ / ratio, −1, 1), shape (H + 1,)."""
    angle, amplitudes = np.arcsin(ratio), np.zeros(HARMONICS + 1, complex)
    for order in range(1, HARMONICS + 1, 2):
        slides = np.cos(order * angle) / order
        if order == 1:
            sticks = (angle - np.sin(angle) * np.cos(angle)) / (2.0 * ratio)
        else:
            less, more = order - 1, order + 1
            sticks = (np.sin(less * angle) / less - np.sin(more * angle) / more) / (
                2.0 * ratio
            )
        amplitudes[order] = -1j * 4.0 / np.pi * (sticks + slides)
    return amplitudes


def plain(points: ContactPoints, moved: Array, samples: int) -> ComplexArray:
    """Return what equidistant samples alone make of the force, (H + 1, 3)."""
    phase = TURN * np.arange(samples) / samples
    turning = np.exp(1j * np.outer(phase, np.arange(HARMONICS + 1)))
    displacement = (turning @ to_complex(moved)).real
    velocity = FREQUENCY * (turning @ to_complex(derivative(moved))).real
    force, unused = np.zeros((samples, 3)), np.zeros((2, 3, 3))
    for place in range(samples):
        contact_force(
            points,
            0,
            displacement[place],
            velocity[place],
            force[place],
            unused[0],
            unused[1],
        )
    amplitudes = 2.0 * turning.conj().T @ force / samples
    amplitudes[0] /= 2.0
    return np.asarray(amplitudes)


def friction_errors(
    ratio: float,
    samples: int = SAMPLES,
    method: Callable[..., ComplexArray] = coefficients,
) -> Array:
    """Return the largest errors of a sliding point's amplitudes over µN, (H + 1,)."""
    points = sliding_point(ratio * SPEED)
    errors = [
        np.abs(
            method(points, motion(phase), samples)[:, 1] / (FRICTION * LOAD)
            - turned(regularised_square_wave(ratio), phase)
        )
        for phase in PHASES * SAMPLES / samples
    ]
    largest: Array = np.max(errors, axis=0)
    return largest


@pytest.mark.parametrize("ratio", RATIOS)
def test_sliding_friction_is_resolved_however_narrow_its_transition(
    ratio: float,
) -> None:
    errors = friction_errors(ratio)

    # Sharing a cell out to its ends errs by (k h)² / 12 of 4 / π k, and as much in the
    # cell of the turn: measured 1.03e-3 k.
    orders = np.arange(1, HARMONICS + 1)
    assert (errors[1:] < 1.1e-3 * orders).all()
    assert errors[0] < 1e-6


def test_the_error_of_narrow_transitions_does_not_depend_on_the_threshold() -> None:
    errors = [friction_errors(ratio).max() for ratio in RATIOS[2:]]

    assert max(errors) < 1.01 * min(errors)


@pytest.mark.parametrize("ratio", RATIOS[2:])
def test_samples_alone_err_many_times_as_much(ratio: float) -> None:
    gain = friction_errors(ratio, method=plain) / friction_errors(ratio)

    # Measured 53 at order 1 and 11 at order 5.
    assert gain[1] > 40.0
    assert gain[5] > 8.0


@pytest.mark.parametrize("ratio", [1e-1, 1e-3, 1e-9])
def test_located_events_err_with_second_order(ratio: float) -> None:
    samples = [32, 64, 128, 256]

    errors = [friction_errors(ratio, each).max() for each in samples]

    found = observed_order([1.0 / each for each in samples], errors)
    assert found == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("mean", [0.003, -0.003, 0.012])
def test_the_mean_tangent_is_the_share_of_the_period_in_contact(mean: float) -> None:
    across, stiffness = 0.02, 7.0
    points = contact_points(
        friction=FRICTIONLESS, exponent=1.0, damping=0.0, stiffness=stiffness
    )
    contact = AlternatingFrequencyTime(
        points, np.eye(3), FourierBasis(HARMONICS, SAMPLES)
    )

    shares = []
    for phase in PHASES:
        contact(motion(phase, mean=mean, across=across), FREQUENCY)
        shares.append(contact.tangents.means()[0][0, 0] / stiffness)

    # A place between two samples is off by an eighth of the cell's curvature: 2e-4.
    exact = np.arccos(-mean / across) / np.pi
    np.testing.assert_allclose(shares, exact, rtol=0.0, atol=4e-4)


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_mean_damping_is_the_share_of_the_period_that_sticks(ratio: float) -> None:
    points = sliding_point(ratio * SPEED)
    contact = AlternatingFrequencyTime(
        points, np.eye(3), FourierBasis(HARMONICS, SAMPLES)
    )

    shares = []
    for phase in PHASES:
        contact(motion(phase), FREQUENCY)
        damper = FRICTION * LOAD / (ratio * SPEED)
        shares.append(contact.tangents.means()[1][1, 1] / damper)

    # The velocity is linear within a cell: its slope is off by (h / 2)² / 6, 4e-4.
    exact = 2.0 * np.arcsin(ratio) / np.pi
    np.testing.assert_allclose(shares, exact, rtol=2e-3)
