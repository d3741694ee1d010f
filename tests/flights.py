"""Multipliers of motions that touch, by integration from touch to touch."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.element import Element
from microslip_mechanics.laws.bristles import LuGre
from microslip_mechanics.laws.gkf import GeneralKineticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.system import system

COUPLED = np.array([[1e3, -300.0], [-300.0, 1.2e3]])


def flight_multipliers(problem: Problem, response: PeriodicResponse) -> ComplexArray:
    """Return those of a mass with a damped stop, by central differences."""
    displacement, velocity = response.at(np.zeros(1))
    start = np.array([displacement[0, 0], velocity[0, 0]])
    changes = 1e-9 * np.diag([1.0, response.frequency])
    carried = [
        flight(problem, response.frequency, start + change)
        - flight(problem, response.frequency, start - change)
        for change in changes
    ]
    found = np.linalg.eigvals(np.array(carried).T / (2.0 * changes.diagonal()))
    return found.astype(complex)


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
    return _lifting(law)


def remembering(viscous: float) -> Problem:
    """Return the same with bristles, which are too soft to be felt."""
    law = LuGre(
        normal_stiffness=2e3,
        mu_dynamic=0.3,
        mu_static=0.3,
        stribeck_velocity=1.0,
        stiffness=1e-4,
        viscous=viscous,
    )
    return _lifting(law)


def beside_a_slider(damping: float) -> Problem:
    """Return a mass with a damped stop, and another on a slider that remembers."""
    stop = UnilateralSpring(stiffness=4e3, gap=1e-3, damping=damping)
    return system(
        names=["x", "s"],
        mass=[1.0, 1.0],
        stiffness=[[900.0, 0.0], [0.0, 900.0]],
        rayleigh_damping=(2.0, 0.0),
        elements=[
            Element(stop, between=("x", "ground")),
            Element(Jenkins(stiffness=300.0, limit=0.5), between=("s", "ground")),
        ],
        drive={"x": 2.0, "s": 2.0},
    )


def _lifting(law: GeneralKineticFriction | LuGre) -> Problem:
    """Return two motions that springs couple, with friction on one."""
    return system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=COUPLED,
        rayleigh_damping=(2.0, 0.0),
        elements=[Element(law, normal=("z", "ground"), tangents=[("x", "ground")])],
        drive={"x": 3.0, "z": 2.0},
    )


def rubbing_multipliers(viscous: float, response: PeriodicResponse) -> ComplexArray:
    """Return those of a response of :func:`lifting`, by central differences."""
    displacement, velocity = response.at(np.zeros(1))
    frequency = response.frequency
    start = np.concatenate([displacement[0], velocity[0]])
    changes = 1e-7 * np.diag([1.0, 1.0, frequency, frequency])
    carried = [
        slides(viscous, frequency, start + change)
        - slides(viscous, frequency, start - change)
        for change in changes
    ]
    found = np.linalg.eigvals(np.array(carried).T / (2.0 * changes.diagonal()))
    return found.astype(complex)


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
        made = solve_ivp(
            rate, (time, end), state, "DOP853", args=(closed,), events=touch,
            rtol=1e-11, atol=1e-15, max_step=end / 50,
        )  # fmt: skip
        time, state, closed = float(made.t[-1]), made.y[:, -1], not closed
    return state
