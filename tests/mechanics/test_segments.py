"""Segments of load factors: closed forms, edges, the search for a segment."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.loads.segments import (
    Segments,
    clock,
    factors_over,
    load_factors,
    segment_of,
)

THREE = Segments(
    begin=np.array([0.0, 1.0, 3.0]),
    preload=np.array([[0.0, 0.5], [0.5, 0.0], [0.5, -0.1]]),
    offset=np.array([[0.0, 0.0], [2.0, -1.0], [0.0, 0.0]]),
    amplitude=np.array([[1.0, 2.0], [0.0, 0.0], [3.0, 0.0]]),
    sine=np.array([[0.3, 7.0, 0.0, 1.5], [9.0, 4.0, 0.0, 0.0], [0.1, 5.0, -0.2, 0.0]]),
)


def as_published(sweep: SweptSine, time: Array) -> Array:
    """Return the factors of a swept sine by theory, eq. 20, in one formula."""
    elapsed = np.clip(time, sweep.start, sweep.end) - sweep.start
    phase = 2.0 * np.pi * sweep.lowest * np.expm1(sweep.rate * elapsed) / sweep.rate
    sweeps = (time >= sweep.start) & (time <= sweep.end)
    ramp = np.clip(time / sweep.ramp, 0.0, 1.0) if sweep.ramp else np.ones_like(time)
    return np.stack([ramp, np.where(sweeps, np.sin(phase), 0.0)], axis=1)


@pytest.mark.parametrize(
    "times", [(1.0, 2.0, 8.0, 10.0), (0.0, 0.0, 6.0, 6.0), (2.0, 2.0, 3.0, 3.5)]
)
@pytest.mark.parametrize("ends", [(125.0, 145.0), (145.0, 125.0)])
def test_swept_sine_is_that_of_the_theory(
    times: tuple[float, float, float, float], ends: tuple[float, float]
) -> None:
    sweep = SweptSine(*times, *ends)
    time = np.random.default_rng(1).uniform(-1.0, 11.0, 5000)
    time = np.concatenate([time, times, [0.0]])

    factors = factors_over(sweep.segments(), time)

    # the phase is some 5000 rad: a rounding of it is 1e-12
    np.testing.assert_allclose(factors, as_published(sweep, time), rtol=0.0, atol=4e-12)


def test_each_segment_is_its_closed_form() -> None:
    first, third = np.linspace(0.0, 1.0, 50), np.linspace(3.01, 5.0, 50)
    second = np.linspace(1.01, 3.0, 50)

    rows = factors_over(THREE, np.concatenate([first, second, third])).reshape(3, 50, 2)

    np.testing.assert_allclose(rows[0, :, 0], 0.5 * first)
    expected = (1.0 + 2.0 * first) * np.sin(0.3 + 7.0 * first + 0.75 * first**2)
    np.testing.assert_allclose(rows[0, :, 1], expected, atol=1e-14)
    np.testing.assert_allclose(rows[1, :, 1], 2.0 - (second - 1.0), atol=1e-14)
    phase = 0.1 + 5.0 * (1.0 - np.exp(-0.2 * (third - 3.0))) / 0.2
    np.testing.assert_allclose(rows[2, :, 1], 3.0 * np.sin(phase), atol=1e-14)
    np.testing.assert_allclose(rows[2, :, 0], 0.5 - 0.1 * (third - 3.0))


def test_clock_gives_the_derivative_of_the_phase() -> None:
    time = np.array([0.5, 2.0, 4.0])
    late, early = clock(THREE, time + 1e-6), clock(THREE, time - 1e-6)

    slope = (late[:, 2] - early[:, 2]) / 2e-6

    shown = clock(THREE, time)
    np.testing.assert_allclose(shown[:, 0], slope, rtol=1e-8)
    np.testing.assert_allclose(shown[:, 1], [2.0, 0.0, 3.0])


@pytest.mark.parametrize("hint", [-3, 0, 1, 2, 7])
@pytest.mark.parametrize(
    ("time", "place"), [(-1.0, 0), (0.0, 0), (1.0, 0), (1.1, 1), (3.0, 1), (9.0, 2)]
)
def test_segment_is_found_from_any_hint(hint: int, time: float, place: int) -> None:
    factors = np.empty(2)

    assert segment_of(THREE, time, hint) == place
    assert load_factors(THREE, time, hint, factors) == place
    np.testing.assert_array_equal(factors, factors_over(THREE, np.array([time]))[0])
