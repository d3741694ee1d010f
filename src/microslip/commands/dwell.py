"""microslip dwell: a sine of one frequency until the motion is steady."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.sweep_tables import energy_table, estimates
from microslip.commands.written import written

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.scenes.scene import Scene
    from microslip.studies.dwell import Period
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.time_history import TimeHistory

TOLERANCE, PERIODS = 1e-4, 5000
MOST = 10**7
"""periods that may be asked for"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "dwell",
        help="sine of one frequency until the motion is steady",
        description="March the scene from rest under a sine of one frequency until its "
        "period map stands still; print amplitudes and energies, write SCENE-dwell.nc "
        "and SCENE-dwell.png. Exit status 1 if it is not steady in time.",
        epilog="example: microslip dwell two-blades --frequency 136.8",
    )
    arguments.add_scene(parser)
    add_frequency(parser, required=True)
    add_limits(parser)
    arguments.add_output(parser, "dwell")
    parser.set_defaults(run=_run)


def add_frequency(parser: argparse._ActionsContainer, *, required: bool) -> None:
    """Add the frequency of the drive."""
    parser.add_argument(
        "--frequency",
        type=arguments.hertz,
        required=required,
        metavar="HZ",
        help="of the drive [Hz]",
    )


def add_limits(parser: argparse.ArgumentParser) -> None:
    """Add when a dwell ends."""
    parser.add_argument(
        "--tolerance",
        type=arguments.share,
        default=TOLERANCE,
        help="estimated distance from the steady state, over the size of the motion, "
        f"at which the dwell ends (default: {TOLERANCE:g})",
    )
    parser.add_argument(
        "--most-periods",
        type=arguments.whole(1, MOST),
        default=PERIODS,
        metavar="N",
        help=f"periods after which it ends in any case (default: {PERIODS})",
    )


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.dwell import dwell_figure
    from microslip.files.store import save_figure
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip_mechanics.results.extremes import extremes
    from timedomain.record.closure import OPEN, closes

    data, picture = arguments.outputs(options, "dwell")
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    history, distances, ending = dwelled(options, scene, problem, data)
    title = f"{arguments.title(options)}, {options.frequency:.9g} Hz"
    with written(f"{len(distances)} periods in {data}", picture):
        print("\n".join(_lines(options, history, distances)))
        errors = estimates(history, extremes(history))
        print("\n".join([energy_table(history), *errors]))
        figure = dwell_figure(history, distances, options.tolerance, title)
        save_figure(picture, figure)
    if ending == "complete" and not closes(history):
        ending = f"{OPEN}: give a shorter march.time_step"
    return arguments.ended(ending)


def dwelled(
    options: argparse.Namespace, scene: Scene, problem: Problem, data: Path
) -> tuple[TimeHistory, list[float], str]:
    """March a dwell into a file; return it, the distances from steady and its ending.

    The file ends as "complete" only if the motion became steady.

    Raises
    ------
    SceneError
        If the scene has no drive: what rounding moves is never steady.
    """
    from microslip.files.recording import Recording
    from microslip.progress import shown
    from microslip.scenes.quantity import SceneError
    from microslip.studies.dwell import dwelling
    from microslip.studies.sweep import kept
    from microslip_mechanics.results.joined import joined

    if not problem.drive.any():
        raise SceneError(
            f"{scene.source}: nothing moves at any frequency: the scene has no drive, "
            "give it one"
        )
    recording = Recording(data, scene.text, options.command)
    blocks: list[TimeHistory] = []
    distances: list[float] = []

    def keep(period: Period) -> None:
        recording.keep(period.history)
        blocks.append(period.history)
        distances.append(period.distance)

    periods = dwelling(
        problem,
        math.tau * options.frequency,
        scene.march,
        tolerance=options.tolerance,
        most=options.most_periods,
    )
    bar = shown(
        periods,
        total=options.most_periods,
        done=lambda _: len(distances) + 1.0,
        unit="periods at most",
        name="dwell",
    )
    with recording:
        ending = kept(bar, keep)
        if ending == "complete" and distances[-1] > options.tolerance:
            ending = _unsteady(joined(blocks, ending), len(distances))
        recording.end(ending)
    return joined(blocks, ending), distances, ending


def _unsteady(history: TimeHistory, periods: int) -> str:
    """Return why a dwell did not become steady, and what may help."""
    from microslip.studies.dwell import repeats

    many = repeats(history, periods)
    if many:
        return (
            f"the motion repeats itself every {many} periods of the drive, not each: "
            "it is subharmonic, and no longer dwell makes it steady"
        )
    return (
        f"not steady after {periods} periods: give more --most-periods, a larger "
        "--tolerance, or a smaller march.time_step: its error may keep a motion from "
        "repeating itself"
    )


def _far(distance: float) -> str:
    """Return how far a motion is from the steady one, if that is known at all."""
    if not distance < math.inf:
        return "how far a steady state is cannot be told"
    if distance >= 1.0:
        return "a steady state, if there is one, is far"
    return f"estimated distance from the steady state {distance:.1e} of the motion"


def _lines(
    options: argparse.Namespace, history: TimeHistory, distances: list[float]
) -> list[str]:
    """Return how the dwell ended, and the amplitudes of its last period."""
    from microslip.studies.dwell import amplitudes, repeats

    steady, far = distances[-1] <= options.tolerance, _far(distances[-1])
    many = 0 if steady else repeats(history, len(distances))
    if many:
        far = f"it repeats itself every {many} periods"
    found = amplitudes(history, math.tau * options.frequency)
    return [
        f"{options.frequency:.9g} Hz: {'steady' if steady else 'NOT steady'} after "
        f"{len(distances)} periods, {history.time[-1]:.4g} s; {far}",
        "first harmonic of the last period [mm]",
        *(
            f"  {name:20s} {1e3 * amplitude:12.6g}"
            for name, amplitude in zip(history.probes, found, strict=True)
        ),
    ]
