"""A damper in a stop: its force jumps as the faces touch, and the tangents know it."""

import functools
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import Traced, trace_curve
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse


@functools.cache
def traced(damping: float) -> tuple[Problem, Traced]:
    scene = load_scene("gap", [f"element.stop.damping={damping}"])
    problem = problem_of(scene)
    return problem, trace_curve(problem, scene.curve)


def flight(problem: Problem, frequency: float, start: Array) -> Array:
    """Return displacement and velocity a period later, integrated between touches."""
    structure, points = problem.structure, problem.interface.points
    mass, spring, drag = (
        float(each[0, 0])
        for each in (structure.mass, structure.stiffness, structure.damping)
    )
    stop, damper, gap = points.stiffness[0], points.damping[0], points.gap[0]
    drive = float(np.abs(problem.drive[0]))

    def rate(time: float, state: Any, closed: bool) -> Any:
        force = spring * state[0] + drag * state[1]
        if closed:
            force += max(0.0, stop * (state[0] - gap) + damper * state[1])
        return [state[1], (drive * np.sin(frequency * time) - force) / mass]

    def touch(_: float, state: Any, closed: bool) -> Any:  # noqa: ARG001
        return state[0] - gap

    touch.terminal = True  # type: ignore[attr-defined]
    time, end, state = 0.0, 2.0 * np.pi / frequency, start
    closed = bool(start[0] > gap)
    while time < end:
        touch.direction = -1.0 if closed else 1.0  # type: ignore[attr-defined]
        made = solve_ivp(  # type: ignore[call-overload]
            rate, (time, end), state, "DOP853", args=(closed,), events=touch,
            rtol=1e-11, atol=1e-15, max_step=end / 50,
        )  # fmt: skip
        time, state, closed = float(made.t[-1]), made.y[:, -1], not closed
    return state


def multipliers(problem: Problem, response: PeriodicResponse) -> Array:
    """Return moduli by central differences of one period."""
    displacement, velocity = response.at(np.zeros(1))
    start = np.array([displacement[0, 0], velocity[0, 0]])
    changes = 1e-9 * np.diag([1.0, response.frequency])
    carried = [
        flight(problem, response.frequency, start + change)
        - flight(problem, response.frequency, start - change)
        for change in changes
    ]
    found = np.linalg.eigvals(np.array(carried).T / (2.0 * changes.diagonal()))
    return np.sort(np.abs(found))[::-1]


@pytest.mark.parametrize("damping", [1.0, 5.0])
def test_peak_and_folds_are_those_of_the_points(damping: float) -> None:
    _, found = traced(damping)
    curve = found.curve
    places = {name: curve.event.index(name) for name in ("peak", "fold")}
    plain = np.array([not name for name in curve.event])

    peak, fold = places["peak"], places["fold"]
    highest = curve.amplitude[plain, 0].max()
    assert curve.amplitude[peak, 0] > (1.0 - 1e-4) * highest
    farthest = curve.frequency[plain & (curve.amplitude[:, 0] > 0.6 * highest)].max()
    assert curve.frequency[fold] > (1.0 - 1e-4) * farthest


def test_a_multiplier_is_one_at_each_fold() -> None:
    _, found = traced(5.0)
    folds = [each for each in found.responses if each.event == "fold"]

    assert len(folds) == 2
    for fold in folds:
        # the force jumps, so that its series falls slowly
        assert np.abs(fold.multipliers - 1.0).min() < 2e-2


def test_multipliers_are_those_of_integrated_flights() -> None:
    problem, found = traced(5.0)
    hertz = found.curve.frequency / (2.0 * np.pi)
    touching = np.flatnonzero((hertz > 5.2) & (hertz < 5.6))

    for place in touching[:: max(1, len(touching) // 4)]:
        response = found.responses[place]
        expected = multipliers(problem, response)
        own = np.abs(response.multipliers)
        np.testing.assert_allclose(own, expected, atol=2e-3)
