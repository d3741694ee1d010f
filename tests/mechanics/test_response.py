"""Periodic response and response curve against signals that are known."""

import dataclasses

import numpy as np
import pytest

from contact_tables import contact_points
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import MARGIN, PeriodicResponse
from microslip_mechanics.results.response_curve import PEAK_SAMPLES, response_curve
from microslip_mechanics.structures.structure import Structure

FREQUENCY = 850.0


def response(
    coefficients: Array, frequency: float = FREQUENCY, outcome: str = "converged"
) -> PeriodicResponse:
    return PeriodicResponse(
        frequency,
        coefficients,
        normal_smallest=np.array([0.001 * frequency]),
        normal_largest=np.array([0.002 * frequency]),
        friction_energy=1e-4 * frequency,
        damping_energy=1e-5 * frequency,
        residual=1e-9 * frequency,
        outcome=outcome,
        iterations=round(frequency / 100.0),
    )


def problem(probes: Array) -> Problem:
    """Return three degrees of freedom with one contact, watched by ``probes``."""
    matrix, names = np.eye(3), tuple(f"probe-{k}" for k in range(len(probes)))
    return Problem(
        Structure(matrix, matrix, matrix, ("x", "y", "z")),
        Interface(contact_points(), matrix, ("point",)),
        preload=np.zeros(3),
        drive=np.zeros(3),
        probes=Probes(names, probes),
    )


def test_displacement_is_the_fourier_series() -> None:
    coefficients = np.random.default_rng(5).normal(size=(7, 3))
    phase = np.linspace(0.0, 2.0 * np.pi, 50)

    displacement, _ = response(coefficients).at(phase)

    series = coefficients[0] + sum(
        np.outer(np.cos(order * phase), coefficients[2 * order - 1])
        + np.outer(np.sin(order * phase), coefficients[2 * order])
        for order in (1, 2, 3)
    )
    np.testing.assert_allclose(displacement, series, rtol=0.0, atol=1e-14)


def test_velocity_is_the_time_derivative_of_displacement() -> None:
    coefficients = np.random.default_rng(6).normal(size=(11, 4))
    phase = 2.0 * np.pi * np.arange(32) / 32

    displacement, velocity = response(coefficients).at(phase)

    orders = np.arange(17)[:, None]
    spectrum = 1j * orders * FREQUENCY * np.fft.rfft(displacement, axis=0)
    derivative = np.fft.irfft(spectrum, axis=0)
    np.testing.assert_allclose(velocity, derivative, rtol=0.0, atol=2e-13 * 5 * 850.0)


def test_response_repeats_after_one_turn_of_the_phase() -> None:
    coefficients = np.random.default_rng(7).normal(size=(9, 2))
    phase = np.linspace(0.0, 6.0, 20)

    now, later = (response(coefficients).at(p) for p in (phase, phase + 2.0 * np.pi))

    np.testing.assert_allclose(later[0], now[0], rtol=0.0, atol=2e-13)
    np.testing.assert_allclose(later[1], now[1], rtol=0.0, atol=2e-13 * 4 * FREQUENCY)


def test_curve_shows_first_harmonic_peak_and_velocity_of_each_probe() -> None:
    coefficients = np.zeros((7, 3))
    # 9 + 2 cos + ½ cos 2, from −1.5 to 2.5 about its mean
    coefficients[:, 0] = [9.0, 2.0, 0.0, 0.5, 0.0, 0.0, 0.0]
    coefficients[:, 1] = [-4.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.25]  # −4 + 3 sin + ¼ sin 3
    coefficients[:, 2] = [0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0]  # 4 sin
    watched = problem(np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [1.5, 0, 1]]))

    curve = response_curve(watched, [response(coefficients)], "complete")

    np.testing.assert_allclose(curve.amplitude, [[2.0, 2.0, 3.0, 5.0]], rtol=1e-14)
    np.testing.assert_allclose(curve.peak[:, :3], [[2.0, 2.0, 2.75]], rtol=1e-14)
    assert curve.velocity_peak[0, 2] == pytest.approx(
        3.75 * FREQUENCY, rel=1e-14, abs=0.0
    )


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_velocity_peak_counts_in_both_directions(sign: float) -> None:
    coefficients = np.zeros((5, 3))
    coefficients[:, 0] = sign * np.array([0.0, 0.0, 3.0, 0.0, 0.25])  # 3 sin + ¼ sin 2

    curve = response_curve(problem(np.eye(1, 3)), [response(coefficients)], "complete")

    expected = 3.5 * FREQUENCY
    assert curve.velocity_peak[0, 0] == pytest.approx(expected, rel=1e-14, abs=0.0)


@pytest.mark.parametrize("order", [1, 3, 200])
def test_peaks_between_samples_are_found_to_second_order(order: int) -> None:
    coefficients = np.zeros((2 * order + 1, 3))
    coefficients[-2:, 0] = [np.cos(1.0), np.sin(1.0)]  # cos(order ωt − 1)

    curve = response_curve(problem(np.eye(1, 3)), [response(coefficients)], "complete")

    # Of an order that many samples follow, the nearest is half a sample off.
    samples = max(PEAK_SAMPLES, 8 * len(coefficients))
    most = (np.pi * order / samples) ** 2 / 2.0
    rate = order * FREQUENCY
    assert 1.0 - most - 1e-13 <= curve.peak[0, 0] <= 1.0 + 1e-13
    assert 1.0 - most - 1e-13 <= curve.velocity_peak[0, 0] / rate <= 1.0 + 1e-13


def test_curve_keeps_the_order_and_the_numbers_of_its_points() -> None:
    frequencies = np.array([800.0, 900.0, 850.0])
    outcomes = ("converged", "the iteration limit was reached", "converged")
    points = [
        response(np.ones((3, 3)), frequency, outcome)
        for frequency, outcome in zip(frequencies, outcomes, strict=True)
    ]

    curve = response_curve(problem(np.eye(3)), points, "the step is too short")

    np.testing.assert_array_equal(curve.frequency, frequencies)
    np.testing.assert_array_equal(curve.normal_smallest[:, 0], 0.001 * frequencies)
    np.testing.assert_array_equal(curve.normal_largest[:, 0], 0.002 * frequencies)
    np.testing.assert_array_equal(curve.friction_energy, 1e-4 * frequencies)
    np.testing.assert_array_equal(curve.damping_energy, 1e-5 * frequencies)
    np.testing.assert_array_equal(curve.residual, 1e-9 * frequencies)
    np.testing.assert_array_equal(curve.iterations, [8.0, 9.0, 8.0])
    np.testing.assert_array_equal(curve.harmonics, [0.0, 0.0, 0.0])
    np.testing.assert_array_equal(curve.samples, [0.0, 0.0, 0.0])
    np.testing.assert_array_equal(curve.error, [np.inf, np.inf, np.inf])
    np.testing.assert_array_equal(curve.multiplier, [0.0, 0.0, 0.0])
    np.testing.assert_array_equal(curve.unstable, [-1.0, -1.0, -1.0])
    assert curve.event == ("", "", "")
    assert curve.probes == ("probe-0", "probe-1", "probe-2")
    assert curve.contacts == ("point",)
    assert curve.outcome == outcomes
    assert curve.ending == "the step is too short"


def test_curve_says_of_each_point_how_well_it_is_known_and_whether_it_is_stable() -> (
    None
):
    plain = response(np.ones((3, 3)))
    stable = np.array([0.9 + 0.1j, 0.9 - 0.1j, 0.2])
    points = [
        dataclasses.replace(plain, harmonics=7, samples=64, error=2e-3, event="peak"),
        dataclasses.replace(plain, multipliers=stable),
        dataclasses.replace(plain, multipliers=np.array([-1.5, 1.2, 0.3], complex)),
        dataclasses.replace(plain, multipliers=np.array([1.0 + 0.5 * MARGIN + 0j])),
    ]

    curve = response_curve(problem(np.eye(3)), points, "complete")

    assert (curve.harmonics[0], curve.samples[0], curve.error[0]) == (7.0, 64.0, 2e-3)
    np.testing.assert_array_equal(curve.unstable, [-1.0, 0.0, 2.0, 0.0])
    expected = [0.0, np.hypot(0.9, 0.1), 1.5, 1.0 + 0.5 * MARGIN]
    np.testing.assert_allclose(curve.multiplier, expected, rtol=1e-15)
    assert curve.event == ("peak", "", "", "")


def test_curve_without_points_has_no_rows() -> None:
    curve = response_curve(problem(np.eye(3)), [], "interrupted")

    assert curve.amplitude.shape == curve.peak.shape == (0, 3)
    assert curve.normal_smallest.shape == curve.normal_largest.shape == (0, 1)
    assert curve.frequency.shape == (0,)
