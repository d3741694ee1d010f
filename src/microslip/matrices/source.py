"""Where a matrix is: a file, and a variable in it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from microslip.matrices.abaqus import read_abaqus
from microslip.matrices.calculix import read_calculix
from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.matlab import read_matlab
from microslip.matrices.matrix_market import read_matrix_market
from microslip.matrices.nastran import read_nastran
from microslip.matrices.npz import read_npz
from microslip.matrices.text_table import text_of

FORMATS = (
    ".mtx (Matrix Market or Abaqus), .mat, .npz, .sti and .mas (CalculiX), "
    ".pch (Nastran DMIG), or Abaqus text as .txt"
)


@dataclass(frozen=True, slots=True)
class MatrixSource:
    """A file and, where it holds several, the variable."""

    path: Path
    variable: str = ""
    """the usual names if left out"""

    @classmethod
    def of(cls, text: str, folder: Path = Path()) -> MatrixSource:
        """Return the source that a text such as ``blade.mat:K`` names."""
        name, mark, variable = text.partition(":")
        return cls(folder / name, variable if mark else "")

    def read(self, usual: tuple[str, ...] = ()) -> LabelledMatrix:
        """Read the matrix; ``usual`` are names to look for if no variable is given.

        Raises
        ------
        MatrixFileError
            If the file is malformed, or of a kind that is not known.
        """
        try:
            return self._read((self.variable,) if self.variable else usual)
        except ValueError as error:
            raise MatrixFileError(self.path, str(error)) from None

    def _read(self, wanted: tuple[str, ...]) -> LabelledMatrix:
        suffix = self.path.suffix.lower()
        if suffix == ".mat":
            return read_matlab(self.path, wanted)
        if suffix == ".npz":
            return read_npz(self.path, wanted)
        if suffix == ".pch":
            return read_nastran(self.path, wanted)
        if self.variable:
            raise MatrixFileError(
                self.path, f"holds one matrix: leave out :{self.variable}"
            )
        if suffix in (".sti", ".mas"):
            return read_calculix(self.path)
        if suffix not in (".mtx", ".txt"):
            what = f"{suffix} is not known" if suffix else "has no ending"
            raise MatrixFileError(self.path, f"{what}: give {FORMATS}")
        if text_of(self.path).lower().startswith("%%matrixmarket"):
            return read_matrix_market(self.path)
        return read_abaqus(self.path)
