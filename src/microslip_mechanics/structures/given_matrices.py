"""Matrices and names as a user gives them, checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np
import scipy.sparse

from microslip_mechanics.arrays import Array, Matrix, masked
from microslip_mechanics.quantity import LARGEST
from microslip_mechanics.structures.forms import is_name


def square_matrix(given: Matrix, what: str) -> Matrix:
    """Return a square matrix, of floating point numbers, that is nobody else's."""
    sparse = bool(scipy.sparse.issparse(given))
    if _complex(given):
        raise ValueError(
            f"{what} is complex: give real values, structural damping as loss_factor"
        )
    if masked(given):
        raise ValueError(f"{what} has masked entries: give a number for each")
    if sparse:
        _check_square(given.shape, what)
        return scipy.sparse.csc_array(given, dtype=float, copy=True)
    try:
        matrix = np.array(given, dtype=float)
        numbers = not _any_truth(given)
    except (TypeError, ValueError, OverflowError):
        numbers = False
    if not numbers:
        raise ValueError(f"{what} {_no_matrix(given)}")
    if matrix.ndim == 1:
        matrix = np.diag(matrix)
    _check_square(matrix.shape, what)
    _check_entries(matrix, what)
    return matrix


def _check_square(shape: tuple[int, ...], what: str) -> None:
    """Check that a shape is that of a square matrix with entries."""
    if len(shape) != 2 or shape[0] != shape[1] or shape[0] == 0:
        raise ValueError(
            f"{what} has shape {shape}: give a square matrix, or its diagonal"
        )


def _any_truth(given: object) -> bool:
    """Return whether there are truth values, which numpy takes for 0 and 1."""
    if isinstance(given, np.ndarray) and given.dtype != object:
        return bool(given.dtype == bool)
    return any(isinstance(each, bool | np.bool_) for each in _flat(given))


def _no_matrix(given: object) -> str:
    """Return what is wrong with what is no matrix of numbers, and its remedy."""
    for each in _flat(given):
        if isinstance(each, str):
            return f"holds the text {each!r}: give numbers alone, in SI units"
        if isinstance(each, bool | np.bool_):
            return "holds a truth value: give numbers alone, in SI units"
        if isinstance(each, int) and abs(each) > LARGEST:
            return (
                f"holds a number above {LARGEST:g}: what is reckoned with it overflows"
            )
    return "is no matrix of numbers: give rows of equal length, or the diagonal alone"


def _flat(given: object) -> Iterable[object]:
    """Yield the entries of rows, or of a diagonal."""
    if isinstance(given, str) or not isinstance(given, Iterable):
        yield given
        return
    for each in given:
        yield from _flat(each)


def _complex(given: Matrix) -> bool:
    """Return whether there are complex entries; rows of unequal length have none."""
    try:
        return bool(np.iscomplexobj(given))
    except ValueError:
        return False


def _check_entries(matrix: Array, what: str) -> None:
    """Check that all entries are numbers whose squares are."""
    if not np.isfinite(matrix).all():
        row, column = np.argwhere(~np.isfinite(matrix))[0] + 1
        raise ValueError(
            f"{what} holds a value that is not finite, in row {row}, column {column}"
        )
    if abs(matrix).max() > LARGEST:
        row, column = np.argwhere(abs(matrix) > LARGEST)[0] + 1
        raise ValueError(
            f"{what} holds {matrix[row - 1, column - 1]:g} in row {row}, column "
            f"{column}: give at most {LARGEST:g} in size, or what is reckoned with it "
            "overflows"
        )


def dof_names(given: Sequence[str] | None, count: int) -> tuple[str, ...]:
    """Return the names of the degrees of freedom."""
    if given is None:
        return tuple(f"x{place}" for place in range(1, count + 1))
    listed = isinstance(given, Iterable) and not isinstance(given, str)
    names = tuple(given) if listed else ()
    wrong: list[object] = [name for name in names if not is_name(name)]
    if wrong or not listed:
        told = wrong[0] if wrong else given
        raise ValueError(
            f"names of degrees of freedom: {told!r} is no name: give a list of texts, "
            "such as ['x1', 'x2']"
        )
    if len(names) != count:
        raise ValueError(
            f"there are {len(names)} names, but mass has shape ({count}, {count}): "
            "give one name for each degree of freedom"
        )
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise ValueError(
            f"names of degrees of freedom: {', '.join(twice)} stands there more than "
            "once: give each its own name"
        )
    if "ground" in names:
        raise ValueError(
            "names of degrees of freedom: ground is what does not move: give another "
            "name"
        )
    return names


def check_like(matrix: Matrix, mass: Matrix, what: str) -> None:
    """Check that a matrix is of the same degrees of freedom and kind as the mass."""
    if matrix.shape != mass.shape:
        raise ValueError(
            f"{what} has shape {matrix.shape}, but mass has {mass.shape}: give "
            "matrices of the same degrees of freedom"
        )
    if scipy.sparse.issparse(matrix) != scipy.sparse.issparse(mass):
        raise ValueError(f"mass or {what} is sparse, the other is not: give both alike")


def check_massive(mass: Matrix, names: tuple[str, ...]) -> None:
    """Check that every degree of freedom has mass; others see to the matrix as such."""
    diagonal = mass.diagonal()
    if np.isfinite(diagonal).all() and diagonal.min() <= 0.0:
        place = int(diagonal.argmin())
        raise ValueError(
            f"mass of {names[place]} is {diagonal[place]:g} kg: give each degree of "
            "freedom some mass, or leave out those that have none"
        )
