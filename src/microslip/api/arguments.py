"""Arguments of the functions of plain Python, checked and named."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from microslip.errors import GivenError
from microslip.scenes.experiments import APART, check_samples
from microslip.scenes.quantity import SceneError
from microslip.scenes.table import read_table

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem


def texts_of(function: str, source: object, overrides: object) -> Sequence[str]:
    """Return the overrides of a scene, of which there may be one.

    Raises
    ------
    GivenError
        If they, or the source, are no texts.
    """
    if not isinstance(source, (str, PathLike)):
        raise GivenError(
            f"{function}: source = {source!r}: give the name of a built-in scene, or "
            "the path of a scene file"
        )
    several = [overrides] if isinstance(overrides, str) else overrides
    if not isinstance(several, Sequence) or not all(
        isinstance(each, str) for each in several
    ):
        raise GivenError(
            f"{function}: overrides = {overrides!r}: give texts table.key=value, such "
            'as "drive.x=0.2"'
        )
    return several


def path_of(function: str, path: str | PathLike[str]) -> Path:
    """Return a path.

    Raises
    ------
    GivenError
        If it is none, or has a character that no path has.
    """
    try:
        place = Path(path)
    except TypeError:
        place = Path("\0")
    if "\0" in str(place):
        raise GivenError(f"{function}: path = {path!r}: give the path of a file")
    return place


@contextlib.contextmanager
def named(function: str) -> Iterator[None]:
    """Make errors of values, such as those of a free body, ones of a function."""
    try:
        yield
    except (ValueError, SceneError) as error:
        raise GivenError(f"{function}: {error}") from None


def read(function: str, table: type, **values: object) -> Any:  # noqa: ANN401
    """Return the arguments of a function as the keys of a scene's table are read."""
    for name, value in values.items():
        _check_unmasked(function, name, value)
    given = {name: _plain(value) for name, value in values.items() if value is not None}
    return read_table(function, "", table, given)


def resolved(
    function: str,
    table: type,
    *,
    tolerance: float | None,
    harmonics: int | None,
    samples: int | None,
    **values: object,
) -> Any:  # noqa: ANN401
    """Return what :func:`read` does of a table with the resolution of a curve.

    Raises
    ------
    GivenError
        If it is of no use, or told twice.
    """
    check_single(function, tolerance, harmonics)
    wanted = read(
        function,
        table,
        **values,
        tolerance=tolerance,
        harmonics=harmonics,
        samples=samples,
    )
    check_samples(f"{function}:", wanted)
    return wanted


def check_single(function: str, tolerance: float | None, harmonics: int | None) -> None:
    """Check that harmonics are either given or follow from a tolerance.

    Raises
    ------
    GivenError
        If they are both.
    """
    if tolerance is not None and harmonics is not None:
        raise GivenError(
            f"{function}: tolerance = {tolerance!r}: harmonics are fixed: leave one of "
            "them out"
        )


def _check_unmasked(function: str, name: str, value: object) -> None:
    from microslip_mechanics.arrays import masked

    if masked(value):
        raise GivenError(f"{function}: {name} is masked: give a number in its place")


def _plain(value: Any) -> object:  # noqa: ANN401  (whatever is given)
    """Return numbers of numpy as those of Python."""
    if not hasattr(value, "tolist"):
        return value
    return value.item() if getattr(value, "size", 0) == 1 else value.tolist()


def check_apart(function: str, lowest: float, highest: float) -> None:
    """Check that two frequencies [Hz] are a range.

    Raises
    ------
    GivenError
        If they are the same, but for rounding.
    """
    if math.isclose(lowest, highest, rel_tol=APART):
        raise GivenError(
            f"{function}: lowest and highest are both {lowest:g} Hz: give two "
            "different frequencies"
        )


def checked(function: str, problem: Problem) -> Problem:
    """Return a problem.

    Raises
    ------
    GivenError
        If it is none.
    """
    from microslip_mechanics.problem import Problem

    if not isinstance(problem, Problem):
        raise GivenError(
            f"{function}: problem = {problem!r}: give what microslip.system or "
            "microslip.scene returns"
        )
    return problem
