"""Nonlinear modes of springs that are not the same both ways, at their amplitudes."""

import math

import numpy as np
import pytest
import scipy.integrate
import scipy.optimize

import microslip

STIFFNESS, QUADRATIC, CUBIC = 1e4, 2e6, 1e8


def energy(place: float) -> float:
    """Return the potential of the lopsided spring under a mass of 1 kg [J]."""
    powers = STIFFNESS / 2.0, QUADRATIC / 3.0, CUBIC / 4.0
    return sum(k * place ** (2 + power) for power, k in enumerate(powers))


def frequency(highest: float) -> float:
    """Return the frequency [rad/s] of a free motion that turns at ``highest`` [m]."""
    level = energy(highest)
    roots = np.roots([CUBIC / 4.0, QUADRATIC / 3.0, STIFFNESS / 2.0, 0.0, -level])
    lowest = max(root.real for root in roots if abs(root.imag) < 1e-9 > root.real)
    middle, half = 0.5 * (highest + lowest), 0.5 * (highest - lowest)

    def slowness(angle: float) -> float:
        place = middle + half * math.sin(angle)
        return half * math.cos(angle) / math.sqrt(2.0 * (level - energy(place)))

    quarter = math.pi / 2.0
    return math.tau / (2.0 * scipy.integrate.quad(slowness, -quarter, quarter)[0])


def test_an_undamped_lopsided_spring_has_its_frequencies_and_its_mean() -> None:
    spring = microslip.PolynomialSpring({2: QUADRATIC, 3: CUBIC})
    problem = microslip.system(
        mass=[1.0],
        stiffness=[STIFFNESS],
        elements=[microslip.Element(spring, between=("x1", "ground"))],
    )

    (mode,) = microslip.modes(problem, 10.0, 20.0, smallest=1e-5, largest=2e-3)

    for point in mode.points[::4]:
        displacement, _ = point.state(0.0)
        expected = frequency(float(displacement[0]))
        assert point.pole.imag == pytest.approx(expected, rel=1e-4)
    assert mode.points[-1].coefficients[0, 0] < -1e-4


def test_a_fast_mode_meets_a_stop_that_is_far_for_its_inertia() -> None:
    mass, stiffness, gap, most = 1e-3, 1.6e7, 1e-4, 4e-4
    stop = microslip.UnilateralSpring(stiffness=stiffness, gap=gap)
    problem = microslip.system(
        mass=[mass],
        stiffness=[stiffness],
        damping_ratio=1e-2,
        elements=[microslip.Element(stop, between=("x1", "ground"))],
    )

    (mode,) = microslip.modes(problem, 1e4, 3e4, smallest=1e-5, largest=most)

    turning = mode.points[-1].state(0.0)
    slow = math.sqrt(stiffness / mass)

    def force(time: float, state: list[float]) -> list[float]:  # noqa: ARG001
        place, speed = state
        pushed = stiffness * place + stiffness * max(place - gap, 0.0)
        return [speed, -pushed / mass]

    def turns(time: float, state: list[float]) -> float:  # noqa: ARG001
        return state[1]

    turns.direction = -1.0  # type: ignore[attr-defined]
    free = scipy.integrate.solve_ivp(
        force, (0.0, 2.2 * math.tau / slow), [float(turning[0][0]), 0.0],
        events=turns, rtol=1e-9, atol=1e-13, max_step=0.01 / slow,
    )  # fmt: skip
    period = free.t_events[0][free.t_events[0] > 0.1 / slow][0]
    assert mode.points[-1].pole.imag == pytest.approx(math.tau / period, rel=1e-3)
