"""The fast march of structures without contacts against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.integrate

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.system import system
from timedomain.integrate import MarchOptions, integrate

HERTZ, DRIVES = 5.3, np.array([1.0, 0.7])


def pair(gyroscopic: float, dashpot: float = 0.0) -> Problem:
    """Return two masses that move independently but for forces across velocities.

    The dashpot between them is one of the damping matrix.
    """
    made = system(
        mass=np.eye(2).tolist(),
        stiffness=np.diag([1000.0, 1600.0]).tolist(),
        damping_ratio=0.03,
        drive={"x1": DRIVES[0], "x2": DRIVES[1]},
    )
    across = gyroscopic * np.array([[0.0, -1.0], [1.0, 0.0]])
    between = dashpot * np.array([[1.0, -1.0], [-1.0, 1.0]])
    damping = made.structure.damping + across + between
    structure = replace(made.structure, damping=damping, gyroscopic=gyroscopic != 0.0)
    return replace(made, structure=structure)


def marched(problem: Problem, steps: int, tolerance: float | None) -> ComplexArray:
    """Return the phasors of the steady motion at so many steps a period."""
    options = MarchOptions(1.0 / HERTZ / steps, 1, method="fast", tolerance=tolerance)
    load = Dwell(2.0 * np.pi * HERTZ, 120.0 / HERTZ)
    history = joined(list(integrate(problem, load, options)), "complete")
    turn = np.exp(-2j * np.pi * HERTZ * history.time[-steps:])
    phasors: ComplexArray = 2j * np.mean(
        history.displacement[-steps:] * turn[:, None], axis=0
    )
    return phasors


def exact(problem: Problem) -> ComplexArray:
    turn, structure = 2.0 * np.pi * HERTZ, problem.structure
    stiffness = structure.stiffness - turn**2 * structure.mass
    found: ComplexArray = np.linalg.solve(
        stiffness + 1j * turn * structure.damping, DRIVES
    )
    return found


@pytest.mark.parametrize("gyroscopic", [6.0, -6.0])
def test_gyroscopic_forces_have_the_sense_of_the_rotation(gyroscopic: float) -> None:
    problem = pair(gyroscopic)

    found = marched(problem, 2000, None)

    np.testing.assert_allclose(np.abs(found), np.abs(exact(problem)), rtol=1e-5)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
def test_a_sine_is_met_within_the_tolerance(tolerance: float) -> None:
    problem = pair(0.0)

    found = marched(problem, 12, tolerance)

    np.testing.assert_allclose(np.abs(found), np.abs(exact(problem)), rtol=tolerance)


def test_the_error_of_loads_falls_with_the_fourth_power_of_the_step() -> None:
    problem = pair(0.0)
    known = np.abs(exact(problem))

    errors = [
        np.abs(np.abs(marched(problem, steps, None)) / known - 1.0).max()
        for steps in (12, 24, 48)
    ]

    assert errors[0] < 3e-4
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.1)


@pytest.mark.parametrize(
    ("gyroscopic", "dashpot"), [(6.0, 0.0), (20.0, 0.0), (0.0, 5.0), (0.0, 50.0)]
)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_coupled_damping_is_met_within_the_tolerance(
    gyroscopic: float, dashpot: float, tolerance: float
) -> None:
    problem = pair(gyroscopic, dashpot)

    found = marched(problem, 12, tolerance)

    np.testing.assert_allclose(np.abs(found), np.abs(exact(problem)), rtol=tolerance)


@pytest.mark.parametrize(
    ("stiffness", "damping", "hertz", "duration", "tolerance"),
    [
        ([0.0, 0.0], [[0.2, -5.0], [5.0, 0.2]], 0.2, 20.0, 1e-5),
        ([0.0, 0.0], [[0.2, -10.0], [10.0, 0.2]], 0.2, 20.0, 1e-6),
        ([-10.0, 1000.0], [[5.0, -5.0], [-5.0, 5.0]], 1.0, 3.0, 1e-2),
    ],
)
def test_coupling_of_free_and_of_unstable_modes_is_met_within_the_tolerance(
    stiffness: list[float],
    damping: list[list[float]],
    hertz: float,
    duration: float,
    tolerance: float,
) -> None:
    whole = pair(0.0)
    structure = replace(
        whole.structure,
        stiffness=np.diag(stiffness),
        damping=np.array(damping),
        gyroscopic=True,
    )
    problem = replace(whole, structure=structure)
    load = Dwell(2.0 * np.pi * hertz, duration)
    options = MarchOptions(0.1, 1, method="fast", tolerance=tolerance)

    found = joined(list(integrate(problem, load, options)), "complete")

    def rates(time: float, state: Array) -> Array:
        drive = DRIVES * np.sin(2.0 * np.pi * hertz * time)
        force = drive - np.array(stiffness) * state[:2] - np.array(damping) @ state[2:]
        return np.append(state[2:], force)

    known = scipy.integrate.solve_ivp(
        rates,
        (0.0, duration),
        np.zeros(4),
        method="DOP853",
        t_eval=found.time,
        rtol=1e-10,
        atol=1e-13,
    ).y[:2]
    away = np.abs(found.displacement.T - known).max() / np.abs(known).max()
    assert away < tolerance
