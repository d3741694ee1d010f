"""Forces that jump as faces touch, of a damper or viscous friction; tangents know."""

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hbm.balance.relative import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.rigs import problem_of
from microslip.scene_file import load_scene
from microslip.studies.curve import Traced, trace_curve
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.gkf import GeneralKineticFriction
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system


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

    return between_touches(rate, touch, frequency, start, closed=bool(start[0] > gap))


def between_touches(
    rate: Callable[..., Any],
    touch: Any,
    frequency: float,
    start: Array,
    *,
    closed: bool,
) -> Array:
    """Return the state a period later; ``touch`` is zero where faces touch or part."""
    touch.terminal = True
    time, end, state = 0.0, 2.0 * np.pi / frequency, start
    while time < end:
        touch.direction = -1.0 if closed else 1.0
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


COUPLED = np.array([[1e3, -300.0], [-300.0, 1.2e3]])


def lifting(viscous: float) -> Problem:
    """Return two motions that springs couple; one rubs while the other is closed."""
    law = GeneralKineticFriction(
        normal_stiffness=2e3,
        mu_dynamic=0.0,
        mu_static=0.0,
        stribeck_velocity=1.0,
        threshold_velocity=1.0,
        viscous=viscous,
    )
    return system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=COUPLED,
        rayleigh_damping=(2.0, 0.0),
        elements=[Element(law, normal=("z", "ground"), tangents=[("x", "ground")])],
        drive={"x": 3.0, "z": 2.0},
    )


def slides(viscous: float, frequency: float, start: Array) -> Array:
    """Return (x, z) and velocities a period later, integrated between touches."""

    def rate(time: float, state: Any, closed: bool) -> Any:
        force = COUPLED @ state[:2] + 2.0 * state[2:]
        if closed:
            force = force + np.array([viscous * state[2], 2e3 * state[1]])
        load = np.array([3.0, 2.0]) * np.sin(frequency * time)
        return np.concatenate([state[2:], load - force])

    def touch(_: float, state: Any, closed: bool) -> Any:  # noqa: ARG001
        return state[1]

    return between_touches(rate, touch, frequency, start, closed=bool(start[1] > 0.0))


def test_viscous_friction_that_begins_as_faces_touch_is_in_the_derivatives() -> None:
    problem, fourier = lifting(4.0), FourierBasis(3, 512)
    balance = HarmonicBalance(
        relative_problem(problem, static_equilibrium(problem)), fourier
    )
    motion = np.random.default_rng(1).normal(size=(7, 2)) * 1e-3
    point = np.append(motion.ravel(), 30.0)

    _, linearised = balance(point)

    for column in range(point.size - 1):
        step = 1e-8 * np.eye(point.size)[column]
        change = balance(point + step)[0] - balance(point - step)[0]
        own = linearised.jacobian[:, column]
        away = np.abs(own - change / 2e-8).max()
        assert away < 1e-4 * np.abs(own).max()  # 0.1 without the jump


@pytest.mark.parametrize("frequency", [25.0, 32.0, 38.0])
def test_multipliers_know_of_viscous_friction_that_begins_as_faces_touch(
    frequency: float,
) -> None:
    problem = lifting(4.0)
    options = CurveOptions(frequency, 1.02 * frequency, error=1e-4, events=False)
    rest = static_equilibrium(problem)

    response = next(iter(frequency_response(problem, rest, options)))

    displacement, velocity = response.at(np.zeros(1))
    start = np.concatenate([displacement[0], velocity[0]])
    changes = 1e-7 * np.diag([1.0, 1.0, frequency, frequency])
    carried = [
        slides(4.0, frequency, start + change) - slides(4.0, frequency, start - change)
        for change in changes
    ]
    exact = np.linalg.eigvals(np.array(carried).T / (2.0 * changes.diagonal()))
    expected = np.sort(np.abs(exact))[::-1]
    # without the jump they are off by up to 0.04
    np.testing.assert_allclose(np.abs(response.multipliers), expected, atol=1e-3)
