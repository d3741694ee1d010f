"""Matrices in files that are damaged, of something else, or no structure's."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip.matrices.read import MatrixFiles, read_structure
from microslip.matrices.source import MatrixSource

MASS = np.diag([2.0, 3.0, 4.0, 5.0])
STIFFNESS = np.diag([7.0, 6.0, 5.0, 9.0]) - np.eye(4, k=1) - np.eye(4, k=-1)


def sparse_archive(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.npz"
    scipy.sparse.save_npz(path, scipy.sparse.csc_array(matrix))
    return MatrixSource(path)


def test_matlab_7_3_is_refused_with_the_way_out(tmp_path: Path) -> None:
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8)
    (tmp_path / "a.mat").write_bytes(head + b"\x00\x02IM" + bytes(384))

    with pytest.raises(MatrixFileError, match=r"version 7\.3: save it with save\("):
        MatrixSource(tmp_path / "a.mat").read(("K",))


@pytest.mark.parametrize("name", ["a.mat", "a.npz"])
@pytest.mark.parametrize("times", [0, 1, 20])
def test_a_file_of_something_else_is_refused(
    name: str, times: int, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(b"some text that is no archive" * times)

    with pytest.raises(MatrixFileError, match="is no sound"):
        MatrixSource(tmp_path / name).read(("K",))


def test_objects_in_an_archive_are_not_unpickled(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", K=np.array([{}, {}], dtype=object))

    with pytest.raises(MatrixFileError, match="is no sound archive of numbers"):
        MatrixSource(tmp_path / "a.npz").read(("K",))


def test_what_is_not_asked_for_in_an_archive_may_be_anything(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", K=MASS, notes=np.array([{}, "text"], dtype=object))

    read = MatrixSource(tmp_path / "a.npz").read(("K",))

    np.testing.assert_array_equal(read.matrix.toarray(), MASS)


def test_a_folder_in_place_of_a_matrix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MatrixFileError, match=r"has no ending: give \.mtx"):
        MatrixSource(tmp_path).read(("K",))


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"A": MASS, "B": MASS}, "holds no matrix K but A, B: write a.npz:NAME"),
        ({"K": MASS[0]}, "K has 1 axes of float64: give a matrix of real numbers"),
        ({"K": 1j * MASS}, "K has 2 axes of complex128: give a matrix of real numbers"),
        (
            {"K": MASS, "names": ("a", "b")},
            "2 names, but 4 rows: give one name for each row",
        ),
        (
            {"K": np.eye(2) > 0.0},
            "K has 2 axes of bool: give a matrix of real numbers",
        ),
    ],
)
def test_an_archive_without_the_matrix_is_refused(
    arrays: dict[str, Any], message: str, tmp_path: Path
) -> None:
    np.savez(tmp_path / "a.npz", **arrays)

    with pytest.raises(MatrixFileError, match=f"a.npz: {re.escape(message)}$"):
        MatrixSource(tmp_path / "a.npz").read(("K",))


@pytest.mark.parametrize(
    ("stiffness", "mass", "message"),
    [
        (STIFFNESS, MASS[:3, :3], "mass has 3 rows, but the stiffness 4: give"),
        (STIFFNESS + np.triu(STIFFNESS, 1), MASS, "stiffness.npz: stiffness is not sy"),
        (STIFFNESS, 0.0 * MASS, "mass.npz: mass is not positive definite"),
        (1e40 * STIFFNESS, MASS, "all degrees of freedom are held, by 1e"),
        (STIFFNESS, 1e60 * MASS, r"mass holds a value of 5e\+60"),
    ],
)
def test_matrices_that_are_no_structure_are_refused(
    stiffness: np.ndarray, mass: np.ndarray, message: str, tmp_path: Path
) -> None:
    files = MatrixFiles(
        sparse_archive(tmp_path, "stiffness", stiffness),
        sparse_archive(tmp_path, "mass", mass),
    )

    with pytest.raises(MatrixFileError, match=message):
        read_structure(files)


def test_a_mass_of_another_model_is_refused(tmp_path: Path) -> None:
    (tmp_path / "k.mtx").write_text("1,1,1,1,5.0\n")
    (tmp_path / "m.mtx").write_text("2,1,2,1,5.0\n")
    files = MatrixFiles(
        MatrixSource(tmp_path / "k.mtx"), MatrixSource(tmp_path / "m.mtx")
    )

    with pytest.raises(MatrixFileError, match=r"m.mtx: degree of freedom 2\.x is not"):
        read_structure(files)


@pytest.mark.parametrize("value", [np.nan, np.inf, 1j])
@pytest.mark.parametrize("sparse", [False, True])
def test_a_matrix_of_no_finite_real_numbers_is_refused(
    value: complex, sparse: bool, tmp_path: Path
) -> None:
    wrong = STIFFNESS.astype(complex if value == 1j else float)
    wrong[0, 0] = value
    path = tmp_path / "stiffness.npz"
    if sparse:
        scipy.sparse.save_npz(path, scipy.sparse.csc_array(wrong))
    else:
        np.savez(path, K=wrong)

    with pytest.raises(MatrixFileError, match=r"not finite|matrix of real numbers"):
        read_structure(MatrixFiles(MatrixSource(path), MatrixSource(path)))


def test_archives_that_are_none_are_refused(tmp_path: Path) -> None:
    single, broken = tmp_path / "one.npz", tmp_path / "broken.npz"
    with single.open("wb") as file:
        np.save(file, STIFFNESS)
    np.savez(broken, format=b"csc", shape=(4, 4), data=np.ones(4))

    for path, cause in (
        (single, "is no sound archive: write it by numpy.savez"),
        (broken, "sparse matrix"),
    ):
        with pytest.raises(MatrixFileError, match=cause):
            read_structure(MatrixFiles(MatrixSource(path), MatrixSource(path)))
