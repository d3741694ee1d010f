"""Does every curve come to its end? Laws, stiffness, threshold, friction and loads."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator
from dataclasses import dataclass

from microslip.quantity import SceneError
from microslip.rigs import problem_of
from microslip.scene_file import load_scene
from microslip.scene_tables import Scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.curve import trace_curve
from microslip.studies.gaps import uncovered
from microslip_mechanics.errors import MicroslipError

LAWS = ("coulomb", "gkf")
SIGMAS = (3e-9, 3e-7)
THRESHOLDS = (1e-2, 1e-4, 1e-6)
FRICTIONS = (0.0, 0.3, 5.0)
LOADS = tuple(itertools.product((0.01, 1.0, 100.0), (0.1, 1.0, 100.0)))
"""preload and drive [N]"""
QUICK = 10
"""every so-many-th case is enough for a quick look, in which no value is missing"""


@dataclass(frozen=True, slots=True)
class Case:
    """One combination of parameters."""

    law: str
    sigma: float
    threshold: float
    """V_lim [m/s]"""
    friction: float
    """µd; µs is twice that"""
    preload: float
    """[N]"""
    drive: float
    """[N]"""

    @property
    def overrides(self) -> tuple[str, ...]:
        """As ``--set`` takes them."""
        return (
            f"friction.law={self.law}",
            f"contact.sigma={self.sigma}",
            f"friction.threshold_velocity={self.threshold}",
            f"friction.mu_dynamic={self.friction}",
            f"friction.mu_static={2.0 * self.friction}",
            f"preload.force={self.preload}",
            f"excitation.force={self.drive}",
        )


@dataclass(frozen=True, slots=True)
class Attempt:
    """How a case went."""

    case: Case
    ending: str
    """"complete", or the cause"""
    points: int
    error: float
    """largest estimated error of amplitude"""
    gap: float
    """share of the range in which there is no curve"""
    seconds: float

    @property
    def whole(self) -> bool:
        """Whether the curve comes to its end, without a gap that matters."""
        return self.ending == "complete"


def cases(scene: Scene) -> list[Case]:
    """Return all combinations of the contact's values, each with three of the loads.

    Raises
    ------
    SceneError
        If the scene is not one of two blades, which alone has these numbers.
    """
    if not isinstance(scene.rig, TwoBlades):
        raise SceneError(
            "grid changes the numbers of two blades: give a scene of the kind "
            'scene = "two-blades"'
        )
    contacts = itertools.product(LAWS, SIGMAS, THRESHOLDS, FRICTIONS)
    return [
        Case(*contact, *LOADS[(number + number // 3 + 3 * turn) % len(LOADS)])
        for number, contact in enumerate(contacts)
        for turn in range(3)
    ]


def attempts(
    scene: str, overrides: tuple[str, ...], chosen: list[Case]
) -> Iterator[Attempt]:
    """Trace the curve of each case; a curve that cannot be traced is a result too.

    Raises
    ------
    KeyboardInterrupt
        After the attempt that is interrupted, which is a result as far as it went.
    """
    for case in chosen:
        began = time.perf_counter()
        points, error, gap = 0, 0.0, 1.0
        try:
            loaded = load_scene(scene, (*overrides, *case.overrides))
            traced = trace_curve(problem_of(loaded), loaded.curve)
            ending, points = traced.curve.ending, traced.curve.frequency.size
            error, gap = float(traced.curve.error.max()), uncovered(traced.curve)
        except (MicroslipError, ValueError, ArithmeticError, RuntimeWarning) as cause:
            ending = " ".join(str(cause).split())
        yield Attempt(case, ending, points, error, gap, time.perf_counter() - began)
        if ending == "interrupted":
            raise KeyboardInterrupt
