"""Matrices from files: round trips through each format."""

from collections.abc import Callable
from pathlib import Path

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
HEADER = "%%MatrixMarket matrix coordinate real symmetric\n"
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


def test_a_name_of_several_rows_is_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "own.npz", K=STIFFNESS, names=[NAMES[0]] * len(NAMES))

    with pytest.raises(MatrixFileError, match="is the name of several rows: name each"):
        MatrixSource(tmp_path / "own.npz").read(("K",))


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


def test_nastran_s_comments_end_no_column(tmp_path: Path) -> None:
    (tmp_path / "a.pch").write_text(
        "$ punched\n"
        "DMIG    K              0       6       2       0\n"
        "DMIG*   K                              1               1\n"
        "*                      1               1             2.0\n"
        "$ springs to node 2\n"
        "\n"
        "*                      2               1            -1.0\n"
        "DMIG*   K                              2               1\n"
        "*                      2               1             2.0\n"
    )

    found = MatrixSource(tmp_path / "a.pch").read(("K",))

    np.testing.assert_array_equal(found.matrix.toarray(), [[2.0, -1.0], [-1.0, 2.0]])


def test_halves_may_be_mixed(tmp_path: Path) -> None:
    # the order of the program that wrote it is not that of the nodes' numbers
    (tmp_path / "k.txt").write_text(
        "7,1,7,1,5.0\n2,3,7,1,-1.0\n2,3,2,3,4.0\n9,1,2,3,-2.0\n9,1,9,1,3.0\n"
    )

    found = MatrixSource(tmp_path / "k.txt").read(())

    assert found.names == ("2.z", "7.x", "9.x")
    np.testing.assert_array_equal(
        found.matrix.toarray(), [[4.0, -1.0, -2.0], [-1.0, 5.0, 0.0], [-2.0, 0.0, 3.0]]
    )


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
def test_exponents_of_fortran_are_read_from_matrix_market_files(
    encoding: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.mtx"
    text = HEADER + "% von Müller\n2 2 2\n1 1 2.0D+04\n2 2 -.5d-3\n"
    path.write_text(text.lower(), encoding=encoding)

    found = MatrixSource(path).read(())

    np.testing.assert_array_equal(found.matrix.toarray(), [[2e4, 0.0], [0.0, -5e-4]])
