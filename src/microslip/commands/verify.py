"""microslip verify: whether harmonic balance and time integration agree."""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from microslip.commands import arguments, frc, sweep, verify_tables

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.experiments import Curve, Sweep
    from microslip.scene_tables import Scene
    from microslip.studies.curve import Traced
    from microslip.studies.orbits import Verdict
    from microslip.studies.verify import SweepAgreement
    from microslip_mechanics.problem import Problem
    from timedomain.verify import Agreement

SLOWEST, MOST = 1000.0, 10**7
"""times the length of the scene's sweep"""


@dataclass(frozen=True, slots=True)
class Found:
    """What was found so far; it stays when a march is stopped."""

    probes: tuple[str, ...]
    holds: bool = False
    """whether contacts may hold a force while they stick"""
    places: list[int] = field(default_factory=list)
    """of the orbits on the curve"""
    orbits: list[Verdict] = field(default_factory=list)
    marches: list[Agreement] = field(default_factory=list)
    sweeps: list[SweepAgreement] = field(default_factory=list)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "verify",
        help="check harmonic balance against time integration",
        description="Find orbits of harmonic balance again by shooting, stable or not, "
        "and march upward exponential sweeps over the scene's range, as fast as the "
        "scene's and slower, against the curve; write "
        "SCENE-verify.png. Exit status 1 if an amplitude differs by more than the "
        "tolerance or than the error estimates of both solvers explain, or if energy "
        "and envelope of the sweep do not approach the curve as it slows.",
        epilog="example: microslip verify two-blades --set model=B --frequencies 15",
    )
    arguments.add_scene(parser)
    arguments.add_output(parser, "verify")
    for name, kind, default, meaning in (
        ("--frequencies", arguments.whole(1, MOST), 9, "orbits along the curve, about"),
        (
            "--periods",
            arguments.whole(2, MOST),
            0,
            "also march so many periods from each orbit",
        ),
        (
            "--steps",
            arguments.whole(1, MOST),
            600,
            "time steps per period of that march",
        ),
        ("--tolerance", arguments.positive, 0.01, "relative deviation of amplitudes"),
    ):
        parser.add_argument(
            name, type=kind, default=default, help=f"{meaning} (default: {default})"
        )
    for name, meaning in (
        ("--branches", "also the branches that begin at branch points"),
        ("--detached", "also detached curves, sought by varying the drive"),
    ):
        parser.add_argument(name, action="store_true", help=meaning)
    parser.add_argument(
        "--slower",
        type=_slowness,
        nargs="*",
        default=[1.0, 4.0, 10.0],
        metavar="FACTOR",
        help="lengths of the sweeps over that of the scene, at most "
        f"{SLOWEST:g} (default: 1 4 10); none if no length is given",
    )
    parser.set_defaults(run=_run)


def _slowness(text: str) -> float:
    number = arguments.positive(text)
    if number > SLOWEST:
        raise argparse.ArgumentTypeError(
            f"{text} times as long is too long: give at most {SLOWEST:g}"
        )
    return number


def _run(options: argparse.Namespace) -> int:
    from microslip.quantity import SceneError
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene
    from microslip.studies.curve import Wanted, trace_curve
    from microslip_mechanics.contact.memory import beyond_motion

    _, picture = arguments.outputs(options, "verify")
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    if not problem.drive.any():
        raise SceneError(
            f"{options.scene}: no load varies: nothing vibrates, so there is nothing "
            "to verify: give a drive"
        )
    curve = scene.curve
    if options.slower:
        _check_covered(options, curve, scene.sweep)
    wanted = Wanted(options.branches, options.detached)
    bars = frc.watched(curve), frc.search_watched(curve)
    traced = trace_curve(problem, curve, bars[0], wanted, bars[1])
    if traced.searched is not None:
        print("\n".join(traced.searched.lines()))
    if traced.curve.ending != "complete":
        return arguments.ended(traced.curve.ending, kept=False)
    found = Found(problem.probes.names, beyond_motion(problem.interface.points))
    try:
        _orbits(options, problem, traced, found)
        _marches(options, problem, traced, found)
        _sweeps(options, scene, problem, traced, found.sweeps)
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=False)
    finally:
        _report(found)
    _draw(options, traced, found, picture)
    print(f"picture in {picture}")
    return _verdict(options, found)


def _check_covered(options: argparse.Namespace, curve: Curve, swept: Sweep) -> None:
    """Check that the curve is as wide as the sweep.

    Raises
    ------
    SceneError
        If it is not.
    """
    from microslip.quantity import SceneError

    if not (curve.lowest <= swept.lowest and swept.highest <= curve.highest):
        raise SceneError(
            f"{options.scene}: [curve] {curve.lowest:g} to {curve.highest:g} Hz does "
            f"not cover [sweep] {swept.lowest:g} to {swept.highest:g} Hz: give it the "
            "sweep's range, or leave the sweeps out by --slower without a value"
        )


def _orbits(
    options: argparse.Namespace, problem: Problem, traced: Traced, found: Found
) -> None:
    """Shoot; print what is found at once."""
    from microslip.progress import collected
    from microslip.studies.orbits import spread, verdicts

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


def _marches(
    options: argparse.Namespace, problem: Problem, traced: Traced, found: Found
) -> None:
    """March from the same orbits; what is found stays when the march is stopped."""
    from microslip.progress import collected
    from microslip.studies.verify import orbits

    if options.periods == 0:
        return
    responses = [traced.responses[place] for place in found.places]
    marches = orbits(
        problem, responses, periods=options.periods, steps_per_period=options.steps
    )
    for _ in collected(
        marches, found.marches, total=len(responses), unit="", name="marches"
    ):
        pass


def _sweeps(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    traced: Traced,
    found: list[SweepAgreement],
) -> None:
    """March the sweeps; what is found stays when a march is stopped."""
    from microslip.studies.sweep import swept_sine
    from microslip.studies.verify import sweep_agreement

    for slower in sorted(set(options.slower)):
        length = swept_sine(scene.sweep, slower=slower).duration
        watch = sweep.watched(length, f"sweep, {slower:g} times as long")
        found.append(
            sweep_agreement(scene, problem, traced.curve, slower=slower, watch=watch)
        )


def _report(found: Found) -> None:
    """Print what was found."""
    if found.orbits:
        print(verify_tables.ORBITS)
    for each in found.orbits:
        print(verify_tables.orbit_row(each))
    if found.marches:
        print(verify_tables.march_rows(found.marches, found.probes))
    if found.sweeps:
        print(verify_tables.sweep_rows(found.sweeps))


def _draw(
    options: argparse.Namespace, traced: Traced, found: Found, picture: Path
) -> None:
    import numpy as np

    from microslip.figures.agreement import agreement_figure
    from microslip.store import save_figure

    made = [each.comparison for each in found.orbits if each.comparison is not None]
    rubbing = [each for each in found.sweeps if each.rubs]
    figure = agreement_figure(
        traced.curve,
        (
            np.array([each.response.frequency for each in made]) / math.tau,
            np.array([each.found for each in made]).reshape(len(made), -1)
            if made
            else np.empty((0, len(traced.curve.probes))),
            np.array([each.difference for each in made]),
            np.array([each.admitted for each in made]),
        ),
        [
            (f"{s.slower:g} x as long", s.envelope_frequency, s.envelope[:, 0])
            for s in found.sweeps
        ],
        (
            np.array([each.slower for each in rubbing]),
            np.array([each.energy_error for each in rubbing]),
        ),
        arguments.title(options),
    )
    save_figure(picture, figure)


def _verdict(options: argparse.Namespace, found: Found) -> int:
    """Print whether the solvers agree; return the exit status."""
    from microslip.studies.orbits import too_many
    from microslip.studies.verify import falls

    print(verify_tables.orbits_said(found.orbits))
    agrees = not (too_many(found.orbits) or any(each.cause for each in found.orbits))
    if found.marches:
        said, stays = verify_tables.marches_said(
            found.marches, found.probes, options.tolerance
        )
        print(said)
        agrees &= stays
    slows = falls(found.sweeps)
    if len(found.sweeps) > 1:
        print(verify_tables.sweeps_said(found.sweeps, agree=slows, holds=found.holds))
    return 0 if agrees and slows else 1
