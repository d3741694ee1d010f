"""Values of a key that are solved once each."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from microslip.scenes.scene import Scene


def check_distinct(key: str, values: Sequence[str], scenes: Iterable[Scene]) -> None:
    """Check that each scene can be solved, and that none would be solved twice.

    ``scenes`` have the ``values`` of the ``key``.

    Raises
    ------
    SceneError
        With the value that is wrong.
    """
    from microslip.scenes.key_path import key_path
    from microslip.scenes.key_value import reached
    from microslip.scenes.quantity import SceneError
    from microslip.scenes.rigs import solvable

    seen: list[object] = []
    for text, scene in zip(values, scenes, strict=True):
        solvable(scene)
        value = reached(scene.rig, key_path(key))
        # what is no value of the rig, such as one of [curve], is known by its text
        seen.append(text if value is None else value)
        if seen[-1] in seen[:-1]:
            raise SceneError(
                f"{key} {' '.join(values)}: {text} stands there twice: give different "
                "values"
            )
