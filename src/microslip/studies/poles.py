"""Poles of the scene with equivalent springs and dampers, against a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.curves.dense_problem import RESOLVED
from hbm.forces.equivalent import equivalent_contact, free_structure, stuck_structure
from hbm.one_harmonic import (
    OneHarmonicError,
    one_harmonic_error,
    one_harmonic_response,
)
from hbm.structure.poles import NONE, followed
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.studies.pole_question import Question
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState, static_equilibrium
from microslip_mechanics.structures.structure import Structure


@dataclass(frozen=True, slots=True)
class Linear:
    """A linear structure that answers the drive like the one-harmonic response."""

    structure: Structure
    response: PeriodicResponse
    amplitude: float
    """of the response, largest of the probes [m]"""
    error: OneHarmonicError
    """against more harmonics"""
    outside: bool
    """whether its amplitude is the largest of the range, and at an end of it"""
    free: Structure
    """on the normal contacts at rest, without friction"""
    stuck: Structure | None
    """and without sliding; None if nothing can move"""


@dataclass(frozen=True, slots=True)
class Linearised:
    """The scene at one value of the parameter."""

    value: str
    """as it was given"""
    ending: str
    """"complete", or why there is no response"""
    linear: Linear | None
    """None if there is no response"""


def linearised(question: Question, values: Sequence[str]) -> Iterator[Linearised]:
    """Yield the linearised scene for each value; a failure is a result too."""
    for value in values:
        scene = question.at(value)
        try:
            yield Linearised(value, "complete", _answer(question, scene))
        except (MicroslipError, ValueError) as cause:
            yield Linearised(value, str(cause), None)


def _answer(question: Question, scene: Scene) -> Linear:
    """Return the linearised scene at one value.

    Raises
    ------
    MicroslipError, ValueError
        If there is none.
    """
    problem, limits = problem_of(scene), limits_of(scene)
    if problem.structure.sparse:
        problem = reduced(problem, RESOLVED * limits[1]).problem
    rest = static_equilibrium(problem)
    response = one_harmonic_response(problem, rest, limits, question.frequency)
    free = question.frequency is None
    error = one_harmonic_error(
        problem, rest, response, limits, scene.curve.tolerance, free=free
    )
    outside = free and response.frequency in limits
    return _linear(problem, rest, response, error, outside=outside)


def _linear(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    error: OneHarmonicError,
    *,
    outside: bool,
) -> Linear:
    amplitude = response.largest(problem.probes.rows)
    return Linear(
        equivalent_contact(problem, response).joined(problem),
        response,
        amplitude,
        error,
        outside and amplitude > 0.0,
        free_structure(problem, rest),
        stuck_structure(problem, rest),
    )


def branches(found: Sequence[Linearised], limits: tuple[float, float]) -> ComplexArray:
    """Return the poles of each value that are within a range of frequencies somewhere.

    Parameters
    ----------
    found
        In the order in which the poles are followed.
    limits
        Range of the frequency of free decay [rad/s].

    Returns
    -------
    [rad/s], shape ``(values, branches)``; NaN where there is no response, or no such
    pole any more.
    """
    structures = [each.linear.structure if each.linear else None for each in found]
    return _followed(structures, limits)


def limit_lines(
    found: Sequence[Linearised], name: str, limits: tuple[float, float]
) -> ComplexArray:
    """Return the limits' poles within a range: ``name`` is "free" or "stuck".

    They are followed, and have the shape, as in :func:`branches`.
    """
    structures = [getattr(each.linear, name, None) for each in found]
    return _followed(structures, limits)


def _followed(
    structures: Sequence[Structure | None], limits: tuple[float, float]
) -> ComplexArray:
    """Return the poles of structures that are within a range somewhere."""
    places = [place for place, each in enumerate(structures) if each is not None]
    if not places:
        return np.full((len(structures), 0), NONE)
    table = followed([each for each in structures if each is not None])
    table = table[:, within(table, limits).any(axis=0)]
    whole = np.full((len(structures), table.shape[1]), NONE)
    whole[places] = table
    return whole


def within(values: ComplexArray, limits: tuple[float, float]) -> NDArray[np.bool_]:
    """Return which poles are within a range of frequencies of free decay [rad/s]."""
    inside: NDArray[np.bool_] = (values.imag >= limits[0]) & (values.imag <= limits[1])
    return inside


def limits_of(scene: Scene) -> tuple[float, float]:
    """Return the range of the scene's curve [rad/s]."""
    return 2.0 * np.pi * scene.curve.lowest, 2.0 * np.pi * scene.curve.highest
