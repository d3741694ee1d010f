"""Scenes in plain Python."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING

from microslip.api.arguments import texts_of

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem

NAME = "microslip.scene"


def scene(source: str | PathLike[str], overrides: Sequence[str] = ()) -> Problem:
    """Return the problem of a built-in scene, or of a scene file.

    Parameters
    ----------
    source
        Name or path.
    overrides
        Texts ``table.key=value`` that replace values, or one of them.

    Raises
    ------
    SceneError
        With file, table, key, value and remedy.
    """
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene

    several = texts_of(NAME, source, overrides)
    return problem_of(load_scene(str(source), several))
