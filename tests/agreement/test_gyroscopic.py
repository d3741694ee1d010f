"""A gyroscopic matrix of a user's own: closed-form poles, and scipy's march."""

from pathlib import Path

import numpy as np
import pytest
import scipy.integrate
import scipy.sparse

import microslip
from hbm.structure.poles import poles
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem

SPIN, SPRING, DASHPOT, CUBIC, DRIVE = 3.0, 100.0, 0.8, 4e3, 1.5
"""G [N s/m], K [N/m], C [N s/m], k₃ [N/m³] and p [N] of a mass of 1 kg"""
ACROSS = np.array([[0.0, -SPIN], [SPIN, 0.0]])


def rotor(*, damping: float = DASHPOT, cubic: float = CUBIC) -> Problem:
    """Return a mass in a plane that turns, with a cubic spring along x."""
    spring = microslip.CubicSpring(cubic)
    return microslip.system(
        names=["x", "y"],
        mass=[1.0, 1.0],
        stiffness=[SPRING, SPRING],
        damping=[damping, damping],
        gyroscopic=ACROSS,
        elements=[microslip.Element(spring, between=("x", "ground"), name="spring")],
        drive={"x": DRIVE},
    )


def test_poles_are_those_of_forward_and_backward_whirl() -> None:
    problem = rotor(damping=0.0)

    found = poles(problem.structure).values

    # z = x + i y: z̈ + i G ż + k z = 0
    root = np.sqrt(SPIN**2 / 4.0 + SPRING)
    whirls = [root - SPIN / 2.0, root + SPIN / 2.0]
    np.testing.assert_allclose(np.sort(found.imag[found.imag > 0.0]), whirls, rtol=1e-9)
    np.testing.assert_allclose(found.real, 0.0, atol=1e-9)


@pytest.mark.parametrize("turning", [8.0, 11.0, 13.0])
def test_the_curve_and_the_march_are_those_of_the_equation(turning: float) -> None:
    problem, period = rotor(), 2.0 * np.pi / turning

    def rate(time: float, state: Array) -> Array:
        force = -SPRING * state[:2] - (DASHPOT * np.eye(2) + ACROSS) @ state[2:]
        force[0] += DRIVE * np.sin(turning * time) - CUBIC * state[0] ** 3
        return np.append(state[2:], force)

    known = scipy.integrate.solve_ivp(
        rate, (0.0, 60.0 * period), np.zeros(4), method="DOP853",
        t_eval=np.arange(59 * 256, 60 * 256) * period / 256, rtol=1e-10, atol=1e-13,
    )  # fmt: skip
    turns = np.exp(-1j * turning * known.t)
    steady = np.abs(2.0 * np.mean(known.y[:2] * turns, axis=1))

    hertz = turning / (2.0 * np.pi)
    curve = microslip.curve(problem, 0.9 * hertz, hertz)
    history = microslip.sweep(
        problem, hertz, hertz * 1.000001, duration=60.0 * period, time_step=period / 400
    )

    np.testing.assert_allclose(curve.amplitude[-1], steady, rtol=2e-3)
    last = (
        history.displacement[-401:-1]
        * np.exp(-1j * turning * history.time)[-401:-1, None]
    )
    np.testing.assert_allclose(np.abs(2.0 * last.mean(axis=0)), steady, rtol=2e-3)


def test_a_scene_takes_its_rows_and_no_file(tmp_path: Path) -> None:
    text = f"""scene = "system"
[structure]
names = ["x", "y"]
mass = [1, 1]
stiffness = [{SPRING}, {SPRING}]
damping = [{DASHPOT}, {DASHPOT}]
gyroscopic = [[0, -{SPIN}], [{SPIN}, 0]]
[[element]]
name = "spring"
law = "cubic-spring"
between = ["x", "ground"]
cubic = {CUBIC}
[drive]
x = {DRIVE}
"""
    path = tmp_path / "rotor.toml"
    path.write_text(text, encoding="utf-8")

    structure = problem_of(load_scene(str(path), [])).structure

    assert structure.gyroscopic
    np.testing.assert_array_equal(structure.damping, rotor().structure.damping)
    path.write_text(text.replace(f"[[0, -{SPIN}], [{SPIN}, 0]]", '"g.mtx"'), "utf-8")
    with pytest.raises(SceneError, match=r'gyroscopic = "g\.mtx": give its rows'):
        load_scene(str(path), [])


def test_what_does_not_turn_has_no_gyroscopic_forces() -> None:
    problem = microslip.system(
        mass=[1.0, 1.0], stiffness=[1.0, 2.0], gyroscopic=0.0 * ACROSS
    )

    assert not problem.structure.gyroscopic


@pytest.mark.parametrize("ratios", [None, [0.01]])
def test_sparse_matrices_take_a_sparse_one_and_are_reduced(
    ratios: list[float] | None,
) -> None:
    whole = microslip.system(
        mass=scipy.sparse.eye_array(4, format="csc"),
        stiffness=scipy.sparse.diags_array([1.0, 2.0, 3.0, 4.0], format="csc"),
        gyroscopic=scipy.sparse.csc_array(np.kron(np.eye(2), ACROSS)),
        damping_ratio=ratios,
        drive={"x1": 1.0},
    )

    small = microslip.reduced_problem(whole, 10.0).problem.structure

    np.testing.assert_allclose(small.damping[0] + small.damping[:, 0], 0.0, atol=0.05)
    assert np.abs(small.damping).max() == pytest.approx(SPIN, rel=0.1)
