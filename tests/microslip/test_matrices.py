"""Matrices from files: round trips through each format, and what is refused."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip.matrices.read import MatrixFiles, read_structure
from microslip.matrices.source import MatrixSource

MASS = np.diag([2.0, 3.0, 4.0, 5.0])
STIFFNESS = np.array(
    [
        [7.0, -2.0, 0.0, 0.5],
        [-2.0, 6.0, -1.0, 0.0],
        [0.0, -1.0, 5.0, -3.0],
        [0.5, 0.0, -3.0, 9.0],
    ]
)
DAMPING = 0.01 * STIFFNESS
LABELS = ((3, 1), (3, 3), (12, 3), (12, 5))
NAMES = ("3.x", "3.z", "12.z", "12.ry")
Writer = Callable[[Path, str, np.ndarray], MatrixSource]


def halves(matrix: np.ndarray) -> list[tuple[int, int, float]]:
    """Return the entries of the lower half, row by row."""
    rows, columns = np.nonzero(np.tril(matrix))
    return [(int(i), int(j), matrix[i, j]) for i, j in zip(rows, columns, strict=True)]


def market(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.mtx"
    scipy.io.mmwrite(path, scipy.sparse.coo_array(matrix), symmetry="symmetric")
    return MatrixSource(path)


def market_general(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.mtx"
    scipy.io.mmwrite(path, scipy.sparse.coo_array(np.triu(matrix)), symmetry="general")
    return MatrixSource(path)


def matlab(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.mat"
    usual = {"mass": "M", "damping": "C", "stiffness": "K"}[name]
    scipy.io.savemat(path, {usual: scipy.sparse.csc_array(matrix), "note": "text"})
    return MatrixSource(path)


def dense_archive(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.npz"
    np.savez(path, other=np.zeros(3), own=matrix)
    return MatrixSource.of(f"{name}.npz:own", folder)


def sparse_archive(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"{name}.npz"
    scipy.sparse.save_npz(path, scipy.sparse.csr_array(matrix))
    return MatrixSource(path)


def abaqus(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"job_{name}.mtx"
    lines = ["** assembled"]
    for row, column, value in reversed(halves(matrix)):
        first, second = LABELS[row], LABELS[column]
        lines.append(
            f"{first[0]},{first[1]}, {second[0]},{second[1]}, {value:.15e}".replace(
                "e", "D" if row else "e"
            )
        )
    path.write_text("\n".join(lines) + "\n")
    return MatrixSource(path)


def calculix(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / f"job.{'sti' if name == 'stiffness' else 'mas'}"
    lines = [f"{i + 1} {j + 1} {value:.15e}" for j, i, value in halves(matrix)]
    path.write_text("\n".join(lines) + "\n")
    listed = [f"{node}.{direction}" for node, direction in LABELS]
    path.with_suffix(".dof").write_text("\n".join(listed) + "\n")
    return MatrixSource(path)


def nastran(folder: Path, name: str, matrix: np.ndarray) -> MatrixSource:
    path = folder / "job.pch"
    known = path.read_text() if path.exists() else "$ punched\n"
    title = "KAAX" if name == "stiffness" else "MAAX"
    lines = [f"DMIG    {title:8s}{0:8d}{6:8d}{2:8d}{0:8d}{'':8s}{4:8d}"]
    for column, (node, way) in enumerate(LABELS):
        lines.append(f"DMIG*   {title:16s}{node:16d}{way:16d}")
        for row, place, value in halves(matrix):
            if place == column:
                number = f"{value:.9E}".replace("E", "D")
                lines.append(
                    f"*       {LABELS[row][0]:16d}{LABELS[row][1]:16d}{number:>16s}"
                )
    path.write_text(known + "\n".join(lines) + "\n")
    return MatrixSource(path)


@pytest.mark.parametrize(
    ("write", "names"),
    [
        (market, ("1", "2", "3", "4")),
        (market_general, ("1", "2", "3", "4")),
        (matlab, ("1", "2", "3", "4")),
        (dense_archive, ("1", "2", "3", "4")),
        (sparse_archive, ("1", "2", "3", "4")),
        (abaqus, NAMES),
        (calculix, NAMES),
        (nastran, NAMES),
    ],
)
def test_matrices_come_back_from_each_format(
    write: Writer, names: tuple[str, ...], tmp_path: Path
) -> None:
    files = MatrixFiles(
        write(tmp_path, "stiffness", STIFFNESS), write(tmp_path, "mass", MASS)
    )

    found = read_structure(files)

    assert found.sparse
    assert found.names == names
    np.testing.assert_allclose(found.stiffness.toarray(), STIFFNESS, rtol=1e-14)
    np.testing.assert_allclose(found.mass.toarray(), MASS, rtol=1e-14)
    assert found.damping.nnz == 0


def test_formats_go_together(tmp_path: Path) -> None:
    files = MatrixFiles(
        market(tmp_path, "stiffness", STIFFNESS),
        matlab(tmp_path, "mass", MASS),
        sparse_archive(tmp_path, "damping", DAMPING),
    )

    found = read_structure(files)

    np.testing.assert_allclose(found.damping.toarray(), DAMPING, rtol=1e-15)


def test_names_in_an_archive_are_those_of_the_structure(tmp_path: Path) -> None:
    np.savez(tmp_path / "own.npz", K=STIFFNESS, M=MASS, names=NAMES)
    one = MatrixSource(tmp_path / "own.npz")

    assert read_structure(MatrixFiles(one, one)).names == NAMES


def test_labels_of_abaqus_bring_matrices_of_other_order_together(
    tmp_path: Path,
) -> None:
    (tmp_path / "k.mtx").write_text("7,1,7,1,5.0\n2,3,2,3,4.0\n7,1,2,3,-1.0\n")
    (tmp_path / "m.mtx").write_text("2,3,2,3,0.2\n7,1,7,1,0.7\n")
    (tmp_path / "c.mtx").write_text("7,1,7,1,0.07\n")
    files = MatrixFiles(
        *(MatrixSource(tmp_path / f"{name}.mtx") for name in ("k", "m", "c"))
    )

    found = read_structure(files)

    assert found.names == ("2.z", "7.x")
    np.testing.assert_array_equal(found.stiffness.toarray(), [[4.0, -1.0], [-1.0, 5.0]])
    np.testing.assert_array_equal(found.mass.toarray(), np.diag([0.2, 0.7]))
    np.testing.assert_array_equal(found.damping.toarray(), np.diag([0.0, 0.07]))


def test_a_degree_of_freedom_held_by_a_huge_stiffness_is_left_out(
    tmp_path: Path,
) -> None:
    (tmp_path / "k.mtx").write_text("1,1,1,1,1e36\n2,1,2,1,4.0\n2,1,1,1,-4.0\n")
    (tmp_path / "m.mtx").write_text("1,1,1,1,1.0\n2,1,2,1,1.0\n")
    files = MatrixFiles(
        MatrixSource(tmp_path / "k.mtx"), MatrixSource(tmp_path / "m.mtx")
    )

    found = read_structure(files)

    assert found.names == ("2.x",)
    np.testing.assert_array_equal(found.stiffness.toarray(), [[4.0]])


def test_nastran_may_leave_out_the_letter_of_an_exponent(tmp_path: Path) -> None:
    (tmp_path / "a.pch").write_text(
        "DMIG    K              0       6       2       0\n"
        "DMIG*   K                             12               0\n"
        "*                     12               0          -2.5+3\n"
        "*                      7               2         1.25-02\n"
        "DMIG*   OTHER                         12               0\n"
        "*                     12               0             9.0\n"
    )

    found = MatrixSource(tmp_path / "a.pch").read(("K",))

    assert found.names == ("7.y", "12")
    np.testing.assert_array_equal(
        found.matrix.toarray(), [[0.0, 0.0125], [0.0125, -2500.0]]
    )


HEADER = "%%MatrixMarket matrix coordinate real symmetric\n"
TEXTS = [
    (
        "a.mtx",
        HEADER + "2 2 2\n1 1 4.0\n2 x 1.0\n",
        ", line 4: Invalid integer value: write the Matrix Market file again",
    ),
    (
        "a.mtx",
        HEADER.replace("real", "complex") + "1 1 1\n1 1 1.0 2.0\n",
        ", line 1: is complex and symmetric: give a real symmetric matrix",
    ),
    (
        "a.mtx",
        HEADER.replace("symmetric", "general") + "1 2 1\n1 1 1.0\n",
        ": the matrix has 1 rows and 2 columns: give a square one",
    ),
    (
        "a.mtx",
        "1,1,1,1,2.0\n** more\n1,1,2,2\n",
        ", line 3: '1,1,2,2' is not node, direction, node, direction, value: "
        "export the matrix again as text",
    ),
    (
        "a.txt",
        "1,1,1,1,nan\n",
        ", line 1: '1,1,1,1,nan' is not node, direction, node, direction, value: "
        "export the matrix again as text",
    ),
    (
        "a.txt",
        "\n1,1,1,1.5,3.0\n",
        ", line 2: direction 1.5 is not a whole number from 1 on: "
        "export the matrix again",
    ),
    (
        "a.txt",
        "1.5,1,1,1,3.0\n",
        ", line 1: node 1.5 is not a whole number from 0 on: export the matrix again",
    ),
    (
        "a.txt",
        "1,1,1,1,3.0\n2,1,2,1,3.0\n1,1,1,1,3.0\n",
        ", line 3: this entry stands in the file before: export the assembled matrix, "
        "not element by element",
    ),
    (
        "a.txt",
        "** nothing\n",
        ": no entries: each line must give node, direction, node, direction, value",
    ),
    (
        "a.sti",
        "1 1 4.0\n3 1 2.0\n",
        ", line 2: index 3 is more than the 2 degrees of freedom in a.dof: "
        "give the files of one job",
    ),
    ("a.csv", "1\n", ": .csv is not known: give .mtx (Matrix Market or Abaqus), .mat, "
     ".npz, .sti and .mas (CalculiX), .pch (Nastran DMIG), or Abaqus text as .txt"),
    ("a.pch", "DMIG    KGG            0       6       2       0\n",
     ": holds no matrix K but KGG: write a.pch:NAME"),
    ("a.pch", "DMIG    K              0       6       4       0\n",
     ": holds no matrix K but nothing: write a.pch:NAME"),
    ("a.pch", "DMIG    K              0       6\n",
     ", line 1: a DMIG header without form and type: punch it again"),
    ("a.pch", "DMIG    K              0       6       2       0\n"
     "DMIG    K       1       1               1       1       3.0\n",
     ": K has no entries in large fields (DMIG*): punch it again"),
    ("a.pch", "DMIG    K              0       6       2       0\n"
     "DMIG*   K                              1               7\n",
     ", line 2: '1', '7' are no node and direction from 0 to 6: "
     "punch the matrix again"),
    ("a.pch", "DMIG    K              0       6       2       0\n"
     "DMIG*   K                              1               1\n"
     "*                      1               1             abc\n",
     ", line 3: 'abc' is no number: punch the matrix again"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "text", "message"), TEXTS)
def test_malformed_text_is_refused_in_one_line(
    name: str, text: str, message: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / "a.dof").write_text("1.1\n1.2\n")

    with pytest.raises(MatrixFileError) as caught:
        MatrixSource(tmp_path / name).read(("K",))

    assert str(caught.value) == f"{tmp_path / name}{message}"


def test_a_name_that_is_no_node_and_direction_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.sti").write_text("1 1 4.0\n")
    (tmp_path / "a.dof").write_text("1.1\nfoo\n")

    message = "'foo' is not node.direction: give CalculiX's .dof file"
    with pytest.raises(MatrixFileError, match=f"a.dof, line 2: {re.escape(message)}$"):
        MatrixSource(tmp_path / "a.sti").read()


@pytest.mark.parametrize("name", ["a.mtx", "a.mat", "a.npz", "a.sti", "a.txt"])
def test_a_file_that_is_not_there_is_named(name: str, tmp_path: Path) -> None:
    message = (
        f"{tmp_path / name}: cannot be read (No such file or directory): check the name"
    )

    with pytest.raises(MatrixFileError, match=f"^{re.escape(message)}$"):
        MatrixSource(tmp_path / name).read(("K",))


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
        (STIFFNESS + np.triu(STIFFNESS, 1), MASS, "stiffness is not symmetric"),
        (STIFFNESS, 0.0 * MASS, "mass is not positive definite"),
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

    for path, cause in ((single, "holds one array"), (broken, "sparse matrix")):
        with pytest.raises(MatrixFileError, match=cause):
            read_structure(MatrixFiles(MatrixSource(path), MatrixSource(path)))
