"""Decays with known answers: linear, constant friction, an offset, too short."""

import numpy as np
import pytest

from microslip_mechanics.results.ring_down import cycle_rows, ring_down


@pytest.mark.parametrize("ratio", [1e-4, 2e-3, 0.02, 0.1])
@pytest.mark.parametrize("offset", [0.0, 0.4])
def test_linear_decay_has_its_frequency_and_damping(
    ratio: float, offset: float
) -> None:
    # no whole number of rows a cycle, so that extremes lie anywhere between two
    natural, rows = 850.0, 60.37
    turning = natural * np.sqrt(1.0 - ratio**2)
    time = np.arange(int(12 * rows)) * 2.0 * np.pi / (turning * rows) + 0.3
    pole = complex(-ratio * natural, turning)
    motion = 2e-3 * np.exp(pole * (time - 0.3) + 0.7j)

    found = ring_down(time, motion.real + offset, (pole * motion).real, rest=offset)

    # the cubic is off by (2π/60)⁴/384 = 3e-7 of the amplitude
    np.testing.assert_allclose(found.damping, ratio, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(found.frequency, natural, rtol=2e-5)
    assert found.amplitude.size >= 20
    # the extremes of a cosine that decays are lower by √(1−ζ²), and half of the way
    # between two of them is higher than in its middle by cosh(πζ/2/√(1−ζ²))
    tilt = ratio / np.sqrt(1.0 - ratio**2)
    between = np.cosh(0.5 * np.pi * tilt) / np.hypot(1.0, tilt)
    envelope = 2e-3 * np.exp(-ratio * natural * (found.time - 0.3))
    np.testing.assert_allclose(found.amplitude, envelope * between, rtol=1e-5)


def test_decay_against_constant_friction_falls_on_a_line() -> None:
    natural, lost, rows = 10.0, 0.02, 80
    half = np.pi / natural
    time = np.arange(1, 20 * rows) * half / rows
    number = np.floor(time / half)
    # each half cycle is a cosine about ±lost
    side = (-1.0) ** number
    size = 1.0 - lost - 2.0 * lost * number
    place = lost * side + side * size * np.cos(natural * (time - number * half))
    rate = -natural * side * size * np.sin(natural * (time - number * half))

    found = ring_down(time, place, rate)

    fallen = np.diff(found.amplitude)
    np.testing.assert_allclose(fallen, -2.0 * lost, rtol=2e-2)
    a = found.amplitude
    # the swing of a cycle falls by 4F/k: from a + 2F/k to a − 2F/k
    mean = np.sqrt(a**2 + (2.0 * lost) ** 2)
    decrement = np.log((mean + 2.0 * lost) / (mean - 2.0 * lost))
    expected = decrement / np.hypot(2.0 * np.pi, decrement)
    np.testing.assert_allclose(found.damping, expected, rtol=1e-4)
    np.testing.assert_allclose(found.frequency, natural, rtol=1e-5)


@pytest.mark.parametrize("cycles", [0.2, 1.2])
def test_too_short_a_motion_gives_nothing(cycles: float) -> None:
    time = np.linspace(0.0, cycles, 50)
    turn = 2.0 * np.pi

    found = ring_down(time, np.cos(turn * time), -turn * np.sin(turn * time))

    assert found.time.size == found.damping.size == 0


def test_motion_that_never_crosses_its_rest_gives_nothing() -> None:
    time = np.linspace(0.0, 1.0, 50)

    assert ring_down(time, np.exp(-time), -np.exp(-time)).time.size == 0


def test_a_decay_ends_where_it_is_lost_in_the_last_digits() -> None:
    natural, ratio = 10.0, 0.1
    time = np.arange(6000) * 0.01
    motion = np.exp(complex(-ratio, np.sqrt(1.0 - ratio**2)) * natural * time)
    noise = 1e-12 * np.random.default_rng(1).normal(size=(2, time.size))
    rate = complex(-ratio, np.sqrt(1.0 - ratio**2)) * natural * motion

    found = ring_down(time, motion.real + noise[0], rate.real + noise[1])

    assert 1e-9 < found.amplitude[-1] < 4e-9
    np.testing.assert_allclose(found.damping, ratio, rtol=1e-2)


@pytest.mark.parametrize("rows", [0.31, 1.13, 2.13, 4.0, 13.3, 60.0])
def test_rows_of_a_cycle_are_counted_where_they_show_no_swings_too(rows: float) -> None:
    # rows about a cycle apart look like a slow motion
    natural, ratio = 10.0, 0.01
    pole = complex(-ratio, np.sqrt(1.0 - ratio**2)) * natural
    time = np.arange(0.0, 30.0, 2.0 * np.pi / (natural * rows))
    motion = np.exp(pole * time + 0.7j)

    counted = cycle_rows(time, motion.real + 0.4, (pole * motion).real, rest=0.4)

    # of rows far apart few phases are seen
    assert counted == pytest.approx(rows, rel=0.2 if rows < 12 else 0.02)


def test_what_does_not_move_has_no_end_of_rows_to_a_cycle() -> None:
    time = np.linspace(0.0, 1.0, 50)

    assert cycle_rows(time, np.ones(50), np.zeros(50)) == np.inf


@pytest.mark.parametrize("ratio", [1e-3, 0.01, 0.05])
def test_a_motion_with_a_stop_on_one_side_has_one_frequency(ratio: float) -> None:
    # half cycles of 10 and of 20 rad/s in turn, with one dashpot
    loss = 10.0 * ratio
    turning = np.sqrt(np.array([10.0, 20.0]) ** 2 - loss**2)
    period = np.pi * (1.0 / turning).sum()
    time = np.arange(0.1, 12.0, period / 97.3)
    cycle, phase = np.divmod(time, period)
    second = phase > np.pi / turning[0]
    rate, side = np.where(second, turning[1], turning[0]), np.where(second, -1.0, 1.0)
    angle = rate * (phase - np.where(second, np.pi / turning[0], 0.0))
    fallen = np.exp(-loss * time)
    place = side * fallen * np.sin(angle) / rate
    speed = side * fallen * np.cos(angle) - loss * place

    found = ring_down(time, place, speed)

    assert cycle[-1] > 20
    natural = np.hypot(2.0 * np.pi / period, loss)
    # half cycles that differ leave something of second order in the damping
    within = 3e-5 + 0.02 * ratio**2
    np.testing.assert_allclose(found.frequency, natural, rtol=within)
    expected = loss / natural
    np.testing.assert_allclose(found.damping, expected, rtol=2e-3)
