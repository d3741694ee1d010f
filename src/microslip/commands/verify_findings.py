"""What microslip verify has found: told, drawn and judged."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from microslip.commands.verify_marches import march_rows, marches_said
from microslip.commands.verify_orbits import orbit_rows, orbits_said
from microslip.commands.verify_sweeps import sweep_rows, sweeps_said

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.studies.verify.orbits import Verdict
    from microslip.studies.verify.verify import SweepAgreement
    from microslip_mechanics.results.response_curve import ResponseCurve
    from timedomain.verify import Agreement


@dataclass(frozen=True, slots=True)
class Findings:
    """What was found so far; it stays when a march is stopped."""

    probes: tuple[str, ...]
    holds: bool = False
    """whether contacts may hold a force while they stick"""
    places: list[int] = field(default_factory=list)
    """of the orbits on the curve"""
    orbits: list[Verdict] = field(default_factory=list)
    marches: list[Agreement] = field(default_factory=list)
    sweeps: list[SweepAgreement] = field(default_factory=list)


def report(found: Findings) -> None:
    """Print what was found."""
    if found.orbits:
        print(orbit_rows(found.orbits))
    if found.marches:
        print(march_rows(found.marches, found.probes))
    if found.sweeps:
        print(sweep_rows(found.sweeps))


def draw(found: Findings, curve: ResponseCurve, picture: Path, title: str) -> None:
    """Draw the findings beside the curve into a file."""
    import numpy as np

    from microslip.figures.agreement import agreement_figure
    from microslip.files.store import save_figure

    made = [each.comparison for each in found.orbits if each.comparison is not None]
    rubbing = [each for each in found.sweeps if each.rubs]
    figure = agreement_figure(
        curve,
        (
            np.array([each.response.frequency for each in made]) / math.tau,
            np.array([each.found for each in made]).reshape(len(made), -1)
            if made
            else np.empty((0, len(curve.probes))),
            np.array([each.difference for each in made]),
            np.array([each.admitted for each in made]),
        ),
        [
            (f"{s.slower:g} x as long", s.envelope_frequency, s.envelope)
            for s in found.sweeps
        ],
        (
            np.array([each.slower for each in rubbing]),
            np.array([each.energy_error for each in rubbing]),
        ),
        title,
    )
    save_figure(picture, figure)


def verdict(found: Findings, tolerance: float) -> int:
    """Print whether the solvers agree; return the exit status."""
    from microslip.studies.verify.orbits import too_many
    from microslip.studies.verify.verify import falls

    print(orbits_said(found.orbits))
    agrees = not (too_many(found.orbits) or any(each.cause for each in found.orbits))
    if found.marches:
        said, stays = marches_said(found.marches, found.probes, tolerance)
        print(said)
        agrees &= stays
    slows = falls(found.sweeps)
    if len(found.sweeps) > 1:
        print(sweeps_said(found.sweeps, agree=slows, holds=found.holds))
    return 0 if agrees and slows else 1
