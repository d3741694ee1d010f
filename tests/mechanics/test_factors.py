"""Sparse factors: definite or not, solutions, the root."""

import numpy as np
import pytest
import scipy.sparse

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.factors import factors, indefinite_factors


def random_symmetric(seed: int, shift: float) -> Array:
    random = np.random.default_rng(seed)
    rows = random.normal(size=(30, 30)) * (random.uniform(size=(30, 30)) < 0.1)
    return rows + rows.T + shift * np.eye(30)


@pytest.mark.parametrize("shift", np.linspace(0.0, 8.0, 9))
@pytest.mark.parametrize("seed", range(5))
def test_definite_is_what_has_positive_eigenvalues(seed: int, shift: float) -> None:
    matrix = random_symmetric(seed, shift)

    found = factors(scipy.sparse.csr_array(matrix))

    assert (found is not None) == (np.linalg.eigvalsh(matrix)[0] > 0.0)


@pytest.mark.parametrize(
    "matrix", [[[0.0, 1.0], [1.0, 0.0]], [[1.0, 1.0], [1.0, 1.0]], [[1, 2], [2, 1]]]
)
def test_semidefinite_and_indefinite_matrices_are_told(matrix: list[float]) -> None:
    assert factors(scipy.sparse.csc_array(np.array(matrix, dtype=float))) is None


def test_signs_of_pivots_are_those_of_eigenvalues() -> None:
    matrix = random_symmetric(1, 1.5)

    found = indefinite_factors(scipy.sparse.csc_array(matrix))

    assert found is not None
    negative = int((np.linalg.eigvalsh(matrix) < 0.0).sum())
    assert negative > 0
    assert (found.pivots < 0.0).sum() == negative


def test_solution_and_root_are_those_of_the_matrix() -> None:
    matrix = random_symmetric(2, 9.0)
    columns = np.random.default_rng(3).normal(size=(30, 4))

    found = factors(scipy.sparse.csc_array(matrix))

    assert found is not None
    np.testing.assert_allclose(matrix @ found.solve(columns), columns, atol=1e-13)
    root = found.root(columns)
    np.testing.assert_allclose(root.T @ root, columns.T @ matrix @ columns, rtol=1e-12)
