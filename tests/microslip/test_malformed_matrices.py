"""Files of matrices that are refused, each in one clear line."""

import re
from pathlib import Path

import pytest

from microslip.matrices.error import MatrixFileError
from microslip.matrices.source import MatrixSource

HEADER = "%%MatrixMarket matrix coordinate real symmetric\n"
TEXTS = [
    (
        "a.mtx",
        HEADER + "2 2 2\n1 1 4.0\n2 x 1.0\n",
        ", line 4: '2 x 1.0' is not row, column, value: write the Matrix Market file "
        "again",
    ),
    (
        "a.mtx",
        HEADER + "2 2 2\n1 1 4.0\n2 2 1,5\n",
        ", line 4: '2 2 1,5' is not row, column, value: write the Matrix Market file "
        "again",
    ),
    (
        "a.mtx",
        "%%MatrixMarket matrix array real general\n%\n1 1\n4.0 kN/m\n",
        ", line 4: '4.0 kN/m' is not a value: write the Matrix Market file again",
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
        HEADER + "2 2 4\n1 1 4.0\n2 1 -1.0\n1 2 -1.0\n2 2 4.0\n",
        ", line 5: this entry or its mirror image stands in the file before: export "
        "the assembled matrix, not element by element, and once",
    ),
    (
        "a.mtx",
        HEADER.replace("symmetric", "general") + "1 1 2\n1 1 4.0\n1 1 4.0\n",
        ", line 4: this entry stands in the file before: export the assembled matrix, "
        "not element by element, and once",
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
        "not element by element, and once",
    ),
    (
        "a.sti",
        "1 1 4.0\n2 1 1.0\n1 1 4.0\n",
        ", line 3: this entry stands in the file before: export the assembled matrix, "
        "not element by element, and once",
    ),
    (
        "a.pch",
        "DMIG,KAAX,0,6,2,0\nDMIG,KAAX,1,1,,1,1,3.0E4\n",
        ": has no DMIG header in fields of 8 characters: punch the matrix",
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
     ": K is complex or not square: give a real square matrix"),
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
     "DMIG*   K                              1              12\n",
     ", line 2: '1', '12' are no node and direction from 0 to 6: "
     "punch the matrix again"),
    ("a.pch", "DMIG    K              0       6       2       0\n"
     "DMIG*   K                              1               1\n"
     "*                      1               1             abc\n",
     ", line 3: 'abc' is no number: punch the matrix again"),
    ("a.pch", 2 * ("DMIG    K              0       6       2       0\n"
     "DMIG*   K                              1               1\n"
     "*                      1               1             4.0\n"),
     ", line 6: this entry stands in the file before: export the assembled matrix, "
     "not element by element, and once"),
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


def test_a_direction_beyond_those_of_motion_keeps_its_number(tmp_path: Path) -> None:
    (tmp_path / "a.sti").write_text("1 1 4.0\n2 2 5.0\n")
    (tmp_path / "a.dof").write_text("1.0\n1.7\n")  # a temperature, a warping

    assert MatrixSource(tmp_path / "a.sti").read().names == ("1.0", "1.7")


@pytest.mark.parametrize("name", ["a.mtx", "a.mat", "a.npz", "a.sti", "a.txt"])
def test_a_file_that_is_not_there_is_named(name: str, tmp_path: Path) -> None:
    message = (
        f"{tmp_path / name}: cannot be read (No such file or directory): check the name"
    )

    with pytest.raises(MatrixFileError, match=f"^{re.escape(message)}$"):
        MatrixSource(tmp_path / name).read(("K",))
