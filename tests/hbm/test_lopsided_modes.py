"""Nonlinear modes of springs that are not the same both ways, at their amplitudes."""

import math
from collections.abc import Callable

import pytest
import scipy.integrate
import scipy.optimize

import microslip

STIFFNESS, QUADRATIC, CUBIC = 1e4, 2e6, 1e8
STIFF, GAP = 1.6e7, 1e-4


def lopsided(place: float) -> float:
    """Return the potential of the spring with a quadratic part [J]."""
    powers = STIFFNESS / 2.0, QUADRATIC / 3.0, CUBIC / 4.0
    return sum(k * place ** (2 + power) for power, k in enumerate(powers))


def stopped(place: float) -> float:
    """Return the potential of a spring with a stop as stiff behind a gap [J]."""
    return 0.5 * STIFF * (place**2 + max(place - GAP, 0.0) ** 2)


def frequency(energy: Callable[[float], float], mass: float, highest: float) -> float:
    """Return the frequency [rad/s] of a free motion that turns at ``highest`` [m]."""
    level = energy(highest)
    lowest = scipy.optimize.brentq(lambda x: energy(x) - level, -3.0 * highest, 0.0)
    middle, half = 0.5 * (highest + lowest), 0.5 * (highest - lowest)

    def slowness(angle: float) -> float:
        speed = math.sqrt(2.0 * (level - energy(middle + half * math.sin(angle))))
        return half * math.cos(angle) / speed

    quarter = math.pi / 2.0
    swing, _ = scipy.integrate.quad(slowness, -quarter, quarter)
    return math.tau / (2.0 * math.sqrt(mass) * float(swing))


def test_an_undamped_lopsided_spring_has_its_frequencies_and_its_mean() -> None:
    spring = microslip.PolynomialSpring({2: QUADRATIC, 3: CUBIC})
    problem = microslip.system(
        mass=[1.0],
        stiffness=[STIFFNESS],
        elements=[microslip.Element(spring, between=("x1", "ground"))],
    )

    (mode,) = microslip.modes(problem, 10.0, 20.0, smallest=1e-5, largest=2e-3)

    for point in mode.points[::4]:
        highest = float(point.state(0.0)[0][0])
        expected = frequency(lopsided, 1.0, highest)
        assert point.pole.imag == pytest.approx(expected, rel=1e-4)
    assert mode.points[-1].coefficients[0, 0] < -1e-4


def test_a_fast_mode_meets_a_stop_that_is_far_for_its_inertia() -> None:
    mass = 1e-3
    stop = microslip.UnilateralSpring(stiffness=STIFF, gap=GAP)
    problem = microslip.system(
        mass=[mass],
        stiffness=[STIFF],
        damping_ratio=0.01,
        elements=[microslip.Element(stop, between=("x1", "ground"))],
    )

    (mode,) = microslip.modes(problem, 1e4, 3e4, smallest=1e-5, largest=4.0 * GAP)

    last = mode.points[-1]
    expected = frequency(stopped, mass, float(last.state(0.0)[0][0]))
    assert last.pole.imag == pytest.approx(expected, rel=1e-3)
