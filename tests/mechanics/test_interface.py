"""Interface: independent coordinates of the relative motion, and the texts."""

import re

import numpy as np
import pytest

from contact_tables import contact_points
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from rigs import rig_problem


def hexagon(rank: int) -> Interface:
    """Return six points whose 18 relative displacements have the given rank."""
    random = np.random.default_rng(rank)
    rows = random.normal(size=(18, rank)) @ random.normal(size=(rank, 20))
    names = tuple(f"point-{k}" for k in range(6))
    return Interface(contact_points(6), rows, names)


def check(interface: Interface, basis: Array, selection: Array) -> None:
    """Assert that the basis is orthonormal and that both maps make up the motion."""
    rank = basis.shape[1]
    largest = np.abs(interface.displacement).max()
    np.testing.assert_allclose(basis.T @ basis, np.eye(rank), rtol=0.0, atol=3e-14)
    np.testing.assert_allclose(
        basis @ selection, interface.displacement, rtol=0.0, atol=3e-14 * largest
    )
    assert selection.shape == (rank, interface.displacement.shape[1])


@pytest.mark.parametrize(
    ("model", "rank"), [("full", 12), ("B", 6), ("A", 6)]
)  # fmt: skip
@pytest.mark.parametrize("fan", ["0 deg", "6 deg"])
def test_each_face_of_the_rig_moves_in_six_ways_or_three(
    model: str, rank: int, fan: str
) -> None:
    interface = rig_problem(model=model, blade__fan=fan).interface

    basis, selection = interface.relative_motion()

    assert basis.shape == (3 * interface.count, rank)
    check(interface, basis, selection)


@pytest.mark.parametrize("rank", [1, 5, 11, 18])
def test_coordinates_are_as_many_as_the_points_move_independently(rank: int) -> None:
    interface = hexagon(rank)

    basis, selection = interface.relative_motion()

    assert basis.shape == (18, rank)
    check(interface, basis, selection)


def test_points_that_move_independently_are_their_own_coordinates() -> None:
    interface = rig_problem(model="B").interface

    basis, selection = interface.relative_motion()

    np.testing.assert_array_equal(basis, np.eye(6))
    np.testing.assert_array_equal(selection, interface.displacement)


def test_motions_in_the_plane_of_symmetry_and_across_it_stay_apart() -> None:
    problem = rig_problem()
    across = [name[-2:] in ("uz", "rx", "ry") for name in problem.structure.names]

    _, selection = problem.interface.relative_motion()

    moved = np.abs(selection)
    in_plane = np.all(moved[:, across] <= 2e-15, axis=1)
    out_of_plane = np.all(moved[:, np.invert(across)] <= 2e-15, axis=1)
    assert np.all(in_plane != out_of_plane)
    assert int(in_plane.sum()) == int(out_of_plane.sum()) == 6


@pytest.mark.parametrize("factor", [1.0, 5e-6, 1e-8])
def test_columns_with_small_factors_are_tied_all_the_same(factor: float) -> None:
    rows = np.zeros((6, 3))
    rows[0, 0], rows[3, 1], rows[3, 2] = 1.0, factor, -factor
    interface = Interface(contact_points(2), rows, ("a", "b"))

    basis, selection = interface.relative_motion()

    assert basis.shape == (6, 2)
    check(interface, basis, selection)


def test_columns_of_rounding_tie_nothing() -> None:
    rows = np.zeros((6, 4))
    rows[0, :2], rows[3, 1:3] = (1.0, 6e-17), (6e-17, 1.0)
    interface = Interface(contact_points(2), rows, ("a", "b"))

    _, selection = interface.relative_motion()

    assert np.count_nonzero(np.abs(selection) > 1e-15) == 2


def test_work_of_contact_forces_is_the_same_in_both_coordinates() -> None:
    interface = rig_problem().interface
    random = np.random.default_rng(4)
    force, motion = random.normal(size=24), random.normal(size=54)
    basis, selection = interface.relative_motion()

    work = (basis.T @ force) @ (selection @ motion)

    assert work == pytest.approx(
        force @ interface.displacement @ motion, rel=1e-12, abs=0.0
    )


def test_without_points_there_are_no_coordinates() -> None:
    empty = Interface(contact_points(0), np.zeros((0, 5)), ())

    basis, selection = empty.relative_motion()

    assert empty.count == 0
    assert basis.shape == (0, 0)
    assert selection.shape == (0, 5)


@pytest.mark.parametrize("shape", [(5, 8), (9, 8), (6,)])
def test_map_without_three_rows_for_each_point_is_refused(
    shape: tuple[int, ...],
) -> None:
    message = (
        f"displacement has shape {shape}, but 2 points need 6 rows: "
        "normal and two tangents for each"
    )

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        Interface(contact_points(2), np.zeros(shape), ("a", "b"))


@pytest.mark.parametrize("field", contact_points()._fields)
def test_column_that_does_not_fit_the_points_is_refused(field: str) -> None:
    table = contact_points(2)
    table = table._replace(**{field: getattr(table, field)[:1]})
    message = (
        f"contact parameter {field} has shape (1,), but there are 2 contact points"
    )

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        Interface(table, np.zeros((6, 8)), ("a", "b"))
