"""Does every curve come to its end? Laws, stiffness, threshold, friction and loads."""

from __future__ import annotations

import contextlib
import itertools
import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from microslip.errors import EXPECTED, one_line
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.bounded import bounded
from microslip.studies.clock import LATE, OutOfTimeError, limited
from microslip.studies.curve import trace_curve
from microslip.studies.gaps import missing

LAWS = ("coulomb", "gkf")
SIGMAS = (3e-9, 3e-7)
THRESHOLDS = (1e-2, 1e-4, 1e-6)
FRICTIONS = (0.0, 0.3, 5.0)
LOADS = tuple(itertools.product((0.01, 1.0, 100.0), (0.1, 1.0, 100.0)))
"""preload and drive [N]"""
QUICK = 10
"""every so-many-th case is enough for a quick look, in which no value is missing"""
PATIENCE = 1.5
"""times as long may pass until its process is ended, where nothing interrupts it"""


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
    """of processor time"""

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


def demand_free(overrides: Sequence[str], chosen: Sequence[Case]) -> None:
    """Check that no override is lost: the grid gives its own numbers their values.

    Raises
    ------
    SceneError
        If one is.
    """
    varied = {each.partition("=")[0] for case in chosen for each in case.overrides}
    for override in overrides:
        name = override.partition("=")[0].strip()
        if name in varied:
            raise SceneError(
                f"--set {override}: grid gives {name} its own values: leave it out"
            )


def attempts(
    scene: str,
    overrides: Sequence[str],
    chosen: Sequence[Case],
    *,
    seconds: float,
    processes: int,
) -> Iterator[Attempt]:
    """Trace the curves of cases, several at the same time; yield them as they end.

    A curve that cannot be traced is a result too. One that takes more than ``seconds``
    of processor time ends there.
    """
    for ended in bounded(
        partial(_attempted, scene, tuple(overrides), seconds),
        chosen,
        seconds=lambda _: PATIENCE * seconds,
        processes=processes,
        prepare=partial(_prepare, scene, tuple(overrides)),
    ):
        lost = Attempt(ended.item, ended.cause, 0, 0.0, 1.0, ended.seconds)
        yield lost if ended.cause else ended.result


def _prepare(scene: str, overrides: tuple[str, ...]) -> None:
    """Have the machine code made, as far as the scene lets it."""
    with contextlib.suppress(*EXPECTED):
        loaded = load_scene(scene, (*overrides, "curve.harmonics=3"))
        trace_curve(
            problem_of(loaded), loaded.curve, lambda points: itertools.islice(points, 2)
        )


def _attempted(
    scene: str, overrides: tuple[str, ...], seconds: float, case: Case, _: float
) -> Iterator[Attempt]:
    """Yield how a case went."""
    began = time.process_time()
    points, error, gap = 0, 0.0, 1.0
    try:
        loaded = load_scene(scene, (*overrides, *case.overrides))
        problem = problem_of(loaded)
        with limited(seconds):
            curve = trace_curve(problem, loaded.curve).curve
        ending, points = curve.ending, curve.frequency.size
        error = float(curve.error.max())
        gap = missing(
            curve, math.tau * loaded.curve.lowest, math.tau * loaded.curve.highest
        )
    except (*EXPECTED, OutOfTimeError) as cause:
        ending = one_line(cause)
    if ending == LATE:
        ending = f"{LATE} after {seconds:g} s"
    yield Attempt(case, ending, points, error, gap, time.process_time() - began)
