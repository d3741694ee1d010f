"""Names of keys in a scene: tables and key, joined by dots."""

from __future__ import annotations

OF_MOTIONS = ("drive", "preload", "probes")
"""tables whose keys are degrees of freedom, which may have dots in their names"""
OF_ELEMENTS = "element"
"""table of elements, which may have dots in their names"""
AMPLITUDE = "amplitude"
"""of a harmonic force: a bare number stands for it"""
OF_WAVES = (f".{AMPLITUDE}", ".phase")


def key_path(name: str) -> tuple[str, ...]:
    """Return tables and key of a name such as ``element.slider.limit``.

    ``drive.tip.uz`` and ``drive."tip.uz"`` are the key ``tip.uz`` of the table
    ``drive``; ``drive.tip.uz.phase`` is the phase of that force, and
    ``element.tip.left.limit`` the key ``limit`` of the element ``tip.left``.
    """
    table, dot, rest = name.strip().partition(".")
    if table == OF_ELEMENTS and "." in rest:
        element, _, key = rest.rpartition(".")
        return table, _bare(element), key
    if not dot or table not in OF_MOTIONS:
        return tuple(name.strip().split("."))
    for ending in OF_WAVES:
        if rest.endswith(ending):
            return table, _bare(rest.removesuffix(ending)), ending[1:]
    return table, _bare(rest)


def _bare(name: str) -> str:
    """Return a name without quotes around it."""
    quoted = len(name) > 1 and name[0] == name[-1] and name[0] in "'\""
    return name[1:-1] if quoted else name
