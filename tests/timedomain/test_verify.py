"""Whether a march stays on a periodic response: on one that is, on one that is not."""

import dataclasses

import numpy as np
import pytest

from convergence import observed_order
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from small_problems import oscillator, prescribed
from timedomain.verify import Agreement, agreement, march_periods

MASS, DAMPING, STIFFNESS, DRIVE = 2.0, 4.0, 300.0, 1.5
FREQUENCY = 9.0


def driven() -> Problem:
    return oscillator(mass=MASS, damping=DAMPING, stiffness=STIFFNESS, drive=DRIVE)


def orbit(factor: float = 1.0) -> PeriodicResponse:
    """Return the oscillator's response in closed form, times a factor."""
    s = 1j * FREQUENCY
    amplitude = -1j * factor * DRIVE / (STIFFNESS + s * DAMPING + s**2 * MASS)
    coefficients = np.array([[0.0], [amplitude.real], [-amplitude.imag]])
    return prescribed(FREQUENCY, coefficients)


def compared(
    response: PeriodicResponse, *, periods: int = 12, steps: int = 600
) -> Agreement:
    problem = driven()
    blocks = march_periods(problem, response, periods=periods, steps_per_period=steps)
    return agreement(problem, response, list(blocks))


def test_a_march_stays_on_a_response_that_is_one() -> None:
    found = compared(orbit())

    assert found.deviation[0] < 1e-4
    assert found.first_distance < 1e-4
    assert found.last_distance < 1e-4
    assert found.drift < 1e-5
    assert found.closing_error < 1e-4


def test_the_deviation_falls_with_the_fourth_power_of_the_step() -> None:
    steps = [120, 240, 480]

    deviations = [
        compared(orbit(), periods=30, steps=each).deviation[0] for each in steps
    ]

    order = observed_order([1.0 / each for each in steps], deviations)
    assert order == pytest.approx(4.0, abs=0.1)


def test_a_march_leaves_a_response_that_is_none() -> None:
    found = compared(orbit(1.2), periods=30)

    # It settles on the true orbit, a sixth smaller.
    assert found.predicted[0] == pytest.approx(1.2 * found.marched[0], rel=1e-3)
    assert found.deviation[0] == pytest.approx(1.0 - 1.0 / 1.2, rel=1e-3)
    assert found.last_distance == pytest.approx(1.0 - 1.0 / 1.2, rel=1e-2)


def test_a_march_on_its_way_to_the_orbit_drifts() -> None:
    arriving, settled = (compared(orbit(1.2), periods=each) for each in (4, 40))

    assert arriving.drift > 100.0 * settled.drift


def test_a_probe_that_hardly_moves_is_measured_by_a_hundredth_of_the_largest() -> None:
    found = dataclasses.replace(
        compared(orbit(), periods=2),
        predicted=np.array([2.0, 1e-3, 0.0]),
        marched=np.array([1.8, 2e-3, 4e-3]),
    )

    # by 2, and twice by 0.02
    assert found.deviation == pytest.approx([0.1, 0.05, 0.2])


@pytest.mark.parametrize(("asked", "taken"), [(60, 60), (61, 120), (600, 600)])
def test_steps_per_period_are_rounded_up_to_whole_rows(asked: int, taken: int) -> None:
    blocks = list(march_periods(driven(), orbit(), periods=3, steps_per_period=asked))

    period = 2.0 * np.pi / FREQUENCY
    assert blocks[0].time_step == pytest.approx(period / taken)
    assert sum(len(block.time) for block in blocks) == 180


def test_blocks_of_a_march_are_ten_periods_long() -> None:
    blocks = list(march_periods(driven(), orbit(), periods=25, steps_per_period=60))

    assert [len(block.time) for block in blocks] == [600, 600, 300]


def test_a_phase_error_shows_as_a_distance() -> None:
    late = orbit()
    turned = late.coefficients.copy()
    turned[1:] = turned[[2, 1]] * [[1.0], [-1.0]]

    found = compared(dataclasses.replace(late, coefficients=turned), periods=30)

    # A quarter of a period: the same amplitude, √2 of it away.
    assert found.deviation[0] < 1e-3
    assert found.last_distance == pytest.approx(np.sqrt(2.0), rel=1e-2)
