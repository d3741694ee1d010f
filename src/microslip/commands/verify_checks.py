"""The checks of microslip verify: orbits are shot, marched, and swept through."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import sweep

if TYPE_CHECKING:
    from microslip.commands.verify_findings import Findings
    from microslip.scenes.scene import Scene
    from microslip.studies.curve import Traced
    from microslip.studies.verify.verify import SweepAgreement
    from microslip_mechanics.problem import Problem

STEPS = 600
"""per period of a march, unless other ones are given"""


def check_orbits(
    options: argparse.Namespace, problem: Problem, traced: Traced, found: Findings
) -> None:
    """Shoot; print what is found at once."""
    from microslip.progress import collected
    from microslip.studies.verify.orbits import spread, verdicts

    places = spread(traced, options.frequencies)
    found.places.extend(places)
    for _ in collected(
        verdicts(problem, traced, places, tolerance=options.tolerance),
        found.orbits,
        total=len(places),
        unit="",
        name="orbits",
    ):
        pass


def check_marches(
    options: argparse.Namespace, problem: Problem, traced: Traced, found: Findings
) -> None:
    """March from the same orbits; what is found stays when the march is stopped."""
    from microslip.progress import collected
    from microslip.studies.verify.verify import orbits

    if options.periods == 0:
        return
    responses = [traced.responses[place] for place in found.places]
    steps = options.steps or STEPS
    marches = orbits(
        problem, responses, periods=options.periods, steps_per_period=steps
    )
    for _ in collected(
        marches, found.marches, total=len(responses), unit="", name="marches"
    ):
        pass


def check_sweeps(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    traced: Traced,
    found: list[SweepAgreement],
) -> None:
    """March the sweeps; what is found stays when a march is stopped."""
    from microslip.studies.sweep import swept_sine
    from microslip.studies.verify.verify import sweep_agreement

    for slower in sorted(set(options.slower)):
        length = swept_sine(scene.sweep, slower=slower).duration
        watch = sweep.watched(length, f"sweep, {slower:g} times as long")
        found.append(
            sweep_agreement(scene, problem, traced.curve, slower=slower, watch=watch)
        )
