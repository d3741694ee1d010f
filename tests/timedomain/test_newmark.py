"""Order of the march on smooth arcs: free, sticking, sliding, pressed together."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.integrate

from contact_tables import FRICTION_LAWS, contact_points, linear_contact
from convergence import observed_order
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from small_problems import NORMAL, mass_on_contact, oscillator, sliding_block
from timedomain.integrate import MarchOptions, integrate
from timedomain.options import METHODS, Method
from timedomain.record.start import Start

pytestmark = pytest.mark.kernels

MASS, LOAD, FRICTION = 2.0, 1.7, 0.3
STEPS = (32, 64, 128, 256)
"""few enough for a march without compiled kernels"""
ONE_ITERATION = """
from contact_tables import contact_points
from microslip_mechanics.loads.excitation import Dwell
from small_problems import NORMAL, from_rest, marched, mass_on_contact
from timedomain.reference import newmark
from timedomain.integrate import MarchOptions
newmark.NEWTON_LIMIT = 1
points = contact_points(stiffness=300.0, exponent=1.0, damping=0.0, friction=0)
problem = mass_on_contact(points, direction=NORMAL, preload=3.0, drive=0.5)
history = marched(
    problem,
    Dwell(1.0, 0.1),
    MarchOptions(0.01, method="reference"),
    start=from_rest(problem),
)
print(history.iterations, history.divided)
"""


def last(
    problem: Problem,
    steps: int,
    *,
    duration: float,
    start: Start,
    method: Method = "reference",
) -> np.ndarray:
    """Return displacement and velocity of a single mass at the end of a free march."""
    options = MarchOptions(
        duration / steps, store_every=steps, method=method, residual=1e-13
    )
    (history,) = integrate(
        problem, Dwell(1.0, duration), options, start=start, block=duration
    )
    return np.array([history.displacement[-1, 0], history.velocity[-1, 0]])


def order(
    problem: Problem,
    exact: np.ndarray,
    *,
    duration: float,
    start: Start,
    method: Method = "reference",
) -> float:
    """Return the observed order of the error at the end."""
    scale = np.abs(exact).max()
    errors = [
        np.abs(
            last(problem, steps, duration=duration, start=start, method=method) - exact
        ).max()
        / scale
        for steps in STEPS
    ]
    return observed_order([duration / steps for steps in STEPS], errors)


def moving(displacement: float, velocity: float) -> Start:
    return Start(np.array([displacement]), np.array([velocity]))


def test_free_vibration_converges_with_second_order() -> None:
    damping, stiffness, duration = 0.5, 300.0, 1.3
    problem = oscillator(mass=MASS, damping=damping, stiffness=stiffness, drive=0.0)
    decay, frequency = damping / (2.0 * MASS), np.sqrt(stiffness / MASS)
    pole = -decay + 1j * np.sqrt(frequency**2 - decay**2)

    # x = Re A exp(λ t) with x(0) = 1, ẋ(0) = 3
    amplitude = 1.0 + 1j * (pole.real - 3.0) / pole.imag
    moved = amplitude * np.exp(pole * duration)
    exact = np.array([moved.real, (pole * moved).real])

    measured = order(problem, exact, duration=duration, start=moving(1.0, 3.0))
    assert measured == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("law", ["coulomb", "gkf"])
def test_sticking_decays_with_second_order(law: str, method: Method) -> None:
    # A block below the threshold velocity: m v̇ = −µN v / V_lim, but for GKF with
    # V_str far above the speed µ = µs hardly falls.
    threshold, start, duration = 0.1, 0.08, 1.0
    coefficient = {"coulomb": FRICTION, "gkf": 0.6}[law]
    problem = sliding_block(
        mass=MASS,
        friction=FRICTION_LAWS[law],
        dynamic=FRICTION,
        static=0.6,
        stribeck=1e12,
        viscous=0.0,
        load=LOAD,
        threshold=threshold,
    )

    rate = coefficient * LOAD / (MASS * threshold)
    velocity = start * np.exp(-rate * duration)
    exact = np.array([(start - velocity) / rate, velocity])

    measured = order(
        problem, exact, duration=duration, start=moving(0.0, start), method=method
    )
    assert measured == pytest.approx(2.0, abs=0.1)


def test_sliding_at_constant_friction_is_marched_exactly() -> None:
    problem = sliding_block(mass=MASS, dynamic=FRICTION, load=LOAD, threshold=1e-3)
    start, duration = 2.0, 5.0
    deceleration = FRICTION * LOAD / MASS

    end = last(problem, 32, duration=duration, start=moving(0.0, start))

    exact = [
        start * duration - deceleration * duration**2 / 2.0,
        start - deceleration * duration,
    ]
    np.testing.assert_allclose(end, exact, rtol=1e-13)


def test_sliding_on_a_spring_converges_with_second_order() -> None:
    stiffness, start, duration = 8.0, 2.0, 0.6
    problem = sliding_block(
        mass=MASS, stiffness=stiffness, dynamic=FRICTION, load=LOAD, threshold=1e-3
    )
    frequency = np.sqrt(stiffness / MASS)
    shift = FRICTION * LOAD / stiffness

    # A vibration about −µN/k while the block moves forward.
    phase = frequency * duration
    exact = np.array(
        [
            shift * np.cos(phase) + start / frequency * np.sin(phase) - shift,
            -shift * frequency * np.sin(phase) + start * np.cos(phase),
        ]
    )
    assert exact[1] > 0.1

    measured = order(problem, exact, duration=duration, start=moving(0.0, start))
    assert measured == pytest.approx(2.0, abs=0.1)


def test_sliding_with_falling_friction_converges_with_second_order() -> None:
    static, stribeck, start, duration = 0.6, 0.5, 1.2, 1.0
    problem = sliding_block(
        mass=MASS,
        friction=FRICTION_LAWS["gkf"],
        dynamic=FRICTION,
        static=static,
        stribeck=stribeck,
        viscous=0.0,
        load=LOAD,
        threshold=1e-3,
    )

    # m v̇ = −N (µd + (µs − µd) exp(−v / V_str)): µd exp(v / V_str) + µs − µd decays.
    def level(velocity: float) -> float:
        return float(FRICTION * np.exp(velocity / stribeck) + static - FRICTION)

    remaining = level(start) * np.exp(-FRICTION * LOAD * duration / (MASS * stribeck))
    exact = stribeck * np.log((remaining - static + FRICTION) / FRICTION)

    errors = [
        abs(
            last(problem, steps, duration=duration, start=moving(0.0, start))[1] - exact
        )
        for steps in STEPS
    ]
    assert exact > 0.1
    measured = observed_order([1.0 / steps for steps in STEPS], errors)
    assert measured == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("method", METHODS)
def test_linear_contact_rebounds_with_second_order(method: Method) -> None:
    stiffness, damping, duration = 300.0, 1.5, 0.15
    points = linear_contact(stiffness, damping)
    problem = mass_on_contact(points, direction=NORMAL, mass=MASS)
    decay = damping / (2.0 * MASS)
    pole = -decay + 1j * np.sqrt(stiffness / MASS - decay**2)

    # From δ = 0.1 at rest: in contact for about a quarter of a period, 0.13 s, and
    # after that no force acts. The march ends before.
    amplitude = 0.1 * (1.0 + 1j * pole.real / pole.imag)
    end = 0.8 * duration
    moved = amplitude * np.exp(pole * end)
    exact = np.array([moved.real, (pole * moved).real])
    assert exact[0] > 0.0

    measured = order(
        problem, exact, duration=end, start=moving(0.1, 0.0), method=method
    )
    assert measured == pytest.approx(2.0, abs=0.1)


def hunt_crossley(_time: float, state: np.ndarray) -> list[float]:
    depth, approach = state
    force = 3e3 * depth**2 + 20.0 * np.sqrt(depth) * approach
    return [approach, -force / MASS]


@pytest.mark.parametrize("method", METHODS)
def test_hunt_crossley_contact_rebounds_with_second_order(method: Method) -> None:
    points = contact_points(stiffness=3e3, damping=20.0, friction=0)
    problem = mass_on_contact(points, direction=NORMAL, mass=MASS)
    duration = 0.16
    solution = scipy.integrate.solve_ivp(
        hunt_crossley,
        (0.0, duration),
        [0.02, 0.5],
        method="DOP853",
        rtol=1e-13,
        atol=1e-15,
    )
    exact = solution.y[:, -1]
    assert exact[0] > 0.005  # still in contact, on its way out
    assert exact[1] < 0.0

    measured = order(
        problem, exact, duration=duration, start=moving(0.02, 0.5), method=method
    )
    assert measured == pytest.approx(2.0, abs=0.1)


def test_the_last_iteration_may_converge() -> None:
    # Without compiled kernels, so that the limit can be changed. The contact is
    # linear: one iteration solves a step.
    done = subprocess.run(
        [sys.executable, "-c", ONE_ITERATION],
        cwd=Path(__file__).parents[1],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=True,
    )

    assert done.stdout.split() == ["10", "0"]
