"""Sine tests: each kind of sweep against its closed form, phases that go on."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory, SweptSine
from microslip_mechanics.loads.force_record import ForceRecord
from microslip_mechanics.loads.segments import clock, factors_over
from microslip_mechanics.loads.sine_test import SineTest, Tone, stepped


def drive_of(history: LoadHistory, time: Array) -> Array:
    return factors_over(history.segments(), time)[:, 1]


def test_one_exponential_tone_is_the_swept_sine() -> None:
    sweep = SweptSine(1.0, 2.0, 8.0, 10.0, 125.0, 145.0)
    test = SineTest(1.0, 2.0, (Tone(125.0, 145.0, 6.0),), 2.0)
    time = np.linspace(0.0, 10.0, 7001)

    assert test.duration == sweep.duration
    np.testing.assert_allclose(
        factors_over(test.segments(), time),
        factors_over(sweep.segments(), time),
        atol=1e-12,
    )


def test_linear_tone_has_a_quadratic_phase() -> None:
    test = SineTest(0.0, 0.5, (Tone(20.0, 80.0, 3.0, 2.0, "linear"),), 0.0)
    elapsed = np.linspace(0.0, 3.0, 4001)

    drive = drive_of(test, 0.5 + elapsed)

    phase = 2.0 * np.pi * (20.0 * elapsed + 10.0 * elapsed**2)
    np.testing.assert_allclose(drive, 2.0 * np.sin(phase), atol=1e-11)


def test_steps_begin_and_end_at_zero_of_the_sine() -> None:
    frequencies = np.array([10.0, 12.5, 20.0])

    tones = stepped(frequencies, periods=4)
    test = SineTest(0.0, 1.0, tuple(tones), 0.5)

    edges = 1.0 + np.cumsum([0.0, 0.4, 0.32, 0.2])
    assert test.duration == pytest.approx(edges[-1] + 0.5)
    for begin, frequency in zip(edges, frequencies, strict=False):
        time = begin + np.linspace(0.0, 4.0, 101) / frequency
        expected = np.sin(2.0 * np.pi * frequency * (time - begin))
        np.testing.assert_allclose(drive_of(test, time), expected, atol=1e-11)
    np.testing.assert_array_equal(drive_of(test, edges[-1:] + 0.1), 0.0)


@pytest.mark.parametrize("growth", ["exponential", "linear"])
def test_turning_round_keeps_phase_and_frequency(growth: str) -> None:
    up = Tone(125.0, 145.0, 1.0, growth=growth)  # type: ignore[arg-type]
    down = Tone(145.0, 125.0, 1.0, growth=growth)  # type: ignore[arg-type]
    test = SineTest(0.0, 0.0, (up, down), 0.0)

    around = clock(test.segments(), np.array([1.0 - 1e-7, 1.0, 1.0 + 1e-7]))

    np.testing.assert_allclose(around[:, 0], 2.0 * np.pi * 145.0, rtol=1e-6)
    steps = np.diff(around[:, 2])
    np.testing.assert_allclose(steps, 2.0 * np.pi * 145.0 * 1e-7, rtol=1e-4)


def test_a_level_after_a_pause_begins_at_zero_of_the_sine() -> None:
    pause = Tone(14.3, 14.3, 0.17, 0.0)
    test = SineTest(
        0.0, 0.0, (Tone(10.0, 14.3, 1.0), pause, Tone(10.0, 14.3, 1.0, 2.5)), 0.0
    )
    elapsed = np.linspace(1e-9, 1.0, 500)

    first, second = drive_of(test, elapsed), drive_of(test, 1.17 + elapsed)

    np.testing.assert_allclose(second, 2.5 * first, atol=1e-11)
    np.testing.assert_array_equal(drive_of(test, 1.0 + 0.17 * elapsed), 0.0)


@pytest.mark.parametrize(
    "test",
    [
        SineTest(0.1, 0.2, tuple(stepped(np.array([9.0, 7.0]), periods=3)), 1.0),
        SineTest(0.0, 0.3, (Tone(9.0, 3.0, 1.0, 0.0), Tone(3.0, 9.0, 1.0)), 1.0),
        ForceRecord(0.1, 0.2, np.array([0.1, 0.4]), np.array([1.0, 2.0]), 0.3, 50.0),
    ],
)
def test_the_clock_never_goes_back(test: LoadHistory) -> None:
    phase = clock(test.segments(), np.linspace(0.0, test.duration, 3001))[:, 2]

    assert (np.diff(phase) > 0.0).all()


def test_force_is_straight_between_its_values_and_zero_outside() -> None:
    time, factor = np.array([0.5, 1.0, 1.2, 3.0]), np.array([2.0, -1.0, 4.0, 4.0])
    record = ForceRecord(0.2, 0.7, time, factor, 1.0, 50.0)
    inside = np.random.default_rng(1).uniform(0.5, 3.0, 400)

    drive = drive_of(record, 0.7 + inside)

    assert record.duration == pytest.approx(4.7)
    np.testing.assert_allclose(drive, np.interp(inside, time, factor), atol=1e-13)
    outside = factors_over(record.segments(), np.array([0.0, 0.7, 1.19, 3.71, 4.7]))
    np.testing.assert_array_equal(outside[:, 1], 0.0)
    np.testing.assert_array_equal(outside[:, 0], [0.0, 1.0, 1.0, 1.0, 1.0])


@pytest.mark.parametrize(
    ("given", "hint"),
    [
        ({"first": 0.0}, "positive finite"),
        ({"last": np.nan}, "positive finite"),
        ({"length": 0.0}, "length 0 s"),
        ({"level": -1.0}, "level -1"),
    ],
)
def test_a_tone_that_makes_no_sense_is_refused(
    given: dict[str, float], hint: str
) -> None:
    with pytest.raises(ValueError, match=hint):
        Tone(**({"first": 1.0, "last": 2.0, "length": 1.0} | given))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("time", "factor"),
    [([0.0], [1.0]), ([0.0, 0.0], [1.0, 1.0]), ([-1.0, 1.0], [0, 1]), ([0, 1], [1])],
)
def test_a_force_that_makes_no_sense_is_refused(
    time: list[float], factor: list[float]
) -> None:
    with pytest.raises(ValueError, match="a force"):
        ForceRecord(0.0, 0.0, np.array(time), np.array(factor), 0.0, 50.0)


def test_a_sine_test_without_tones_is_refused() -> None:
    with pytest.raises(ValueError, match="at least one tone"):
        SineTest(0.0, 0.0, (), 1.0)
