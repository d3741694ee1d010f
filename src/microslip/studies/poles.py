"""Poles of the scene with equivalent springs and dampers, against a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.equivalent import (
    amplitudes,
    equivalent_contact,
    free_structure,
    one_harmonic_error,
    one_harmonic_response,
    stuck_structure,
)
from hbm.errors import ContinuationError
from hbm.poles import NONE, followed, poles
from microslip.quantity import SceneError
from microslip.rigs import problem_of
from microslip.scene_file import Scene, load_scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState, static_equilibrium
from microslip_mechanics.structure import Structure

FRICTION = "friction"
"""the parameter µd that takes µs along in proportion"""
SHARES = (0.0, *np.geomspace(1e-3, 10.0**1.5, 28).tolist())
"""of the scene's friction, from none to sticking"""


@dataclass(frozen=True, slots=True)
class Linear:
    """A linear structure that answers the drive like the one-harmonic response."""

    structure: Structure
    response: PeriodicResponse
    amplitude: float
    """of the response, largest of the probes [m]"""
    error: float
    """of its amplitudes against more harmonics, relative; NaN if not known"""
    free: ComplexArray
    """poles on the normal contacts at rest, without friction [rad/s]"""
    stuck: ComplexArray
    """and without sliding [rad/s]"""


@dataclass(frozen=True, slots=True)
class Linearised:
    """The scene at one value of the parameter."""

    value: str
    """as it was given"""
    ending: str
    """"complete", or why there is no response"""
    linear: Linear | None
    """None if there is no response"""


@dataclass(frozen=True, slots=True)
class Question:
    """What is varied, and where the response is taken."""

    scene: str
    overrides: tuple[str, ...]
    key: str
    """table and key of the scene, or :data:`FRICTION`"""
    frequency: float | None = None
    """of the response [rad/s]; that of its largest amplitude if left out"""

    def at(self, value: str) -> Scene:
        """Return the scene at one value.

        Raises
        ------
        SceneError
            If the scene does not take it.
        """
        if self.key != FRICTION:
            return load_scene(self.scene, (*self.overrides, f"{self.key}={value}"))
        dynamic = f"friction.mu_dynamic={value}"
        load_scene(self.scene, (*self.overrides, dynamic))
        static = f"friction.mu_static={self._ratio() * float(value)!r}"
        return load_scene(self.scene, (*self.overrides, dynamic, static))

    def usual_values(self) -> list[str]:
        """Return values of the friction coefficient from none to sticking.

        Raises
        ------
        SceneError
            If another key is varied: its values must be given.
        """
        if self.key != FRICTION:
            raise SceneError(f"{self.key}: give values of it")
        self._ratio()
        scale = load_scene(self.scene, self.overrides).rig.friction.mu_dynamic
        return [f"{share * scale:.4g}" for share in SHARES]

    def _ratio(self) -> float:
        """Return µs/µd."""
        rig = load_scene(self.scene, self.overrides).rig
        if not isinstance(rig, TwoBlades):
            raise SceneError(
                f"{self.scene}: a system has no one friction coefficient: give a key "
                "and values, such as element.NAME.mu 0.1 0.3 1"
            )
        friction = rig.friction
        if friction.law == "none" or friction.mu_dynamic == 0.0:
            raise SceneError(
                f"{self.scene}: [friction] law = {friction.law}, mu_dynamic = "
                f"{friction.mu_dynamic:g}: there is no friction to vary: give some, or "
                "another key and its values"
            )
        return friction.mu_static / friction.mu_dynamic


def linearised(question: Question, values: Sequence[str]) -> Iterator[Linearised]:
    """Yield the linearised scene for each value; a failure is a result too."""
    for value in values:
        scene = question.at(value)
        problem = problem_of(scene)
        rest = static_equilibrium(problem)
        limits = limits_of(scene)
        try:
            response = one_harmonic_response(problem, rest, limits, question.frequency)
        except ContinuationError as cause:
            yield Linearised(value, str(cause), None)
            continue
        error = one_harmonic_error(
            problem, rest, response, limits, scene.curve.tolerance
        )
        yield Linearised(value, "complete", _linear(problem, rest, response, error))


def _linear(
    problem: Problem, rest: StaticState, response: PeriodicResponse, error: float
) -> Linear:
    return Linear(
        equivalent_contact(problem, response).joined(problem),
        response,
        float(amplitudes(problem, response).max(initial=0.0)),
        error,
        poles(free_structure(problem, rest)).values,
        poles(stuck_structure(problem, rest)).values,
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
    places = [place for place, each in enumerate(found) if each.linear is not None]
    table = followed([each.linear.structure for each in found if each.linear])
    table = table[:, within(table, limits).any(axis=0)]
    whole = np.full((len(found), table.shape[1]), NONE)
    whole[places] = table
    return whole


def limit_lines(
    found: Sequence[Linearised], name: str, limits: tuple[float, float]
) -> ComplexArray:
    """Return the limits' poles within a range: ``name`` is "free" or "stuck".

    Shape ``(values, poles)``, in the order of their frequencies; NaN where there are
    less.
    """
    nothing = np.empty(0, complex)
    ends = [getattr(each.linear, name) if each.linear else nothing for each in found]
    kept = [values[within(values, limits)] for values in ends]
    lines = np.full((len(kept), max(map(len, kept), default=0)), NONE)
    for row, values in zip(lines, kept, strict=True):
        row[: values.size] = values
    return lines


def within(values: ComplexArray, limits: tuple[float, float]) -> NDArray[np.bool_]:
    """Return which poles are within a range of frequencies of free decay [rad/s]."""
    inside: NDArray[np.bool_] = (values.imag >= limits[0]) & (values.imag <= limits[1])
    return inside


def limits_of(scene: Scene) -> tuple[float, float]:
    """Return the range of the scene's curve [rad/s]."""
    return 2.0 * np.pi * scene.curve.lowest, 2.0 * np.pi * scene.curve.highest
