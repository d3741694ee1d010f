"""Where values of a scene's key lie on the axis of a picture."""

from __future__ import annotations

from collections.abc import Sequence

from microslip.scenes import key_value
from microslip.scenes.key_path import key_path
from microslip.scenes.scene import Scene


def axis(
    key: str, texts: Sequence[str], scenes: Sequence[Scene]
) -> tuple[list[float], str, list[str]]:
    """Return the place of each value on an axis, its label, and names of the places.

    Numbers of the structure, its contacts and loads lie at their value in SI units,
    other numbers, if they have one unit, as they were given, and what is no number in
    the order of the list; that alone has names.

    Parameters
    ----------
    key
        Table and key.
    texts, scenes
        The values as they were given, and the scene with each of them.
    """
    found = [key_value.reached(each.rig, key_path(key)) for each in scenes]
    if all(type(value) is float for value in found):
        unit = key_value.unit(scenes[0].rig, key_path(key))
        return found, f"{key} [{unit}]" if unit else key, []
    numerals, _, units = zip(*(text.partition(" ") for text in texts), strict=True)
    try:
        if len(set(units)) == 1:
            label = f"{key} [{units[0]}]" if units[0] else key
            return [*map(float, numerals)], label, []
    except ValueError:
        pass
    return [float(place) for place in range(len(texts))], key, list(texts)
