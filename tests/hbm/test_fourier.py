"""Coefficients and samples of one period."""

import numpy as np
import pytest

from hbm.forces.fourier import FourierBasis, Transform, derivative, to_complex, to_real
from microslip_mechanics.arrays import Array

HARMONICS, SIGNALS = 5, 3
ROUNDING = 1e-14
"""of sums over some ten coefficients of order one; measured 1e-15"""


@pytest.fixture(params=[False, True], ids=["FFTW", "matrix"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have transforms of all sizes here made in one way, and in the other."""
    monkeypatch.setattr("hbm.forces.fourier.multiplies", lambda *_: request.param)


def random_coefficients() -> Array:
    shape = (2 * HARMONICS + 1, SIGNALS)
    return np.random.default_rng(7).standard_normal(shape)


def series(coefficients: Array, samples: int) -> Array:
    """Return a₀ + Σ aₖ cos kθ + bₖ sin kθ at the samples, (signals, samples)."""
    phase = 2.0 * np.pi * np.arange(samples) / samples
    total = np.repeat(coefficients[0][:, None], samples, axis=1)
    for order in range(1, coefficients.shape[0] // 2 + 1):
        total += np.outer(coefficients[2 * order - 1], np.cos(order * phase))
        total += np.outer(coefficients[2 * order], np.sin(order * phase))
    return total


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("samples", [22, 23, 64])
def test_synthesis_is_the_fourier_series_at_the_samples(samples: int) -> None:
    coefficients = random_coefficients()

    signal = Transform(SIGNALS, samples).synthesis(coefficients)

    np.testing.assert_allclose(signal, series(coefficients, samples), atol=ROUNDING)


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("samples", [22, 23, 64])
def test_analysis_undoes_synthesis(samples: int) -> None:
    coefficients = random_coefficients()
    transform = Transform(SIGNALS, samples)

    transform.synthesis(coefficients)
    again = transform.analysis(HARMONICS)

    np.testing.assert_allclose(again, coefficients, atol=ROUNDING)


@pytest.mark.usefixtures("way")
def test_analysis_leaves_out_what_lies_above_its_harmonics() -> None:
    coefficients = random_coefficients()
    transform = Transform(SIGNALS, 32)

    transform.samples[:] = series(coefficients, 32)
    kept = transform.analysis(2)

    np.testing.assert_allclose(kept, coefficients[:5], atol=ROUNDING)


@pytest.mark.usefixtures("way")
def test_synthesis_forgets_the_signal_before() -> None:
    transform = Transform(SIGNALS, 32)
    transform.synthesis(random_coefficients())

    signal = transform.synthesis(np.ones((1, SIGNALS)))

    np.testing.assert_allclose(signal, np.ones((SIGNALS, 32)), atol=ROUNDING)


def test_derivative_is_the_slope_of_the_series() -> None:
    coefficients, samples = random_coefficients(), 64
    orders = np.fft.fftfreq(samples, 1.0 / samples)

    slopes = series(derivative(coefficients), samples)

    spectrum = 1j * orders * np.fft.fft(series(coefficients, samples))
    np.testing.assert_allclose(slopes, np.fft.ifft(spectrum).real, atol=1e-12)


@pytest.mark.parametrize("shape", [(11,), (11, 3), (11, 3, 2)])
def test_second_derivative_multiplies_by_minus_the_squared_order(
    shape: tuple[int, ...],
) -> None:
    coefficients = np.random.default_rng(1).standard_normal(shape)
    orders = np.array([0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5])

    twice = derivative(derivative(coefficients))

    np.testing.assert_allclose(twice.T, -(orders**2) * coefficients.T, rtol=ROUNDING)


def test_real_and_complex_coefficients_turn_into_each_other() -> None:
    coefficients = random_coefficients()

    np.testing.assert_array_equal(to_real(to_complex(coefficients)), coefficients)


def test_complex_amplitudes_give_the_signal_as_a_real_part() -> None:
    coefficients, samples = random_coefficients(), 32
    phase = 2.0 * np.pi * np.arange(samples) / samples
    turning = np.exp(1j * np.outer(np.arange(HARMONICS + 1), phase))

    signal = (to_complex(coefficients).T @ turning).real

    np.testing.assert_allclose(signal, series(coefficients, samples), atol=ROUNDING)


def test_a_basis_has_a_mean_and_two_coefficients_per_harmonic() -> None:
    assert FourierBasis(5, 22).coefficients == 11


@pytest.mark.parametrize("harmonics", [1, 3, 8])
def test_twice_the_resolution_of_the_least_samples_has_enough(harmonics: int) -> None:
    doubled = FourierBasis(harmonics, 4 * harmonics + 2).doubled

    assert doubled.harmonics == 2 * harmonics + 1
    assert doubled.samples == 4 * doubled.harmonics + 4


def test_a_basis_without_harmonics_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^0 harmonics: take at least 1$"):
        FourierBasis(0, 64)


def test_a_basis_with_too_few_samples_says_how_many_it_needs() -> None:
    text = r"^33 samples per period cannot carry 8 harmonics: take at least 34$"
    with pytest.raises(ValueError, match=text):
        FourierBasis(8, 33)
