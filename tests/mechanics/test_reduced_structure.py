"""Craig–Bampton and modal reduction: limits, convergence, and the measured error."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse
from numpy.typing import NDArray

from hbm.structure.poles import poles
from microslip_mechanics.reduction.reduced_structure import (
    ReducedStructure,
    craig_bampton,
    modal_truncation,
)
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import MOTIONS, Beam, Frame, Node
from microslip_mechanics.structures.rotating_frame import RotatingFrame
from microslip_mechanics.structures.rotation import Rotation
from microslip_mechanics.structures.selection import selected
from microslip_mechanics.structures.structure import MATRICES, Structure
from small_problems import cantilever
from sparse_problems import dense, net

Places = NDArray[np.int64]
Reduce = Callable[[Structure, Places, float], ReducedStructure]
BOTH = pytest.mark.parametrize("reduce", [craig_bampton, modal_truncation])


def beam() -> tuple[Structure, Places]:
    structure = cantilever(elements=8).structure
    return structure, selected(structure.names, ["4.uz", "8"])


@BOTH
def test_all_modes_together_are_the_structure(reduce: Reduce) -> None:
    structure, interface = beam()

    found = reduce(structure, interface, 1e9)

    squares, wanted = (
        scipy.linalg.eigvalsh(each.stiffness, each.mass)
        for each in (found.structure, structure)
    )
    np.testing.assert_allclose(squares, wanted, rtol=1e-7)
    assert found.error(200.0) < 1e-8


@BOTH
def test_static_responses_to_loads_on_the_interface_need_no_modes(
    reduce: Reduce,
) -> None:
    structure, interface = beam()
    load = np.zeros(structure.dofs)
    load[interface] = np.linspace(-1.0, 2.0, interface.size)

    found = reduce(structure, interface, 0.0)

    small = np.linalg.solve(found.structure.stiffness, found.rows(load))
    wanted = np.linalg.solve(structure.stiffness, load)
    np.testing.assert_allclose(
        found.shapes @ small, wanted, rtol=0, atol=1e-9 * np.abs(wanted).max()
    )


@BOTH
def test_the_error_is_that_of_a_direct_solution_and_falls_with_the_modes(
    reduce: Reduce,
) -> None:
    structure, interface = beam()
    frequency = 1200.0
    dynamic = structure.stiffness - frequency**2 * structure.mass
    exact = np.linalg.inv(dynamic)[np.ix_(interface, interface)]
    scale = np.sqrt(np.abs(np.diag(np.linalg.inv(exact))))

    errors = []
    for highest in (1500.0, 6000.0, 24000.0):
        found = reduce(structure, interface, highest)
        small = found.structure.stiffness - frequency**2 * found.structure.mass
        seen = found.shapes[interface]
        moved = seen @ np.linalg.solve(small, seen.T)
        motion = (
            np.outer(scale, scale) * (moved - exact),
            np.outer(scale, scale) * exact,
        )
        stiffness = (
            (np.linalg.inv(moved) - np.linalg.inv(exact)) / np.outer(scale, scale),
            np.linalg.inv(exact) / np.outer(scale, scale),
        )
        known = max(
            np.linalg.norm(change, 2) / np.linalg.norm(whole, 2)
            for change, whole in (motion, stiffness)
        )
        assert found.error(frequency) == pytest.approx(known, rel=1e-3, abs=1e-12)
        errors.append(found.error(frequency))

    assert errors[0] < 0.1
    assert errors[1] < 0.25 * errors[0]
    assert errors[2] < 0.25 * errors[1]


@BOTH
def test_a_sparse_structure_is_reduced_like_a_dense_one(reduce: Reduce) -> None:
    problem = net(21, 22)
    interface = np.array([30, 250])

    found = reduce(problem.structure, interface, 1200.0)
    wanted = reduce(dense(problem).structure, interface, 1200.0)

    assert found.structure.dofs == wanted.structure.dofs < 60
    squares, others = (
        scipy.linalg.eigvalsh(each.structure.stiffness, each.structure.mass)
        for each in (found, wanted)
    )
    np.testing.assert_allclose(squares, others, rtol=1e-8)
    assert found.error(300.0) == pytest.approx(wanted.error(300.0), rel=1e-3)


def test_craig_bampton_keeps_the_names_and_motions_of_its_interface() -> None:
    structure, interface = beam()

    found = craig_bampton(structure, interface, 3000.0)

    count = interface.size
    names = [structure.names[place] for place in interface]
    assert found.structure.names[: count + 1] == (*names, "fixed mode 1")
    np.testing.assert_allclose(found.shapes[interface, :count], np.eye(count))
    np.testing.assert_allclose(found.shapes[interface, count:], 0.0, atol=1e-12)


def test_damping_is_that_of_the_shapes() -> None:
    structure, interface = beam()

    found = craig_bampton(structure, interface, 3000.0)

    wanted = found.shapes.T @ structure.damping @ found.shapes
    np.testing.assert_allclose(
        found.structure.damping, wanted, atol=1e-12 * np.abs(wanted).max()
    )


def test_an_error_at_a_natural_frequency_is_refused() -> None:
    problem = net(1, 1)
    exact = float(np.sqrt(problem.structure.stiffness.toarray()[0, 0] / 50.0))
    found = modal_truncation(problem.structure, np.array([0]), 1e4)

    assert exact == pytest.approx(np.sqrt(4e6 / 50.0))
    with pytest.raises(ValueError, match="is a natural frequency of the structure"):
        found.error(exact)


def rotating_shaft() -> Structure:
    """Return a beam in axes that turn about it, with Coriolis terms."""
    square = RectangularSection(0.01, 0.01, 2.1e11, 0.3, 7800.0)
    nodes = tuple(
        Node(f"{k}", np.array([0.1 * k, 0.0, 0.0]), MOTIONS if k else ())
        for k in range(6)
    )
    beams = tuple(
        Beam(f"{k}", f"{k + 1}", square, np.array([0.0, 0.0, 1.0]), 3.0)
        for k in range(5)
    )
    spin = Rotation(40.0, np.array([1.0, 0.0, 0.0]), np.zeros(3))
    return RotatingFrame(Frame(nodes, beams), spin).structure()


def test_coriolis_terms_stay_in_a_reduced_structure() -> None:
    structure = rotating_shaft()
    interface = selected(structure.names, ["5"])

    found = craig_bampton(structure, interface, 1e9).structure

    assert found.gyroscopic
    assert np.abs(found.damping - found.damping.T).max() > 1.0
    exact, kept = (
        np.sort(np.abs(poles(each).values))[:6] for each in (structure, found)
    )
    np.testing.assert_allclose(kept, exact, rtol=1e-8)


def test_a_sparse_structure_with_coriolis_terms_is_to_be_reduced_first() -> None:
    shaft, problem = rotating_shaft(), cantilever(elements=5)
    mass, damping, stiffness = (
        scipy.sparse.csc_array(getattr(shaft, name)) for name in MATRICES
    )
    turning = Structure(mass, damping, stiffness, shaft.names, gyroscopic=True)

    with pytest.raises(
        ValueError, match=r"gyroscopic forces: .* by microslip\.reduced_problem"
    ):
        reduced(dataclasses.replace(problem, structure=turning), 1e3)


def test_a_skew_part_must_be_meant() -> None:
    shaft = rotating_shaft()

    with pytest.raises(ValueError, match=r"^damping is not symmetric"):
        Structure(shaft.mass, shaft.damping, shaft.stiffness, shaft.names)


def test_the_error_sees_what_is_soft_among_what_is_stiff() -> None:
    # three faces of a tip on springs a million times as stiff as what carries it
    faces, count = 3, 8
    stiffness = np.zeros((count, count))
    for place in range(count - 1):
        spring = 1e9 if place < faces - 1 else 1e3
        stiffness[place : place + 2, place : place + 2] += spring * np.array(
            [[1.0, -1.0], [-1.0, 1.0]]
        )
    stiffness[-1, -1] += 1e3
    names = tuple(f"x{place}" for place in range(count))
    structure = Structure(np.eye(count), np.zeros((count, count)), stiffness, names)
    interface = np.arange(faces)

    found = craig_bampton(structure, interface, 1.0)  # no modes
    frequency = 7.0

    dynamic = structure.stiffness - frequency**2 * structure.mass
    small = found.structure.stiffness - frequency**2 * found.structure.mass
    true = np.linalg.inv(dynamic)[0, 0]
    made = (found.shapes @ np.linalg.inv(small) @ found.shapes.T)[0, 0]
    assert found.error(frequency) == pytest.approx(abs(made / true - 1.0), rel=0.1)
    assert abs(made / true - 1.0) > 1e-3
