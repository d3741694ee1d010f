"""Errors of a free decay: what its time steps and rows change."""

import dataclasses

import numpy as np

from microslip.scenes.experiments import March
from microslip.studies.decay import measured, released
from microslip.studies.decay_errors import step_errors
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from small_problems import cubic_oscillator, oscillator
from timedomain.record.start import Start


def test_the_error_of_the_steps_is_what_a_finer_march_shows() -> None:
    # a hardening spring: frequency falls with the amplitude
    problem = cubic_oscillator(cubic=50.0, damping=0.4, stiffness=100.0, drive=0.0)
    start = Start(np.ones(1), np.zeros(1))

    def of(steps: int) -> TimeHistory:
        march = March(2.0 * np.pi / 10.0 / steps, 1)
        blocks = released(problem, start, march, frequency=10.0, periods=10)
        return joined(list(blocks), "complete")

    true, other = measured(problem, of(6400), 0), of(100)
    for steps in (200, 400):
        history = of(steps)
        found = measured(problem, history, 0)
        told, other = step_errors(problem, found, other, 0), history
        for name, error in zip(("frequency", "damping"), told[:2], strict=True):
            exact, seen = getattr(true, name), getattr(found, name)
            away = np.abs(seen - exact).max() / exact.max()
            assert away <= error < 10.0 * away


def linear_decay(steps: int, stride: int, *, periods: int) -> TimeHistory:
    """Return a decay of 2 ü + 0.5 u̇ + 300 u = 4, whose time steps are exact."""
    start, natural = Start(np.array([0.05]), np.zeros(1)), np.sqrt(150.0)
    march = March(2.0 * np.pi / natural / steps, stride)
    blocks = released(
        oscillator(preload=4.0), start, march, frequency=natural, periods=periods
    )
    return joined(list(blocks), "complete")


def test_the_error_of_the_rows_bounds_the_true_one() -> None:
    problem = oscillator(preload=4.0)
    found = measured(problem, linear_decay(600, 10, periods=10), 0)

    told = step_errors(problem, found, linear_decay(300, 5, periods=10), 0)

    exact = (np.sqrt(150.0), 0.5 / (2.0 * np.sqrt(600.0)))
    for error, seen, true in zip(
        told[:2], (found.frequency, found.damping), exact, strict=True
    ):
        away = np.abs(seen / true - 1.0).max()
        assert away <= error < 10.0 * away


def test_swings_that_one_decay_has_more_are_not_taken_for_the_next_ones() -> None:
    # a faster motion beside it adds swings of its own at the beginning
    time = np.linspace(0.0, 12.0, 6001)

    def history(extra: float) -> TimeHistory:
        shown = np.exp(-0.05 * time - 0.01 * time**2) * np.sin(6.0 * time)
        shown += extra * np.exp(-2.0 * time) * np.cos(31.0 * time)
        base = linear_decay(600, 10, periods=10)
        moved = np.interp(time, time, shown)[:, None]
        first, last = base.energy[0], base.energy[-1]
        return dataclasses.replace(
            base,
            time=time,
            displacement=moved,
            velocity=np.gradient(moved, time, axis=0),
            energy=np.linspace(first, last, time.size),
        )

    problem = oscillator(preload=0.0)
    found = measured(problem, history(1.0), 0)
    told = step_errors(problem, found, history(0.2), 0)

    assert told.usual < 1e-3


def test_errors_beside_a_decay_without_swings_are_not_known() -> None:
    problem = oscillator(preload=4.0)
    found = measured(problem, linear_decay(600, 10, periods=10), 0)
    short = linear_decay(600, 10, periods=1)

    assert np.isnan(step_errors(problem, found, short, 0)).all()
