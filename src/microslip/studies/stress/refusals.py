"""Bad values under stress: each is refused in a line, or computed to a finite end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from microslip.errors import EXPECTED, one_line
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.clock import OutOfTimeError, limited
from microslip.studies.curve import trace_curve
from microslip.studies.stress.case import Case
from microslip.studies.stress.finding import Finding, Outcome
from microslip_mechanics.problem import Problem

LARGE = "1e308"
"""the bad value that is a number, which may be computed to a finite end"""
SECONDS = 1.0
"""of processor time for the curve of it"""


def refusals(scene: str, overrides: tuple[str, ...], case: Case) -> Iterator[Finding]:
    """Yield whether each bad value is refused in a line, or computed to the end."""
    refused, computed, wrong = 0, 0, []
    for each in case.refusals:
        try:
            loaded = load_scene(scene, (*overrides, *each))
            problem = problem_of(loaded)
            finite = case.parameter == LARGE and _finite(problem, loaded)
        except (*EXPECTED, OutOfTimeError) as error:
            named = isinstance(error, SceneError) or case.parameter == LARGE
            if named and len(str(error).splitlines()) <= 1:
                refused += 1
            else:
                wrong.append(f"{each[0]}: {one_line(error)}")
        else:
            computed += finite
            if not finite:
                wrong.append(f"{each[0]}: taken as it is")
        outcome = Outcome.DISAGREES if wrong else Outcome.REFUSED
        counts = f"{refused} refused" + (f", {computed} computed" if computed else "")
        yield Finding(outcome, "; ".join((counts, *wrong)), compared=refused + computed)


def _finite(problem: Problem, loaded: Scene) -> bool:
    """Return whether the curve of a scene is finite as far as it goes."""
    curve = replace(loaded.curve, harmonics=3, samples=64)
    with limited(SECONDS):
        traced = trace_curve(problem, curve)
    return bool(np.isfinite(traced.curve.amplitude).all())
