"""Structure: what it refuses, and the texts."""

import re

import numpy as np
import pytest
import scipy.sparse
from scipy.sparse.linalg import LinearOperator, aslinearoperator

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.structures.structure import MATRICES, Structure

NAMES = ("a", "b")


def structure(**matrices: Matrix) -> Structure:
    sound: dict[str, Matrix] = {
        name: np.array([[2.0, -1.0], [-1.0, 3.0]]) for name in MATRICES
    }
    mass, damping, stiffness = ((sound | matrices)[name] for name in MATRICES)
    return Structure(mass, damping, stiffness, NAMES)


def test_structure_counts_its_degrees_of_freedom() -> None:
    sound = structure()

    assert sound.dofs == 2


def test_singular_stiffness_and_no_damping_are_accepted() -> None:
    loose = structure(stiffness=np.zeros((2, 2)), damping=np.zeros((2, 2)))

    assert loose.dofs == 2


def test_a_mass_that_rounding_takes_is_refused_but_not_for_a_vanishing_spring() -> None:
    light = np.diag([1e-17, 1.0])

    with pytest.raises(ValueError, match="mass of a is 1e-17 beside 1 of b"):
        structure(mass=light, stiffness=np.eye(2))
    vanishing = structure(mass=np.diag([1e-6, 1e-2]), stiffness=np.diag([1e9, 1e-7]))

    assert vanishing.dofs == 2


@pytest.mark.parametrize("name", MATRICES)
def test_matrix_of_another_shape_is_refused(name: str) -> None:
    message = (
        f"{name} has shape (3, 2), but there are 2 names of degrees of freedom: "
        "give (2, 2)"
    )

    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        structure(**{name: np.zeros((3, 2))})


@pytest.mark.parametrize("name", MATRICES)
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_matrix_with_a_value_that_is_not_finite_is_refused(
    name: str, value: float
) -> None:
    matrix = np.array([[1.0, value], [value, 1.0]])

    with pytest.raises(ValueError, match=f"^{name} holds a value that is not finite$"):
        structure(**{name: matrix})


@pytest.mark.parametrize("sparse", [False, True])
@pytest.mark.parametrize(
    ("name", "size", "text"),
    [
        *(
            (each, 1e60, "holds a value of 1e+60: give at most 1e+50")
            for each in MATRICES
        ),
        ("mass", 1e-200, "holds nothing above 1e-200: give at least 1e-50"),
        ("stiffness", 1e-200, "holds nothing above 1e-200: give at least 1e-50"),
    ],
)
def test_matrix_whose_squares_leave_the_numbers_is_refused(
    name: str, size: float, text: str, *, sparse: bool
) -> None:
    kind = scipy.sparse.csc_array if sparse else np.array
    matrices = {each: kind(np.eye(2)) for each in MATRICES}
    matrices[name] = kind(size * np.eye(2))

    with pytest.raises(ValueError, match=f"^{name} {re.escape(text)}"):
        structure(**matrices)


@pytest.mark.parametrize("sparse", [False, True])
def test_mass_that_rounding_takes_for_nothing_is_refused(*, sparse: bool) -> None:
    kind = scipy.sparse.csc_array if sparse else np.array
    matrices = {each: kind(np.eye(2)) for each in MATRICES}
    matrices["mass"] = kind(np.diag([3.0, 1e-16]))

    with pytest.raises(ValueError, match=r"^mass of b is 1e-16 beside 3 of a, "):
        structure(**matrices)


@pytest.mark.parametrize("held", [1e-12, 0.0, -1.0])
def test_small_inertia_that_is_held_as_softly_or_not_at_all_is_none(
    held: float,
) -> None:
    # of a rotation, in other units, or of what contacts alone hold
    made = structure(mass=np.diag([3.0, 1e-16]), stiffness=np.diag([1.0, held]))

    assert made.dofs == 2


@pytest.mark.parametrize("name", MATRICES)
def test_asymmetric_matrix_is_refused(name: str) -> None:
    matrix = np.array([[1.0, 2e-9], [0.0, 1.0]])

    told = "2e-09 of a by b but 0 of b by a: only symmetric is supported"
    if name == "damping":
        told += ", beside a skew-symmetric gyroscopic matrix"
    with pytest.raises(ValueError, match=f"^{name} is not symmetric: {told}$"):
        structure(**{name: matrix})


@pytest.mark.parametrize("name", MATRICES)
def test_asymmetry_of_rounding_is_accepted(name: str) -> None:
    matrix = np.array([[1.0, 1e-12], [0.0, 1.0]])

    accepted = structure(**{name: matrix})

    assert getattr(accepted, name) is matrix


@pytest.mark.parametrize(
    "mass", [np.diag([1.0, 0.0]), np.diag([1.0, -1.0]), np.ones((2, 2)) - np.eye(2)]
)
def test_massless_motion_is_refused(mass: Array) -> None:
    message = (
        "mass is not positive definite: some motion has no mass; "
        "lock it or give it mass"
    )

    with pytest.raises(ValueError, match=f"^{message}$"):
        structure(mass=mass)


def sparse_structure(**matrices: Matrix) -> Structure:
    sound: dict[str, Matrix] = {
        name: np.array([[2.0, -1.0], [-1.0, 3.0]]) for name in MATRICES
    }
    made = {name: scipy.sparse.csr_array(each) for name, each in sound.items()}
    mass, damping, stiffness = ((made | matrices)[name] for name in MATRICES)
    return Structure(mass, damping, stiffness, NAMES)


def test_sparse_matrices_are_kept_as_they_are() -> None:
    stiffness = scipy.sparse.coo_array((2, 2))

    sound = sparse_structure(stiffness=stiffness)

    assert sound.sparse
    assert sound.stiffness is stiffness
    assert not structure().sparse


@pytest.mark.parametrize("name", MATRICES)
@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.zeros((3, 2)), "has shape (3, 2), but there are 2 names of degrees of"),
        (np.array([[1.0, np.nan], [np.nan, 1.0]]), "holds a value that is not finite"),
        (np.array([[1.0, 2e-9], [0.0, 1.0]]), "is not symmetric: 2e-09 of a by b but"),
    ],
)
def test_sparse_matrices_are_refused_for_the_same_reasons(
    name: str, values: Array, message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{name} {re.escape(message)}"):
        sparse_structure(**{name: scipy.sparse.csc_array(values)})


@pytest.mark.parametrize(
    "mass", [np.diag([1.0, 0.0]), np.diag([1.0, -1.0]), np.ones((2, 2)) - np.eye(2)]
)
def test_massless_motion_of_a_sparse_structure_is_refused(mass: Array) -> None:
    with pytest.raises(ValueError, match=r"^mass is not positive definite: "):
        sparse_structure(mass=scipy.sparse.csc_array(mass))


def test_sparse_and_dense_matrices_are_not_mixed() -> None:
    text = "some matrices are sparse, others not: give three alike"

    with pytest.raises(ValueError, match=f"^{text}$"):
        sparse_structure(damping=np.eye(2))


def test_only_a_dense_structure_passes_for_one() -> None:
    text = "the structure is sparse, .* in a scene by .structure.reduction., in Python"
    plain = structure()

    assert plain.dense is plain
    with pytest.raises(ValueError, match=f"^{text}"):
        _ = sparse_structure().dense


def operator(*rows: float) -> LinearOperator:
    return aslinearoperator(np.reshape(rows, (2, -1)))


def test_damping_beside_sparse_matrices_may_be_an_operator() -> None:
    sound = sparse_structure(damping=operator(2.0, -1.0, -1.0, 3.0))

    assert sound.sparse


@pytest.mark.parametrize(
    ("damping", "message"),
    [
        (operator(1.0, 2.0, 0.0, 1.0), "damping is not symmetric: only symmetric is"),
        (operator(1.0, np.nan, 0.0, 1.0), "damping holds a value that is not finite"),
        (
            operator(1.0, 0.0, 0.0, 0.0, 1.0, 0.0),
            "damping has shape (2, 3), but there are 2 names",
        ),
    ],
)
def test_an_operator_that_is_no_damping_is_refused(
    damping: LinearOperator, message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        sparse_structure(damping=damping)
