"""Load histories: the phase against its frequency, the edges, the texts."""

import re
from dataclasses import replace

import numpy as np
import pytest

from microslip_mechanics.loads.excitation import Dwell, SweptSine
from microslip_mechanics.loads.segments import factors_over

SWEEP = SweptSine(
    ramp=1.0, start=2.0, end=8.0, duration=10.0, lowest=125.0, highest=145.0
)
DOWN = replace(SWEEP, lowest=145.0, highest=125.0)


@pytest.mark.parametrize("sweep", [SWEEP, DOWN])
def test_phase_grows_at_the_instantaneous_frequency(sweep: SweptSine) -> None:
    time = np.random.default_rng(3).uniform(2.001, 7.999, 500)
    early, late = time - 2e-7, time + 2e-7

    drive = factors_over(sweep.segments(), time)[:, 1]
    change = (
        factors_over(sweep.segments(), late)[:, 1]
        - factors_over(sweep.segments(), early)[:, 1]
    )

    # sin² + cos² = 1 for sin φ and its slope over φ̇, if φ̇ is what frequency says
    rate = 2.0 * np.pi * sweep.frequency(time)
    circle = np.hypot(drive, change / (late - early) / rate)
    np.testing.assert_allclose(circle, 1.0, rtol=0.0, atol=5e-8)


@pytest.mark.parametrize(("sweep", "turn"), [(SWEEP, 1.0), (DOWN, -1.0)])
def test_sweep_turns_as_often_as_its_closed_form_says(
    sweep: SweptSine, turn: float
) -> None:
    rate = np.log(145.0 / 125.0) / 6.0

    last = factors_over(sweep.segments(), np.array([8.0]))[0, 1]

    # φ(end) = 2π (f₁ − f₀)/k, of 5082 rad: rounding leaves some 1e-12 of it
    assert sweep.rate == pytest.approx(turn * rate, rel=1e-14, abs=0.0)
    assert last == pytest.approx(np.sin(2.0 * np.pi * 20.0 / rate), abs=3e-11)


def test_sweep_begins_at_rest_and_upward() -> None:
    first, second = factors_over(SWEEP.segments(), np.array([2.0, 2.0 + 1e-6]))[:, 1]

    assert first == 0.0
    assert second == pytest.approx(2.0 * np.pi * 125.0 * 1e-6, rel=1e-6, abs=0.0)


def test_frequency_runs_from_125_to_145_hz_by_equal_ratios_and_is_held_outside() -> (
    None
):
    time = np.array([0.0, 2.0, 3.5, 5.0, 6.5, 8.0, 9.0])

    frequency = SWEEP.frequency(time)

    ratio = (145.0 / 125.0) ** 0.25
    expected = 125.0 * ratio ** np.array([0, 0, 1, 2, 3, 4, 4])
    np.testing.assert_allclose(frequency, expected, rtol=1e-14)


def test_drive_is_zero_outside_the_sweep() -> None:
    outside = np.array([-1.0, 0.0, 1.0, 1.999999, 8.000001, 9.0, 10.0])

    drive = factors_over(SWEEP.segments(), outside)[:, 1]

    np.testing.assert_array_equal(drive, 0.0)


def test_preload_grows_linearly_and_then_stays() -> None:
    sweep = replace(SWEEP, ramp=2.0)
    time = np.array([-0.5, 0.0, 0.25, 0.5, 1.0, 2.0, 2.5, 10.0])

    preload = factors_over(sweep.segments(), time)[:, 0]

    np.testing.assert_array_equal(preload, [0, 0, 0.125, 0.25, 0.5, 1.0, 1.0, 1.0])


def test_preload_without_ramp_is_full_from_the_start() -> None:
    sudden = replace(SWEEP, ramp=0.0)

    factors = factors_over(sudden.segments(), np.array([0.0, 1e-9, 5.0]))

    np.testing.assert_array_equal(factors[:, 0], 1.0)


@pytest.mark.parametrize(
    "times",
    [
        {"ramp": -1.0},
        {"ramp": 2.5},
        {"start": 8.0},
        {"end": 1.5},
        {"end": 11.0},
        {"duration": 7.0},
        {"start": float("nan")},
        {"duration": float("inf")},
        {"end": float("inf"), "duration": float("inf")},
    ],
)
def test_times_that_are_infinite_or_in_the_wrong_order_are_refused(
    times: dict[str, float],
) -> None:
    given = {"ramp": 1.0, "start": 2.0, "end": 8.0, "duration": 10.0} | times
    message = (
        "ramp {ramp:g} s, start {start:g} s, end {end:g} s, duration {duration:g} s: "
        "give finite times, 0 <= ramp <= start < end <= duration"
    ).format(**given)

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        replace(SWEEP, **times)


@pytest.mark.parametrize(
    ("lowest", "highest"),
    [
        (0.0, 145.0),
        (125.0, 0.0),
        (125.0, -1.0),
        (float("nan"), 145.0),
        (125.0, float("inf")),
    ],
)
def test_frequencies_that_are_not_positive_and_finite_are_refused(
    lowest: float, highest: float
) -> None:
    message = f"frequencies {lowest:g} and {highest:g} Hz: give positive finite ones"

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        replace(SWEEP, lowest=lowest, highest=highest)


def test_sweep_over_one_frequency_is_refused() -> None:
    message = "lowest and highest are both 130 Hz: a sweep needs two different"

    with pytest.raises(ValueError, match=f"^{message} frequencies$"):
        replace(SWEEP, lowest=130.0, highest=130.0)


def test_dwell_holds_the_preload_and_drives_a_sine_from_rest() -> None:
    dwell = Dwell(frequency=850.0, duration=2.0)
    time = np.linspace(0.0, 2.0, 1001)

    factors = factors_over(dwell.segments(), time)

    assert factors.shape == (1001, 2)
    np.testing.assert_array_equal(factors[:, 0], 1.0)
    np.testing.assert_array_equal(factors[:, 1], np.sin(850.0 * time))


@pytest.mark.parametrize("wrong", [0.0, -2.0, np.nan, np.inf])
@pytest.mark.parametrize(("name", "unit"), [("frequency", "rad/s"), ("duration", "s")])
def test_dwell_that_is_not_positive_and_finite_is_refused(
    name: str, unit: str, wrong: float
) -> None:
    given = {"frequency": 850.0, "duration": 2.0} | {name: wrong}

    text = f"^{name} {wrong:g} {unit}: give a positive finite one$"
    with pytest.raises(ValueError, match=text):
        Dwell(**given)
