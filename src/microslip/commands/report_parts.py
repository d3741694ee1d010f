"""What the sections of a report are, and to which scenes they apply."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene


@dataclass(frozen=True, slots=True)
class Part:
    """A section that a command makes."""

    command: str
    title: str
    about: str
    more: Sequence[str] = ()
    """options of the command"""
    quick: Sequence[str] | None = ()
    """in their place, for a quick look; None if there is none"""
    files: bool = True
    """whether it writes a picture where ``-o`` says"""
    scene: bool = True
    """whether it is told the scene"""
    tells: Sequence[str] = ()
    """how the lines begin, or end, that say its result; the last such line counts"""
    excuse: Callable[[Scene], str] = lambda _: ""
    """why it does not apply to a scene; empty if it does"""


def _no_rig(scene: Scene) -> str:
    """Return why what the rig alone has does not apply to a scene."""
    from microslip.scenes.two_blades.tables import TwoBlades

    if isinstance(scene.rig, TwoBlades):
        return ""
    return "This section is about the numbers of two blades, which this scene lacks."


def _one_sector(scene: Scene) -> str:
    """Return why one sector of a disk cannot be marched."""
    from microslip.scenes.bladed_disk.tables import BladedDisk

    if not isinstance(scene.rig, BladedDisk) or scene.rig.solve != "sector":
        return ""
    return (
        "This scene solves one sector of a disk, which cannot be marched in time: "
        "give --set solve=disk."
    )


PARTS = (
    Part(
        "frc",
        "The curve, with its stability",
        "Frequency response by harmonic balance, to the scene's tolerance, with its "
        "peaks, folds and changes of stability.",
        tells=("estimated error of amplitude",),
    ),
    Part(
        "sweep",
        "The sweep",
        "The sine test of the scene by time integration, with its energies.",
        ("--envelope",),
        ("--envelope",),
        tells=("  closing error", "  friction, error"),
        excuse=_one_sector,
    ),
    Part(
        "verify",
        "Do both solvers agree?",
        "Orbits of the curve found again by shooting; unless the report is quick, "
        "sweeps, slower and slower, beside the curve.",
        ("--slower", "1", "4"),
        ("--frequencies", "3", "--slower"),
        tells=("agree: largest", "DISAGREE"),
        excuse=_one_sector,
    ),
    Part(
        "precision",
        "Error against run time",
        "One periodic motion by every method at settings from loose to tight, beside a "
        "reference of two independent methods.",
        ("--quick",),
        ("--quick",),
        tells=("tightest runs", "too few methods"),
        excuse=_one_sector,
    ),
    Part(
        "tables",
        "Energy tables",
        "The energies that friction dissipates in the paper's Tables 4 and 5, for all "
        "variants of the built-in rig, beside microslip's own.",
        ("--quick",),
        None,
        files=False,
        scene=False,
        excuse=_no_rig,
    ),
    Part(
        "stress",
        "Stiff and extreme cases",
        "Each number of the scene at an extreme, by both solvers; values that are none "
        "must be refused.",
        ("--quick",),
        ("--quick",),
        tells=("converge in both",),
        excuse=_no_rig,
    ),
    Part(
        "explain",
        "What was left out",
        "What the solvers carry, what they would without leaving out what the scene "
        "does not need, and what that saves.",
        ("--time",),
        ("--time", "--set", "curve.harmonics=7"),
        files=False,
        tells=("unpruned, the curve takes", "DISAGREE"),
    ),
)
"""in the order in which they are made and shown"""
