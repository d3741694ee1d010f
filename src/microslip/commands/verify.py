"""microslip verify: whether harmonic balance and time integration agree."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments, frc
from microslip.commands.report_excuses import lacks
from microslip.commands.residual_range import residual_range
from microslip.commands.verify_checks import (
    STEPS,
    check_marches,
    check_orbits,
    check_sweeps,
)
from microslip.commands.verify_findings import Findings, draw, report, verdict

if TYPE_CHECKING:
    from microslip.scenes.experiments import Curve, Sweep
    from microslip.scenes.scene import Scene
    from microslip.studies.curve import Traced
    from microslip_mechanics.problem import Problem

USUAL = [1.0, 4.0, 10.0]
"""times the length of the scene's sweep, if none are given"""
SLOWEST, MOST = 1000.0, 10**7
"""times the length of the scene's sweep, and numbers of what is counted"""


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
    _add_options(parser)
    parser.set_defaults(run=_run)


def _add_options(parser: argparse.ArgumentParser) -> None:
    """Add what is checked: orbits, marches, curves and sweeps."""
    for name, kind, default, meaning in (
        ("--frequencies", arguments.whole(1, MOST), 9, "orbits along the curve, about"),
        (
            "--periods",
            arguments.whole(2, MOST),
            0,
            "also march so many periods from each orbit",
        ),
        ("--tolerance", arguments.share, 0.01, "relative deviation of amplitudes"),
    ):
        parser.add_argument(
            name, type=kind, default=default, help=f"{meaning} (default: {default})"
        )
    parser.add_argument(
        "--steps",
        type=arguments.whole(1, MOST),
        help=f"time steps per period of that march (default: {STEPS})",
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
        metavar="FACTOR",
        help="lengths of the sweeps over that of the scene, at most "
        f"{SLOWEST:g} (default: 1 4 10, none if the scene has no sweep); none if no "
        "length is given",
    )


def _slowness(text: str) -> float:
    number = arguments.positive(text)
    if number > SLOWEST:
        raise argparse.ArgumentTypeError(
            f"{text} times as long is too long: give at most {SLOWEST:g}"
        )
    return number


def _run(options: argparse.Namespace) -> int:
    from microslip.scenes.quantity import SceneError
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.march_size import demand_dense
    from microslip_mechanics.contact.memory import beyond_motion

    _, picture = arguments.outputs(options, "verify", ".png")
    _check_asked(options)
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    demand_dense(problem)
    if not problem.drive.any():
        raise SceneError(
            f"{options.scene}: no load varies: nothing vibrates, so there is nothing "
            "to verify: give a drive"
        )
    if options.slower is None:
        options.slower = _usual(scene)
    if options.slower:
        _check_covered(options, scene.curve, scene.sweep)
    traced = _traced(options, problem, scene.curve)
    if traced.curve.ending != "complete":
        return arguments.ended(traced.curve.ending, kept=False)
    found = Findings(problem.probes.names, beyond_motion(problem.interface.points))
    try:
        check_orbits(options, problem, traced, found)
        check_marches(options, problem, traced, found)
        check_sweeps(options, scene, problem, traced, found.sweeps)
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=False)
    finally:
        report(found)
    status = verdict(found, options.tolerance)
    draw(found, traced.curve, picture, arguments.title(options))
    print(f"picture in {picture}")
    return status


def _usual(scene: Scene) -> list[float]:
    """Return the lengths of sweeps if none are given: none where none is described."""
    excuse = lacks("sweep", "march")(scene)
    if excuse:
        print(f"{excuse} Orbits alone are verified.")
    return [] if excuse else USUAL


def _check_asked(options: argparse.Namespace) -> None:
    """Check that the march exists whose steps are given.

    Raises
    ------
    SceneError
        If it does not.
    """
    from microslip.scenes.quantity import SceneError

    if options.steps is not None and not options.periods:
        raise SceneError(
            f"--steps {options.steps}: they are those of the march that --periods asks "
            "for: give that too, or leave them out"
        )


def _check_covered(options: argparse.Namespace, curve: Curve, swept: Sweep) -> None:
    """Check that the curve is as wide as the sweep.

    Raises
    ------
    SceneError
        If it is not.
    """
    from microslip.scenes.quantity import SceneError
    from microslip_mechanics.quantity import apart

    if not (curve.lowest <= swept.lowest and swept.highest <= curve.highest):
        (first, begin), (last, end) = (
            apart(curve.lowest, swept.lowest),
            apart(curve.highest, swept.highest),
        )
        raise SceneError(
            f"{options.scene}: [curve] {first} to {last} Hz does not cover [sweep] "
            f"{begin} to {end} Hz: give it the sweep's range, or leave the sweeps out "
            "by --slower without a value"
        )


def _traced(options: argparse.Namespace, problem: Problem, curve: Curve) -> Traced:
    """Trace the curve; print where others were sought, and where it is not unique."""
    from microslip.studies.curve import Wanted, trace_curve

    wanted = Wanted(options.branches, options.detached, residual_range=True)
    bars = frc.watched(curve), frc.search_watched
    traced = trace_curve(problem, curve, bars[0], wanted, bars[1])
    searched = [] if traced.searched is None else traced.searched.lines()
    for line in (*searched, *residual_range(traced.curve)):
        print(line)
    return traced
