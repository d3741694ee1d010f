"""MATLAB files up to version 7."""

from __future__ import annotations

from pathlib import Path

import scipy.io
from scipy.io.matlab import MatReadError

from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.sparse_kind import either_kind
from microslip.matrices.variable import matrix_of


def read_matlab(path: Path, wanted: tuple[str, ...]) -> LabelledMatrix:
    """Read the first variable of ``wanted`` that is there, dense or sparse.

    Raises
    ------
    MatrixFileError
        If there is none, or the file is of another kind; files of version 7.3 are.
    """
    try:
        with path.open("rb"), either_kind():  # says why a file cannot be read
            found = scipy.io.loadmat(str(path), appendmat=False)
    except NotImplementedError:
        raise MatrixFileError(
            path, "is of MATLAB's version 7.3: save it with save(file, vars, '-v7')"
        ) from None
    except OSError as error:
        raise MatrixFileError.unreadable(path, error) from None
    except (ValueError, TypeError, LookupError, EOFError, MatReadError) as error:
        raise MatrixFileError(
            path, f"is no sound MATLAB file ({error}): save it again with '-v7'"
        ) from None
    there = {name: value for name, value in found.items() if name[:2] != "__"}
    return LabelledMatrix(matrix_of(path, there, wanted), ())
