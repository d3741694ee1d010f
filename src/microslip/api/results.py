"""Results of plain Python: to files and back, and their pictures."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from microslip.api.arguments import path_of

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from matplotlib.figure import Figure

    from microslip.files.schema import Result
    from microslip.studies.modes import FollowedMode
    from microslip_mechanics.results.response_curve import ResponseCurve

    Many = tuple[FollowedMode, ...] | list[FollowedMode] | list[ResponseCurve]

SAVED = "microslip.curve, microslip.follow, microslip.sweep or microslip.load"
DRAWN = f"microslip.modes, {SAVED}"
PICTURES = (".png", ".pdf", ".svg", ".jpg", ".jpeg")
OTHERS = (".toml", ".csv", ".npz", ".mtx", ".mat", ".txt", ".inp")
"""endings of scenes, tables and matrices, which a result must not be written over"""


def save(result: Result, path: str | PathLike[str]) -> None:
    """Write a curve or a march as netCDF; ``microslip plot`` draws it.

    Parameters
    ----------
    result
        From :func:`microslip.curve`, :func:`microslip.follow` or
        :func:`microslip.sweep`.
    path
        The file; docs/files.md says what is in it.

    Raises
    ------
    MicroslipError
        If the file cannot be written or has the ending of a picture, a scene, a table
        or a matrix, or the result is none.
    """
    from microslip.errors import GivenError
    from microslip.files import store

    _check(result, "microslip.save", SAVED)
    place = path_of("microslip.save", path)
    ending = place.suffix.lower()
    if ending in PICTURES + OTHERS:
        drawn = "; microslip.figure(result).savefig(path) writes a picture"
        raise GivenError(
            f"microslip.save: {path}: it writes netCDF: give a name that ends with "
            f".nc{drawn if ending in PICTURES else ''}"
        )
    store.save(place, store.Stored(result, "", "microslip.save"))


def load(path: str | PathLike[str]) -> Result:
    """Return what :func:`save` or a command has written.

    Raises
    ------
    MicroslipError
        If there is no such file, or it is not a result.
    """
    from microslip.files import result_file

    return result_file.load(path_of("microslip.load", path)).result


def figure(
    result: Result | FollowedMode | Many,
    title: str = "",
    labels: Sequence[str] = (),
) -> Figure:
    """Return the picture that the command line draws of a curve, a march, or modes.

    A notebook shows it; ``figure(result).savefig(path)`` writes it.

    Parameters
    ----------
    result
        A curve, several that are compared, a march, what :func:`microslip.modes`
        returns, or some or one of these modes.
    title
        Above the picture.
    labels
        What several curves are called; their numbers if left out.

    Raises
    ------
    MicroslipError
        If the result is none, the title is no text, labels are not as many as curves,
        or curves go along different quantities.
    ValueError
        If a march has not come far enough to have anything to draw.
    """
    from microslip.errors import GivenError

    if not isinstance(title, str):
        raise GivenError(
            f"microslip.figure: title = {title!r}: give a text; the picture has axes "
            "of its own"
        )
    from microslip.figures.result import result_figure
    from microslip.studies.modes import FollowedMode
    from microslip_mechanics.results.response_curve import ResponseCurve

    if isinstance(result, FollowedMode):
        return _modes((result,), title)
    if isinstance(result, tuple | list):
        curves = [each for each in result if isinstance(each, ResponseCurve)]
        if curves and len(curves) == len(result):
            return _compared(curves, title, labels)
        return _modes(result, title)

    _check(result, "microslip.figure", DRAWN)
    return result_figure(result, title)


def _compared(
    curves: Sequence[ResponseCurve], title: str, labels: Sequence[str]
) -> Figure:
    """Return the picture of several curves.

    Raises
    ------
    GivenError
        If labels are not as many, or the curves go along different quantities.
    """
    from microslip.errors import GivenError
    from microslip.figures.compared import compared_figure

    several = isinstance(labels, Iterable) and not isinstance(labels, str)
    names = [str(each) for each in labels] if several else []
    if not several or len(names) not in (0, len(curves)):
        raise GivenError(
            f"microslip.figure: labels = {labels!r}: give a list of {len(curves)} "
            "texts, one for each curve"
        )
    ways = [each.along or "the frequency" for each in curves]
    if len(set(ways)) > 1:
        raise GivenError(
            f"microslip.figure: curves along {' and '.join(sorted(set(ways)))}: give "
            "those along one of them"
        )
    numbers = [str(number) for number in range(1, len(curves) + 1)]
    return compared_figure(curves, names or numbers, title)


def _modes(result: Sequence[FollowedMode | ResponseCurve], title: str) -> Figure:
    """Return the picture of modes.

    Raises
    ------
    GivenError
        If there is none with a point, or if they are none.
    """
    from microslip.errors import GivenError
    from microslip.figures.modes import modes_figure
    from microslip.mode_lines import mode_lines
    from microslip.studies.modes import FollowedMode

    modes = [each for each in result if isinstance(each, FollowedMode)]
    if len(modes) < len(result) or not modes:
        raise GivenError(f"microslip.figure: {result!r}: give what {DRAWN} returns")
    lines = mode_lines(modes)
    if not lines:
        raise GivenError("microslip.figure: no mode has a point: see their endings")
    return modes_figure(lines, title)


def _check(result: Result, function: str, known: str) -> None:
    """Check that something is a result.

    Raises
    ------
    GivenError
        If it is none.
    """
    from microslip.errors import GivenError
    from microslip.files.schema import SCHEMAS

    if not isinstance(result, tuple(made for made, _ in SCHEMAS.values())):
        raise GivenError(f"{function}: {result!r}: give what {known} returns")
