"""Condensation against direct solves with the full matrices."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from free_structures import MASSES, chain
from hbm.structure.condensation import condense
from hbm.structure.condensed_structure import CondensedStructure
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from rigs import rig_problem
from small_problems import cantilever, oscillator, sliding_block

HERTZ = np.array([0.0, 21.0, 130.0, 151.0, 404.0, 1890.0])
"""Some hertz away from all poles: there an undamped structure has an answer too, and
rounding, relative to the squares of the highest frequencies, grows little."""


def with_damping(factor: float) -> Problem:
    problem = rig_problem()
    structure = problem.structure
    return dataclasses.replace(
        problem,
        structure=dataclasses.replace(structure, damping=factor * structure.damping),
    )


UNCLAMPED = "nothing clamps it"
"""has no static response"""

PROBLEMS: dict[str, Callable[[], Problem]] = {
    "full": rig_problem,
    "A": lambda: rig_problem(model="A"),
    "parallel blades": lambda: rig_problem(blade__fan="0 deg"),
    "parallel blades in A": lambda: rig_problem(blade__fan="0 deg", model="A"),
    "undamped": lambda: with_damping(0.0),
    "strongly damped": lambda: with_damping(300.0),
    "no rope": lambda: rig_problem(rope=None),
    "beam without contact": cantilever,
    "nothing but a contact": lambda: sliding_block(damping=3.0),
    UNCLAMPED: chain,
}


@pytest.fixture(name="which", params=PROBLEMS)
def _which(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(name="problem")
def _problem(which: str) -> Problem:
    return PROBLEMS[which]()


@pytest.fixture(name="hertz")
def _hertz(which: str) -> Array:
    return HERTZ[1:] if which == UNCLAMPED else HERTZ


def condensed(problem: Problem) -> tuple[CondensedStructure, Array]:
    _, selection = problem.interface.relative_motion()
    return condense(problem, selection), selection


def direct(
    problem: Problem,
    variable: complex,
    force: Array | ComplexArray,
    relative: Array | ComplexArray,
) -> tuple[ComplexArray, ComplexArray]:
    """Return u and the contact force that keeps the relative motion, both (n, …).

    Solves D u + Lᵀ φ = f with L u = y for u and φ at once.
    """
    structure, (_, selection) = problem.structure, problem.interface.relative_motion()
    dynamic = (
        structure.stiffness
        + variable * structure.damping
        + variable**2 * structure.mass
    )
    size = len(dynamic)
    # The unknown φ in units of a stiffness keeps the saddle matrix well scaled.
    unit = np.abs(dynamic).max() + 1.0
    corner = np.zeros((len(selection), len(selection)))
    saddle = np.block([[dynamic, unit * selection.T], [unit * selection, corner]])
    solved = np.linalg.solve(saddle, np.concatenate([force, unit * relative]))
    return solved[:size], unit * solved[size:]


def random_complex(*shape: int) -> ComplexArray:
    rng = np.random.default_rng(3)
    return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)


def relative_error(value: ComplexArray, exact: ComplexArray) -> float:
    return float(
        np.abs(value - exact).max(initial=0.0) / np.abs(exact).max(initial=1e-9)
    )


def test_dynamic_stiffness_is_that_of_the_full_matrices(
    problem: Problem, hertz: Array
) -> None:
    structure, selection = condensed(problem)
    variable = 2j * np.pi * hertz

    stiffness = structure.dynamic_stiffness(variable)

    for value, s in zip(stiffness, variable, strict=True):
        still = np.zeros((problem.structure.dofs, len(selection)))
        _, holding = direct(problem, s, still, np.eye(len(selection)))
        assert relative_error(value, -holding) < 5e-10  # measured 5e-11


def test_load_is_what_holds_the_contacts_in_place(
    problem: Problem, hertz: Array
) -> None:
    structure, selection = condensed(problem)
    variable = 2j * np.pi * hertz
    force = random_complex(len(hertz), problem.structure.dofs)

    load, _ = structure.loading(force)(variable)

    for value, s, pushed in zip(load, variable, force, strict=True):
        _, holding = direct(problem, s, pushed, np.zeros(len(selection)))
        assert relative_error(value, holding) < 1e-8  # measured 7e-10


def test_motion_is_that_of_the_full_matrices(problem: Problem, hertz: Array) -> None:
    structure, selection = condensed(problem)
    variable = 2j * np.pi * hertz
    force = random_complex(len(hertz), problem.structure.dofs)
    relative = 1e-4 * random_complex(len(hertz), len(selection))

    motion = structure.motion(variable, relative, force)

    for value, s, pushed, moved in zip(motion, variable, force, relative, strict=True):
        exact, _ = direct(problem, s, pushed, moved)
        assert relative_error(value, exact) < 2e-8  # measured 2e-9
        assert relative_error(selection @ value, moved) < 1e-12  # measured 6e-14


def test_slopes_are_those_of_differences_on_a_small_circle(problem: Problem) -> None:
    structure, _ = condensed(problem)
    middles = 2j * np.pi * HERTZ[1:]
    force = random_complex(problem.structure.dofs)
    # A mean over a circle differentiates an analytic function with an error of
    # (radius / distance of the nearest pole)¹²; measured 2e-10.
    turns = np.exp(2j * np.pi * np.arange(12) / 12)
    radius = 3.0

    for middle in middles:
        near = middle + radius * turns
        stiffness = structure.dynamic_stiffness(near)
        load, _ = structure.loading(np.tile(force, (12, 1)))(near)
        rank = len(structure.stiffness)
        units = np.eye(rank, dtype=complex)
        stiffness_slope = structure.slope(np.full(rank, middle), units).T
        _, load_slope = structure.loading(force[None])(middle[None])

        expected = np.tensordot(1.0 / turns, stiffness, 1) / (12 * radius)
        unit = np.abs(stiffness / near[:, None, None]).max(initial=0.0)
        np.testing.assert_allclose(stiffness_slope, expected, rtol=0, atol=2e-9 * unit)
        expected = np.tensordot(1.0 / turns, load, 1) / (12 * radius)
        unit = np.abs(load / near[:, None]).max(initial=0.0)
        np.testing.assert_allclose(load_slope[0], expected, rtol=0, atol=2e-9 * unit)


def test_what_nothing_holds_answers_loads_alone() -> None:
    problem = chain()
    structure, _ = condensed(problem)
    unheld = structure.unheld[:, 0]

    # all of it moves alike, as one mass of 5 kg, and neither friction nor springs do
    assert structure.unheld.shape == (4, 1)
    np.testing.assert_allclose(np.abs(unheld), 1.0 / np.sqrt(5.0), rtol=1e-12)
    rows = np.zeros((1, len(structure.stiffness)), complex)
    moved = structure.motion(np.array([2j]), rows, np.ones((1, 4), complex))
    centre = float((np.array(MASSES) @ moved[0]).real) / 5.0
    assert centre == pytest.approx(4.0 / (5.0 * 2j**2).real)


def test_a_mean_load_moves_nothing_that_nothing_holds() -> None:
    structure, _ = condensed(chain())
    force = np.ones((1, 4), complex)
    rows = np.zeros((1, len(structure.stiffness)), complex)

    mean = structure.motion(np.zeros(1, complex), rows, force)

    assert np.abs(np.array(MASSES) @ mean[0]) < 1e-15


def test_damping_of_what_nothing_holds_is_refused() -> None:
    problem = chain()
    dragging = np.diag([1e-3, 0.0, 0.0, 0.0])
    dragged = dataclasses.replace(
        problem.structure, damping=problem.structure.damping + dragging
    )

    text = (
        r"^the structure can move freely while all contacts stick, and is damped in "
        r"doing so: hold it by a spring, a soft one perhaps, or do not damp that$"
    )
    with pytest.raises(ValueError, match=text):
        condensed(dataclasses.replace(problem, structure=dragged))


def test_a_stiffness_that_drives_away_is_refused() -> None:
    problem = chain()
    driven = problem.structure.stiffness - 0.1 * np.diag(MASSES)
    structure = dataclasses.replace(problem.structure, stiffness=driven)

    with pytest.raises(ValueError, match=r"^the stiffness of the structure drives it"):
        condensed(dataclasses.replace(problem, structure=structure))


def test_a_critically_damped_mode_is_refused() -> None:
    # In these numbers nothing is rounded, so that the poles coincide to the last bit.
    critical = oscillator(mass=1.0, damping=2.0, stiffness=1.0)

    text = (
        r"^two poles of the structure coincide \(a critically damped mode\): "
        r"change its damping slightly$"
    )
    with pytest.raises(ValueError, match=text):
        condensed(critical)
