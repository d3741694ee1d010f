"""Curves along any parameter in plain Python."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from microslip.api.arguments import checked, named, resolved
from microslip.errors import GivenError
from microslip.scenes.experiments import APART, HERTZ, Resolution
from microslip.scenes.quantity import quantity

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.response_curve import ResponseCurve

NAME = "microslip.follow"


@dataclass(frozen=True, slots=True, kw_only=True)
class Followed(Resolution):
    """What :func:`follow` is asked for."""

    first: float = quantity()
    last: float = quantity()
    frequency: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])


def follow(
    problem_at: Callable[[float], Problem],
    first: float,
    last: float,
    *,
    frequency: float | str,
    label: str = "parameter",
    tolerance: float | None = None,
    harmonics: int | None = None,
    samples: int | None = None,
) -> ResponseCurve:
    """Return the response at one frequency against a parameter, through folds.

    Parameters
    ----------
    problem_at
        Function that makes the problem of a value, by :func:`microslip.system` or
        :func:`microslip.scene`. It may change every number, not what there is. It is
        tried beyond both ends too, from which the curve may come back; errors that it
        raises there are none.
    first, last
        Values between which the parameter changes.
    frequency
        Of the drive [Hz].
    label
        What pictures call the parameter, such as ``"limit [N]"``.
    tolerance, harmonics, samples
        As for :func:`microslip.curve`.

    Returns
    -------
    ResponseCurve
        As of :func:`microslip.curve`; ``parameter`` holds the values.

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if there is not even a first point; else
        ``ending`` says how the curve ends.
    """
    from microslip.studies.follow import along

    wanted: Followed = resolved(
        NAME,
        Followed,
        first=first,
        last=last,
        frequency=frequency,
        tolerance=tolerance,
        harmonics=harmonics,
        samples=samples,
    )
    if not isinstance(label, str) or not label.strip() or len(label.splitlines()) > 1:
        raise GivenError(f"{NAME}: label = {label!r}: give a text of one line")
    ends = wanted.first, wanted.last
    with named(NAME):
        made = _alike(problem_at, *ends)
        return along(made, ends, math.tau * wanted.frequency, wanted, label)


def _alike(
    problem_at: Callable[[float], Problem], first: float, last: float
) -> Callable[[float], Problem]:
    """Return a function that makes problems of the same parts as its first, or raises.

    Raises
    ------
    GivenError
        If it is none, or does not, at either end.
    """
    if not callable(problem_at):
        raise GivenError(
            f"{NAME}: problem_at = {problem_at!r}: give a function that makes the "
            "problem of a value"
        )
    if math.isclose(first, last, rel_tol=APART):
        raise GivenError(
            f"{NAME}: first and last are both {first:g}: give two different values"
        )
    begun = checked(NAME, problem_at(first))

    def made(value: float) -> Problem:
        found = checked(NAME, problem_at(value))
        if _parts(found) != _parts(begun):
            raise GivenError(
                f"{NAME}: problem_at makes {begun!r} of {first:g}, and {found!r} of "
                f"{value:g}: it may change numbers alone, not what there is"
            )
        return found

    made(last)
    return made


def _parts(problem: Problem) -> tuple[int, tuple[str, ...], tuple[str, ...]]:
    """Return what a curve of a problem has columns for."""
    return problem.structure.dofs, problem.interface.names, problem.probes.names
