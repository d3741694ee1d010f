"""Reduction of sparse problems: nothing lost with all modes, statics with none."""

import re
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

from contact_tables import contact_points
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.reduction.reduced_structure import craig_bampton
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures import stuck_modes
from microslip_mechanics.structures.beam import RectangularSection, beam_matrices
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.stuck import stuck_structure
from rigs import rig_problem
from sparse_problems import dense, net, sparse


@pytest.mark.parametrize("model", ["A", "full"])
def test_all_modes_together_are_the_structure(model: str) -> None:
    problem = rig_problem(model=model)

    small = reduced(sparse(problem), 1e9).problem

    assert small.structure.dofs == problem.structure.dofs
    squares, expected = (
        scipy.linalg.eigvalsh(each.structure.stiffness, each.structure.mass)
        for each in (small, problem)
    )
    np.testing.assert_allclose(
        squares, expected, rtol=1e-10, atol=1e-13 * expected.max()
    )


@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_static_equilibrium_needs_no_modes(model: str) -> None:
    problem = rig_problem(model=model)

    rest, expected = static_equilibrium(sparse(problem)), static_equilibrium(problem)

    size = np.abs(expected.displacement).max()
    np.testing.assert_allclose(
        rest.displacement, expected.displacement, rtol=0, atol=1e-9 * size
    )
    np.testing.assert_allclose(rest.normal_force, expected.normal_force, rtol=1e-8)


def test_coordinates_of_a_motion_of_the_shapes_give_it_back() -> None:
    reduction = reduced(sparse(rig_problem(model="A")), 3000.0)
    chosen = np.random.default_rng(4).normal(size=reduction.problem.structure.dofs)

    found = reduction.coordinates(reduction.shapes @ chosen)

    np.testing.assert_allclose(found, chosen, rtol=1e-7, atol=1e-7)


def test_loads_and_probes_are_those_of_the_shapes() -> None:
    problem = net(12, 11)
    reduction = reduced(problem, 800.0)
    small, whole = reduction.problem, problem.interface.displacement

    assert small.structure.dofs < problem.structure.dofs // 2
    np.testing.assert_allclose(
        small.interface.displacement, whole @ reduction.shapes, atol=1e-12
    )
    np.testing.assert_array_equal(small.drive, problem.drive @ reduction.shapes)
    np.testing.assert_array_equal(
        small.probes.rows, problem.probes.rows @ reduction.shapes
    )


def test_lanczos_finds_the_modes_of_a_dense_solution() -> None:
    problem = net(23, 22, contacts=2)
    _, selection = problem.interface.relative_motion()
    held = stuck_structure(problem.structure, selection)
    assert held.mass.shape[0] > stuck_modes.SMALL

    modes = stuck_modes.stuck_modes(held, 2500.0)

    squares = scipy.linalg.eigh(
        held.stiffness.toarray(), held.mass.toarray(), eigvals_only=True
    )
    count = int((squares <= 2500.0**2).sum())
    assert 10 < count < 100
    np.testing.assert_allclose(modes.squares, squares[:count], rtol=1e-9)
    assert modes.next == pytest.approx(np.sqrt(squares[count]), rel=1e-9)
    unit = modes.shapes.T @ (held.mass @ modes.shapes)
    np.testing.assert_allclose(unit, np.eye(count), atol=1e-9)


@pytest.mark.parametrize("count", [1, 3])
def test_damping_beside_the_modes_is_that_of_the_fastest_modes(count: int) -> None:
    problem = net(23, 22, contacts=count, mass_damping=30.0, stiffness_damping=1e-5)
    _, selection = problem.interface.relative_motion()
    held = stuck_structure(problem.structure, selection)
    modes = stuck_modes.stuck_modes(held, 2500.0)

    found = stuck_modes.loss_beside(held, modes)

    # a mode has (α + β ω²)/ω²: most for the slowest one left out
    assert found == pytest.approx(30.0 / modes.next**2 + 1e-5, rel=2e-3)


@pytest.mark.parametrize(("rows", "cutoff"), [(1, 1.0), (2, 1.0), (5, 1100.0)])
def test_few_degrees_of_freedom_have_damping_beside_the_modes(
    rows: int, cutoff: float
) -> None:
    problem = net(rows, 2, mass_damping=30.0, stiffness_damping=1e-5)
    _, selection = problem.interface.relative_motion()
    held = stuck_structure(problem.structure, selection)
    modes = stuck_modes.stuck_modes(held, cutoff)
    assert modes.squares.size < held.mass.shape[0]

    assert stuck_modes.loss_beside(held, modes) == pytest.approx(
        30.0 / modes.next**2 + 1e-5, rel=1e-9
    )


def test_a_fine_mesh_loses_no_digits() -> None:
    elements, section = 1500, RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
    bent = [2, 4, 8, 10]
    stiffness, mass = (
        assembled(matrix[np.ix_(bent, bent)], elements)
        for matrix in beam_matrices(section, 1.0 / elements)
    )
    names = tuple(map(str, range(2 * elements)))
    structure = Structure(mass, 0.0 * mass, stiffness, names)
    tip = np.eye(1, 2 * elements, 2 * elements - 2)

    found = craig_bampton(structure, np.flatnonzero(tip[0]), 4000.0).structure

    # rounding grows with the fourth power of the elements: 1e-5 without extended sums
    rigidity = section.young_modulus * section.inertia_y
    assert found.stiffness[0, 0] == pytest.approx(3.0 * rigidity, rel=1e-8)
    # a clamped beam with its tip on a pin: tan x = tanh x
    rate = np.sqrt(rigidity / (section.density * section.area))
    pinned = np.sqrt(found.stiffness[1, 1] / found.mass[1, 1])
    assert pinned == pytest.approx(3.926602312047919**2 * rate, rel=1e-8)


def assembled(element: Array, elements: int) -> scipy.sparse.csc_array:
    """Return the matrix of a clamped beam of equal elements, shape (4, 4) each."""
    places = 2 * np.arange(elements)[:, None] + np.arange(4)
    where = (np.repeat(places, 4, axis=1).ravel(), np.tile(places, 4).ravel())
    values = np.tile(element.ravel(), elements)
    return scipy.sparse.csc_array(scipy.sparse.csc_array((values, where))[2:, 2:])


def test_a_mechanism_is_refused() -> None:
    still = scipy.sparse.csc_array((2, 2))
    pair = Problem(
        Structure(scipy.sparse.eye_array(2), still, still, ("left", "right")),
        Interface(contact_points(), np.array([[1.0, -1.0], [0, 0], [0, 0]]), ("gap",)),
        np.array([1.0, -1.0]),
        np.zeros(2),
        Probes(("left",), np.array([[1.0, 0.0]])),
    )

    text = (
        "the structure can move freely while all contacts stick: hold it by a spring, "
        "a soft one perhaps, or give dense matrices"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        reduced(pair, 100.0)


@pytest.mark.parametrize("beyond", [1e-6, 1.0])
def test_a_stiffness_that_drives_away_is_refused(beyond: float) -> None:
    problem = net(9, 8)
    structure = problem.structure
    stuck = stuck_structure(structure, problem.interface.displacement[1:2])
    lowest = scipy.linalg.eigvalsh(stuck.stiffness.toarray(), stuck.mass.toarray())[0]
    driven = structure.stiffness - (1.0 + beyond) * lowest * structure.mass

    text = (
        "the stiffness of the structure drives it away while all contacts stick: it "
        "has a negative eigenvalue; hold that motion by a spring"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        reduced(replace(problem, structure=replace(structure, stiffness=driven)), 100.0)


def test_too_many_modes_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stuck_modes, "MOST", 20)

    text = (
        "the structure has more than 20 modes below 5000 rad/s while its contacts "
        "stick: give a lower highest frequency"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        reduced(net(23, 22), 2500.0)


def test_a_dense_net_and_a_sparse_one_rest_alike() -> None:
    problem = net(9, 8, contacts=3)

    relative = problem.interface.relative_motion()
    other = dense(problem).interface.relative_motion()

    np.testing.assert_array_equal(relative[0], other[0])
    assert static_equilibrium(problem).iterations == 0
