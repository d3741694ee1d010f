"""What the sections of a report are, and to which scenes they apply."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from microslip.commands.report_excuses import (
    Excuse,
    first_of,
    lacks,
    no_drive,
    no_rig,
    one_sector,
)

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
    unswept: Sequence[str] | None = None
    """in their place, for a scene that cannot be swept; None if that does not matter"""
    files: bool = True
    """whether it writes a picture where ``-o`` says"""
    scene: bool = True
    """whether it is told the scene"""
    tells: Sequence[str] = ()
    """how the lines begin, or end, that say its result; the last of each counts"""
    excuse: Excuse = lambda _: ""
    """why it does not apply to a scene; empty if it does"""

    def suited(self, scene: Scene) -> Part:
        """Return the part as it suits a scene, swept or not."""
        if self.unswept is None or not lacks("sweep", "march")(scene):
            return self
        return replace(self, more=self.unswept)


PARTS = (
    Part(
        "frc",
        "The curve, with its stability",
        "Frequency response by harmonic balance, to the scene's tolerance, with its "
        "peaks, folds and changes of stability.",
        tells=("largest amplitude that was found", "estimated error of amplitude"),
        excuse=lacks("curve"),
    ),
    Part(
        "sweep",
        "The sweep",
        "The sine test of the scene by time integration, with its energies.",
        ("--envelope",),
        ("--envelope",),
        tells=("  friction, error", "  closing error"),
        excuse=first_of(one_sector, lacks("sweep", "march")),
    ),
    Part(
        "verify",
        "Do both solvers agree?",
        "Orbits of the curve found again by shooting; unless the report is quick, "
        "sweeps, slower and slower, beside the curve, if the scene has any.",
        ("--slower", "1", "4"),
        ("--frequencies", "3", "--slower"),
        unswept=("--slower",),
        tells=("agree: largest", "DISAGREE"),
        excuse=first_of(one_sector, lacks("curve"), no_drive),
    ),
    Part(
        "precision",
        "Error against run time",
        "One periodic motion by every method at settings from loose to tight, beside a "
        "reference of two independent methods.",
        ("--quick",),
        ("--quick",),
        tells=("tightest runs", "too few methods"),
        excuse=first_of(one_sector, lacks("curve"), no_drive),
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
        excuse=no_rig,
    ),
    Part(
        "stress",
        "Stiff and extreme cases",
        "Each number of the scene at an extreme, by both solvers; values that are none "
        "must be refused.",
        ("--quick",),
        ("--quick",),
        tells=("converge in both",),
        excuse=first_of(no_rig, lacks("curve", "march")),
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
        excuse=lacks("curve"),
    ),
)
"""in the order in which they are made and shown"""
