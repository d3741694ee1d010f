"""A number of a scene that may change continuously."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from hbm.errors import placed
from microslip.scenes import key_value
from microslip.scenes.experiments import APART
from microslip.scenes.key_path import key_path
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.problem import Problem

Point = TypeVar("Point")


@dataclass(frozen=True, slots=True)
class Parameter:
    """One key of a scene, with the values between which it changes."""

    scene: Scene
    """at the first value"""
    name: str
    """tables and key, with dots"""
    first: float
    """in SI units"""
    last: float

    @property
    def label(self) -> str:
        """Name and unit."""
        unit = key_value.unit(self.scene.rig, key_path(self.name))
        return f"{self.name} [{unit}]" if unit else self.name

    def problem_at(self, value: float) -> Problem:
        """Return the problem at a value [SI units]."""
        changed = key_value.replaced(self.scene.rig, key_path(self.name), value)
        return problem_of(dataclasses.replace(self.scene, rig=changed))


def told_along(points: Iterable[Point], label: str) -> Iterator[Point]:
    """Yield points along a parameter; errors name it, as its label does, and its unit.

    Raises
    ------
    ContinuationError
        Where the points end with one.
    """
    name, _, unit = label.partition(" [")
    with placed(lambda value: f"{name} = {value:.9g} {unit.rstrip(']')}".rstrip()):
        yield from points


def parameter(
    scene: str, overrides: Sequence[str], name: str, first: str, last: str
) -> Parameter:
    """Return the parameter of a name such as ``excitation.force``.

    Parameters
    ----------
    scene, overrides
        As for :func:`~microslip.scenes.scene_file.load_scene`.
    name
        Table and key.
    first, last
        Its values, as a scene file has them.

    Raises
    ------
    SceneError
        If the scene does not take them, or if the key is no continuous number.
    """
    begun, ended = (
        load_scene(scene, [*overrides, f"{name}={value}"]) for value in (first, last)
    )
    values = [key_value.reached(each.rig, key_path(name)) for each in (begun, ended)]
    found = [value for value in values if type(value) is float]
    if len(found) < len(values):
        raise SceneError(
            f"{name} cannot be followed: give a number of the structure, its contacts "
            "or its loads, such as excitation.force, friction.mu_dynamic or, of a "
            "system, element.NAME.KEY"
        )
    if math.isclose(*found, rel_tol=APART, abs_tol=0.0):
        raise SceneError(f"{name} from {first} to {last}: give two different values")
    return Parameter(begun, name, *found)
