"""microslip sweep: the experiment of a scene by time integration."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, cast

from microslip.commands import arguments

if TYPE_CHECKING:
    from microslip.progress import Watch
    from microslip.recording import Recording
    from microslip.scene_tables import Scene
    from microslip_mechanics.envelope import Envelope
    from microslip_mechanics.time_history import Checkpoint, TimeHistory


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "sweep",
        help="swept or stepped sine, or any force, by time integration",
        description="March the scene through the loads of its sweep table; print "
        "energies and extremes, write SCENE-sweep.nc, block by block, and "
        "SCENE-sweep.png.",
        epilog="example: microslip sweep two-blades --set sweep.direction=up-down",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--envelope",
        action="store_true",
        help="write the extremes of each cycle instead of rows in time: for long runs",
    )
    parser.add_argument(
        "--resume",
        type=Path,
        metavar="FILE",
        help="go on with the march that a stopped sweep of the same scene left there",
    )
    parser.add_argument(
        "--tolerance",
        type=_tolerance,
        default=1e-3,
        metavar="SHARE",
        help="of friction's energy and peak amplitude; 0 takes the scene's time step, "
        "and steps twice as long beside, which tell the error (default: 1e-3)",
    )
    arguments.add_output(parser, "sweep")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.recording import Recording
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene
    from microslip.studies.loads import load_history
    from microslip.studies.sweep import kept, marched
    from microslip_mechanics.contact.memory import beyond_motion

    data, picture = _places(options)
    scene = load_scene(options.scene, options.overrides)
    problem, loads = problem_of(scene), load_history(scene)
    recording, end = Recording(data, scene.text, options.command), None
    envelope = options.envelope
    if options.resume is not None:
        recording, end, envelope = _resumed(options, scene)
    blocks = marched(
        problem,
        loads,
        scene.march,
        envelope=envelope,
        end=end,
        tolerance=options.tolerance or None,
    )
    with recording:
        ending = kept(watched(loads.duration)(blocks), recording.keep)
        recording.end(ending)
    closed = _show(options, data, picture)
    unit = "cycles" if envelope else "times"
    print(f"{recording.rows} {unit} in {data}, picture in {picture}")
    if options.tolerance and beyond_motion(problem.interface.points):
        print(
            "contacts that remember or are rigid are marched with the scene's steps, "
            f"{scene.march.time_step:g} s, and no tolerance"
        )
    if ending == "complete" and not closed:
        ending = (
            "the energy balance does not close, so the march is wrong: give a smaller "
            "--tolerance, or a shorter march.time_step with --tolerance 0"
        )
    return arguments.ended(ending)


def _tolerance(text: str) -> float:
    """Return a tolerance, or 0 for none."""
    from timedomain.options import FINEST

    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if value != 0.0 and not FINEST <= value < 1.0:
        raise argparse.ArgumentTypeError(
            f"{text}: give one between {FINEST:g} and 1, such as 1e-3, or 0 for none"
        )
    return value


def _places(options: argparse.Namespace) -> tuple[Path, Path]:
    """Return the paths of data and picture; those of a march that goes on stay.

    Raises
    ------
    SceneError
        If a march is to go on in another file.
    """
    from microslip.quantity import SceneError

    if options.resume is None:
        return arguments.outputs(options, "sweep")
    if options.output is not None:
        raise SceneError(
            f"-o {options.output}: a march goes on in the file that --resume names: "
            "leave -o out"
        )
    return options.resume, options.resume.with_suffix(".png")


def _resumed(
    options: argparse.Namespace, scene: Scene
) -> tuple[Recording, Checkpoint | None, bool]:
    """Return the file that goes on, where its march stood, and if it is an envelope.

    Raises
    ------
    SceneError
        If the file has rows in time, and an envelope is asked for.
    """
    from microslip.quantity import SceneError
    from microslip.recording import resumed
    from microslip_mechanics.envelope import Envelope

    recording, end = resumed(options.resume, scene.text)
    envelope = isinstance(end, Envelope)
    if options.envelope and not envelope:
        raise SceneError(
            f"{options.resume} has rows in time, no envelope: leave --envelope out"
        )
    return recording, end.checkpoint, envelope


def _show(options: argparse.Namespace, data: Path, picture: Path) -> bool:
    """Print and draw what the file holds; return whether its energies balance."""
    from microslip.figures.result import result_figure
    from microslip.result_file import load
    from microslip.store import save_figure
    from timedomain.closure import closes

    result = cast("TimeHistory | Envelope", load(data, arguments.MOST_ROWS).result)
    save_figure(picture, result_figure(result, arguments.title(options)))
    print(energy_table(result))
    print("\n".join([*estimates(result), *_extremes(result)]))
    return closes(result)


def watched(duration: float, name: str = "sweep") -> Watch:
    """Return what shows the progress of a march."""
    from microslip.progress import shown

    def done(block: TimeHistory | Envelope) -> float:
        return float(block.time[-1]) if block.time.size else 0.0

    return lambda blocks: shown(blocks, total=duration, done=done, unit="s", name=name)


def energy_table(result: TimeHistory | Envelope) -> str:
    """Return energies and the closing error of their balance."""
    lines = [f"energy until {result.time[-1]:g} s [J]"]
    lines += [
        f"  {name.replace('_', ' '):20s} {result.of(name)[-1]:12.6g}"
        for name in result.energies
    ]
    closing = abs(result.closing_error).max()
    share = closing / max(abs(result.of("input")).max(), 1e-300)
    lines.append(f"  {'closing error':20s} {closing:12.2g}  ({share:.1e} of the input)")
    return "\n".join(lines)


def estimates(result: TimeHistory | Envelope) -> list[str]:
    """Return lines of the estimated errors, as far as the result tells them."""
    from microslip_mechanics.envelope import Envelope

    if isinstance(result, Envelope) or not result.energy_error.size:
        return []
    friction, lines = abs(result.of("friction")[-1]), []
    for name, values in (
        ("friction, error", result.energy_error),
        ("quadrature - work", result.work_difference),
    ):
        for value in values[-1:]:
            share = f"  ({value / friction:.1e} of it)" if friction else ""
            lines.append(f"  {name:20s} {value:12.2g}{share}")
    peak = f"estimated error of the peak amplitude {result.peak_error[-1]:.1e}"
    return [*lines, peak]


def _extremes(result: TimeHistory | Envelope) -> list[str]:
    """Return lines of the extremes of displacements, velocities and forces."""
    from microslip_mechanics.envelope import Envelope

    if isinstance(result, Envelope):
        moved, moving = (result.lowest, result.highest), result.fastest
        normal = result.normal_smallest, result.normal_largest
    else:
        moved, moving = (result.displacement,) * 2, result.velocity
        normal = (result.normal_force,) * 2
    lines = ["largest displacement [mm] and velocity [m/s]"]
    for place, name in enumerate(result.probes):
        far = 1e3 * max(abs(each[:, place]).max() for each in moved)
        fast = abs(moving[:, place]).max()
        lines.append(f"  {name:20s} {far:12.6g} {fast:12.6g}")
    lines.append("normal force [N], least and most")
    for place, name in enumerate(result.contacts):
        least, most = normal[0][:, place].min(), normal[1][:, place].max()
        lines.append(f"  {name:20s} {least:12.6g} {most:12.6g}")
    if result.divided:
        lines.append(f"{result.divided} steps converged only when divided")
    return lines
