"""microslip modes: natural frequency and damping against amplitude."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.modes_tables import ending_of, mode_table
from microslip.commands.written import written

if TYPE_CHECKING:
    from pathlib import Path

    from hbm.modes.mode_options import ModeOptions
    from hbm.modes.modes import NonlinearMode
    from microslip.progress import Watch
    from microslip.studies.modes import FollowedMode
    from microslip_mechanics.problem import Problem

COLUMNS = (
    "mode_hz",
    "amplitude_m",
    "frequency_hz",
    "damping_ratio",
    "frequency_error",
    "damping_error",
)
AMPLITUDES = (1e-2, 10.0)
"""smallest and largest [mm]"""
TOLERANCE = 1e-2
TIGHTEST, LOOSEST = 1e-6, 0.5
"""relative errors that can be asked for"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "modes",
        help="natural frequency and damping against amplitude",
        description="Follow the modes of free decaying motion of a scene from sticking "
        "to sliding contacts; print natural frequency and damping ratio against the "
        "amplitude of the highest probe, write SCENE-modes.csv and SCENE-modes.png. "
        "The damping ratio is what a cycle dissipates; an amplitude on which the "
        "frequency depends falls faster or more slowly (microslip decay tells both).",
        epilog="example: microslip modes two-blades --set model=A",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--amplitudes",
        type=arguments.millimetres,
        nargs=2,
        metavar=("SMALLEST", "LARGEST"),
        default=AMPLITUDES,
        help="of the sticking mode's share in the motion, as its highest probe has it, "
        "in mm unless a unit stands behind it; where contacts slide the shape changes, "
        "and the probe moves more or less than that (default: 0.01 10)",
    )
    parser.add_argument(
        "--range",
        type=arguments.hertz,
        nargs=2,
        metavar=("LOWEST", "HIGHEST"),
        help="natural frequencies, in Hz, of the modes that are followed, while their "
        "contacts stick (default: the range of the scene's curve)",
    )
    resolution = parser.add_mutually_exclusive_group()
    resolution.add_argument(
        "--tolerance",
        type=_tolerance,
        default=TOLERANCE,
        help="relative error of the damping ratio at each point, of the frequency a "
        "hundredth of it: harmonics and samples follow from it; where the mode does "
        "not go on with these it does with fewer, and with their error "
        f"(default: {TOLERANCE:g})",
    )
    resolution.add_argument(
        "--harmonics",
        type=arguments.whole(1, 127),
        metavar="N",
        help="fixed number instead, 1 to 127",
    )
    parser.add_argument(
        "--effort",
        type=arguments.positive,
        metavar="TIMES",
        default=1.0,
        help="work that a mode may take, over the usual, 30000 evaluations with 31 "
        "harmonics; then it goes on with fewer (default: 1)",
    )
    arguments.add_output(parser, "modes")
    parser.set_defaults(run=_run)


def _tolerance(text: str) -> float:
    number = arguments.positive(text)
    if not TIGHTEST <= number <= LOOSEST:
        raise argparse.ArgumentTypeError(
            f"{text}: give a number from {TIGHTEST:g} to {LOOSEST:g}"
        )
    return number


def _run(options: argparse.Namespace) -> int:
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.modes import ModeError, followed

    data, picture = arguments.outputs(options, "modes", ".csv", ".png")
    scene = load_scene(options.scene, options.overrides)
    lowest, highest = options.range or (scene.curve.lowest, scene.curve.highest)
    chosen = _chosen(options)
    frequencies = math.tau * lowest, math.tau * highest
    problem = problem_of(scene)
    state = _state(problem)
    modes: list[FollowedMode] = []
    interrupted = False
    try:
        for mode in followed(problem, frequencies, chosen, _watched(chosen)):
            modes.append(mode)
            interrupted = mode.ending == "interrupted"
            print("\n".join(mode_table(mode, state)), flush=True)
    except KeyboardInterrupt:
        interrupted = True
        if not any(mode.points for mode in modes):
            raise
    if not any(mode.points for mode in modes):
        raise ModeError(modes[0].ending)
    _keep(options, modes, data.with_suffix(".csv"), picture)
    return arguments.ended("interrupted" if interrupted else ending_of(modes))


def _watched(chosen: ModeOptions) -> Watch:
    """Return what shows the progress of a mode."""
    from microslip.progress import shown

    def done(point: NonlinearMode) -> float:
        return math.log10(point.amplitude / chosen.smallest)

    decades = math.log10(chosen.largest / chosen.smallest)
    return lambda points: shown(
        points, total=decades, done=done, unit="decades", name="mode"
    )


def _state(problem: Problem) -> str:
    """Return in words when a structure has the modes of its small motions."""
    from microslip_mechanics.contact.points import rubs

    sticks = rubs(problem.interface.points)
    return "while its contacts stick" if sticks else "in small motions"


def _chosen(options: argparse.Namespace) -> ModeOptions:
    """Return amplitudes and resolution.

    Raises
    ------
    SceneError
        If they make no sense.
    """
    from hbm.modes.mode_options import ModeOptions
    from microslip.scenes.quantity import SceneError
    from microslip_mechanics.quantity import apart

    if options.range and not options.range[0] < options.range[1]:
        low, high = apart(*options.range)
        raise SceneError(f"--range {low} {high}: give the lower frequency first")
    smallest, largest = options.amplitudes
    if not smallest < largest:
        low, high = apart(smallest, largest)
        raise SceneError(f"--amplitudes {low} {high}: give the smaller one first")
    amplitudes = 1e-3 * smallest, 1e-3 * largest
    chosen = ModeOptions(
        *amplitudes, error=options.tolerance, harmonics=options.harmonics
    )
    return replace(chosen, effort=options.effort * chosen.effort)


def _keep(
    options: argparse.Namespace, modes: list[FollowedMode], table: Path, picture: Path
) -> None:
    """Write table and picture."""
    from microslip.figures.modes import modes_figure
    from microslip.files.store import save_figure, save_table
    from microslip.mode_lines import mode_lines

    def save() -> None:
        rows = [
            (
                mode.linear.frequency / math.tau,
                point.amplitude,
                point.frequency / math.tau,
                point.damping,
                point.frequency_error,
                point.damping_error,
            )
            for mode in modes
            for point in mode.points
        ]
        save_table(table, COLUMNS, rows)

    with written(f"table in {table}", picture, save):
        save_figure(picture, modes_figure(mode_lines(modes), arguments.title(options)))
