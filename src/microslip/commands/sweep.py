"""microslip sweep: the experiment of a scene by time integration."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, cast

from microslip.commands import arguments
from microslip.commands.places import demand_apart, demand_place
from microslip.commands.sweep_tables import (
    energy_table,
    equal_steps,
    estimates,
    extreme_lines,
    parting,
)
from microslip.commands.written import written

if TYPE_CHECKING:
    from microslip.files.recording import Recording
    from microslip.progress import Watch
    from microslip.scenes.scene import Scene
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.checkpoint import Checkpoint
    from microslip_mechanics.results.envelope import Envelope
    from microslip_mechanics.results.time_history import TimeHistory


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
        help="of friction's energy and peak amplitude; 0 takes the scene's time step; "
        "a march of steps twice as long beside tells the error (default: 1e-3)",
    )
    arguments.add_output(parser, "sweep")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.loads import load_history
    from microslip.studies.sweep import kept, marched

    data, picture = _places(options)
    scene = load_scene(options.scene, options.overrides)
    problem, loads = problem_of(scene), load_history(scene)
    recording, end, envelope = _begun(options, scene, data)
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
    unit = "cycles" if envelope else "times"
    with written(f"{recording.rows} {unit} in {data}", picture):
        closed = _show(options, scene, problem, (data, picture))
    if ending == "complete" and not closed:
        ending = _open(options, problem)
    return arguments.ended(ending)


def _open(options: argparse.Namespace, problem: Problem) -> str:
    """Return what is said of a march whose energies do not balance."""
    from microslip_mechanics.contact.memory import beyond_motion
    from timedomain.record.closure import OPEN

    if not options.tolerance or beyond_motion(problem.interface.points):
        return f"{OPEN}: give a shorter march.time_step"
    return (
        f"{OPEN}: give a smaller --tolerance, or a shorter march.time_step with "
        "--tolerance 0"
    )


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
    from microslip.scenes.quantity import SceneError

    if options.resume is None:
        return arguments.outputs(options, "sweep")
    if options.output is not None:
        raise SceneError(
            f"-o {options.output}: a march goes on in the file that --resume names: "
            "leave -o out"
        )
    picture = options.resume.with_suffix(".png")
    demand_place(picture)
    demand_apart(picture, options.resume)
    return options.resume, picture


def _begun(
    options: argparse.Namespace, scene: Scene, data: Path
) -> tuple[Recording, Checkpoint | None, bool]:
    """Return the file, where its march goes on if it does, and if it is an envelope.

    Raises
    ------
    SceneError
        If the file has rows in time, and an envelope is asked for.
    """
    from microslip.files.recording import Recording, resumed
    from microslip.scenes.quantity import SceneError
    from microslip_mechanics.results.envelope import Envelope

    if options.resume is None:
        return Recording(data, scene.text, options.command), None, options.envelope
    recording, end = resumed(options.resume, scene.text)
    envelope = isinstance(end, Envelope)
    if options.envelope and not envelope:
        raise SceneError(
            f"{options.resume} has rows in time, no envelope: leave --envelope out"
        )
    return recording, end.checkpoint, envelope


def _show(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    paths: tuple[Path, Path],
) -> bool:
    """Print and draw what the file holds; return whether its energies balance."""
    from microslip.figures.result import result_figure
    from microslip.files.result_file import load, stretches
    from microslip.files.store import save_figure
    from microslip_mechanics.contact.memory import beyond_motion
    from microslip_mechanics.results.extremes import extremes, of_all
    from timedomain.record.closure import closes

    data, picture = paths
    result = cast("TimeHistory | Envelope", load(data, arguments.MOST_ROWS).result)
    print(energy_table(result))
    normals = problem.interface.displacement[::3]
    pairs = zip(problem.interface.names, normals, strict=True)
    pressed = [name for name, normal in pairs if normal.any()]
    found = of_all([extremes(each) for each in stretches(data)])
    equal = beyond_motion(problem.interface.points)
    errors = estimates(result, found)
    errors += parting(result, 0.0 if equal else options.tolerance)
    print("\n".join([*errors, *extreme_lines(result, found, pressed)]))
    if options.tolerance and equal:
        print(equal_steps(scene.march.time_step))
    save_figure(picture, result_figure(result, arguments.title(options)))
    return closes(result)


def watched(duration: float, name: str = "sweep") -> Watch:
    """Return what shows the progress of a march."""
    from microslip.progress import shown

    def done(block: TimeHistory | Envelope) -> float:
        return float(block.time[-1]) if block.time.size else 0.0

    return lambda blocks: shown(blocks, total=duration, done=done, unit="s", name=name)
