"""Why a section of a report does not apply to a scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene

Excuse: TypeAlias = "Callable[[Scene], str]"
"""what tells it; empty if the section does apply"""


def first_of(*excuses: Excuse) -> Excuse:
    """Return the first of several excuses that a scene has."""

    def excuse(scene: Scene) -> str:
        told = (each(scene) for each in excuses)
        return next(filter(None, told), "")

    return excuse


def lacks(*tables: str) -> Excuse:
    """Return the excuse of a scene that leaves tables out which a section needs."""

    def excuse(scene: Scene) -> str:
        missing = [t for t in tables if getattr(scene.experiments, t) is None]
        names = " and no ".join(f"[{each}]" for each in missing)
        return f"This scene has no {names}." if missing else ""

    return excuse


def no_rig(scene: Scene) -> str:
    """Return why what the rig alone has does not apply to a scene."""
    from microslip.scenes.two_blades.tables import TwoBlades

    if isinstance(scene.rig, TwoBlades):
        return ""
    return "This section is about the numbers of two blades, which this scene lacks."


def one_sector(scene: Scene) -> str:
    """Return why one sector of a disk cannot be marched."""
    from microslip.scenes.bladed_disk.tables import BladedDisk

    if not isinstance(scene.rig, BladedDisk) or scene.rig.solve != "sector":
        return ""
    return (
        "This scene solves one sector of a disk, which cannot be marched in time: "
        "give --set solve=disk."
    )


def no_drive(scene: Scene) -> str:
    """Return why there is no motion to look at.

    Empty, too, if the scene makes no problem, which its other sections tell.
    """
    from microslip.errors import EXPECTED
    from microslip.scenes.rigs import problem_of

    try:
        still = not problem_of(scene).drive.any()
    except EXPECTED:
        return ""
    return "Nothing drives this scene: it does not vibrate." if still else ""
