"""microslip decay: frequency and damping by amplitude from a free decay."""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from microslip.commands import arguments, dwell
from microslip.commands.decay_march import marched, recorded
from microslip.commands.decay_tables import COLUMNS, cycles, errors
from microslip.commands.written import discard, named, written
from microslip_mechanics.errors import MicroslipError

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.checkpoint import Checkpoint
    from microslip_mechanics.results.ring_down import RingDown
    from microslip_mechanics.results.time_history import TimeHistory

PERIODS = 300
LIMITS = {"tolerance": dwell.TOLERANCE, "most_periods": dwell.PERIODS}
"""of the dwell before the decay, where they are left out"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "decay",
        help="free decay: frequency and damping by amplitude",
        description="Drive the scene at one frequency until it is steady, or take the "
        "state at the end of a file; let the drive go, and measure natural frequency "
        "and damping ratio of each cycle of the decay, the latter by how the amplitude "
        "falls and by the energy that is lost, as modes has it; tell what they err by, "
        "from a second decay with steps twice as long; write SCENE-decay.csv, "
        "SCENE-decay.nc and SCENE-decay.png.",
        epilog="example: microslip decay two-blades --frequency 136.8",
    )
    arguments.add_scene(parser)
    begin = parser.add_mutually_exclusive_group(required=True)
    dwell.add_frequency(begin, required=False)
    begin.add_argument(
        "--from",
        type=Path,
        metavar="FILE",
        dest="file",
        help="march of the same scene at whose end the drive is let go",
    )
    dwell.add_limits(parser)
    parser.set_defaults(**dict.fromkeys(LIMITS))
    parser.add_argument(
        "--periods",
        type=arguments.whole(1, dwell.MOST),
        default=PERIODS,
        metavar="N",
        help=f"length of the decay in periods of the drive (default: {PERIODS})",
    )
    parser.add_argument(
        "--probe",
        help="whose decay is measured (default: the one that moves most)",
    )
    arguments.add_output(parser, "decay")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.decay import decay_figure
    from microslip.files.store import save_figure, save_table
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.decay import liveliest, measured, too_fast

    data, picture = arguments.outputs(options, "decay", ".nc", ".csv", ".png")
    table = data.with_suffix(".csv")
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    chosen = _chosen(options, problem)
    begin = _driven(options, scene, problem, data)
    history = recorded(options, scene, problem, begin, data)
    probe = liveliest(history) if chosen is None else chosen
    with named(f"decay in {data}"):
        decay = measured(problem, history, probe)
    if not decay.time.size:
        discard(table, picture)
        print(f"decay in {data}")
        return arguments.ended(_lost(problem, history, probe))
    columns = (
        *(decay.time, decay.amplitude, decay.frequency / math.tau),
        decay.damping,
        decay.energy_damping if decay.energy_damping.size else decay.time * math.nan,
    )
    with named(f"decay in {data}"):
        save_table(table, COLUMNS, zip(*columns, strict=True))
    title = f"{arguments.title(options)}, let go at {begin[1] / math.tau:.9g} Hz"
    with written(f"decay in {data}, table in {table}", picture):
        lost = too_fast(problem, history, probe)
        print("\n".join(cycles(decay, history.probes[probe], lost)))
        save_figure(picture, decay_figure(history, decay, probe, title))
    ending = history.ending
    if ending == "complete":
        ending = _tell_step_errors(options, scene, problem, begin, decay, probe)
    return arguments.ended(ending)


def _lost(problem: Problem, history: TimeHistory, probe: int) -> str:
    """Return how a decay ended of which nothing is measured."""
    from microslip.studies.decay import unmeasured

    if history.ending != "complete":
        return history.ending
    return unmeasured(problem, history, probe)


def _chosen(options: argparse.Namespace, problem: Problem) -> int | None:
    """Return the place of the probe that is asked for.

    Raises
    ------
    SceneError
        If there is no such probe.
    """
    from microslip.scenes.quantity import SceneError

    names = problem.probes.names
    if options.probe is None:
        return None
    if options.probe not in names:
        raise SceneError(f"--probe {options.probe}: give one of {', '.join(names)}")
    return names.index(options.probe)


def _driven(
    options: argparse.Namespace, scene: Scene, problem: Problem, data: Path
) -> tuple[Checkpoint, float]:
    """Return the state in which the drive is let go, and its frequency [rad/s]."""
    from microslip.files.recording import last_state

    _limit(options)
    if options.file is not None:
        return last_state(options.file, scene.text)
    history, _, ending = dwell.dwelled(options, scene, problem, data)
    if ending == "interrupted":
        print(f"motion before the decay in {data}")
        raise KeyboardInterrupt
    if ending != "complete":
        print(f"microslip: let go when {ending}", file=sys.stderr)
    if history.checkpoint is None:
        raise ValueError("the march does not tell its last state")
    return history.checkpoint, math.tau * options.frequency


def _limit(options: argparse.Namespace) -> None:
    """Take usual limits of the dwell where none are given.

    Raises
    ------
    SceneError
        If some are, but the state is that of a file.
    """
    from microslip.scenes.quantity import SceneError

    for name, usual in LIMITS.items():
        if getattr(options, name) is None:
            setattr(options, name, usual)
        elif options.file is not None:
            raise SceneError(
                f"--{name.replace('_', '-')} beside --from: the motion of a file has "
                "come to its end: leave one of them out"
            )


def _tell_step_errors(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    begin: tuple[Checkpoint, float],
    decay: RingDown,
    probe: int,
) -> str:
    """Print what a march with steps twice as long changes; return how it ended."""
    from microslip.studies.decay_errors import step_errors

    twice = replace(
        scene.march,
        time_step=2.0 * scene.march.time_step,
        store_every=max(1, scene.march.store_every // 2),
    )
    try:
        coarse = marched(
            options, twice, problem, begin, ("step errors", lambda _: None)
        )
        ending = coarse.ending
    except MicroslipError as error:
        ending = str(error)
    if ending == "interrupted":
        return ending
    said = f"not known: {ending}"
    if ending == "complete":
        said = errors(decay, *step_errors(problem, decay, coarse, probe))
    print(f"estimated error of time steps and rows: {said}")
    return "complete"
