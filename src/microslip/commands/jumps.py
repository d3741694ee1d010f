"""microslip jumps: where slow sweeps jump, beside the folds of the curve."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments, frc
from microslip.commands.columns import hertz
from microslip.commands.verify_sweeps import HELD
from microslip_mechanics.errors import MicroslipError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from microslip.studies.curve import Traced
    from microslip.studies.jumps.jumps import Jump

HEADER = """\
     fold  sweep     rate     jump  behind the fold
     [Hz]          [Hz/s]     [Hz]             [Hz]"""
SPREAD = 3.0
"""errors of the fit within which a jump is on its fold"""
HARMONICS = 1e-4
"""of a fold's frequency, by which it may be off whatever its estimated error"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "jumps",
        help="where swept sines jump, against the folds of the curve",
        description="Trace the curve of a scene; sweep through each fold at which a "
        "stable motion ends, at several rates, up or down; extrapolate the jump to no "
        "rate, compare it with the fold; write SCENE-jumps.png. Exit status 1 if one "
        f"is further from its fold than {SPREAD:g} errors of the fit, the error of "
        f"time steps and that of the fold, at least {HARMONICS:g} of it; a curve "
        "without folds is told, and is 0.",
        epilog="example: microslip jumps two-blades --set model=A --set "
        "friction.law=gkf --set excitation.force=1.9",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--rates",
        type=arguments.positive,
        nargs="+",
        metavar="HZ_PER_S",
        help="of the sweeps, four or more (default: 2.2e-5, a half, a quarter and an "
        "eighth of it, times the square of a fold's frequency: 0.4 at 135 Hz)",
    )
    parser.add_argument(
        "--lead",
        type=arguments.share,
        default=0.008,
        help="how far before a fold sweeps begin, and how far behind it they end if "
        "nothing jumps, over its frequency (default: 0.008)",
    )
    arguments.add_output(parser, "jumps")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.scenes.quantity import SceneError
    from microslip.scenes.rigs import problem_of
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.curve import trace_curve
    from microslip.studies.jumps.folds import folds_of
    from microslip.studies.jumps.jumps import LEAST, jumps
    from microslip_mechanics.contact.memory import beyond_motion

    if options.rates is not None and len(set(options.rates)) < LEAST:
        raise SceneError(f"--rates: give at least {LEAST} different ones")
    _, picture = arguments.outputs(options, "jumps", ".png")
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    traced = trace_curve(problem, scene.curve, frc.watched(scene.curve))
    if traced.curve.ending != "complete":
        return arguments.ended(traced.curve.ending, kept=False)
    folds = folds_of(problem, traced, lead=options.lead)
    if not folds:
        print("no stable motion ends at a fold: sweeps do not jump")
        return 0
    print(HEADER)
    found, ending = _collected(jumps(problem, folds, options.rates), len(folds))
    agree = all(_agrees(each) for each in found if each.whole)
    if not agree and beyond_motion(problem.interface.points):
        print(HELD)
    _draw(options, traced, found, picture)
    print(f"picture in {picture}")
    return arguments.ended(ending) or (0 if agree else 1)


def _collected(swept: Iterator[Jump], count: int) -> tuple[list[Jump], str]:
    """Print jumps at so many folds as they come; return them, and how they ended."""
    from microslip.progress import collected

    found: list[Jump] = []
    try:
        for each in collected(
            swept,
            found,
            total=count,
            unit="folds",
            name="jumps",
        ):
            print(_lines(each), flush=True)
    except (KeyboardInterrupt, MicroslipError) as error:
        if not found:
            raise
        interrupted = isinstance(error, KeyboardInterrupt)
        return found, "interrupted" if interrupted else str(error)
    return found, "complete"


def _lines(jump: Jump) -> str:
    """Return the jumps at one fold, and what follows, as lines."""
    way, seen = "up" if jump.fold.upward else "down", [jump.fold.hertz]
    fold = f"{hertz(jump.fold.hertz, seen):>9}  {way:5s}"
    rows = [
        f"{fold} {rate:8.3g} {hertz(place, seen):>8} {_late(jump, place):16.2e}"
        for rate, place in zip(jump.rates, jump.frequency, strict=True)
    ]
    if not jump.whole:
        return "\n".join(rows)
    word = "agree" if _agrees(jump) else "DISAGREE"
    if jump.fold.error > HARMONICS * jump.fold.hertz:
        word += f", the fold is known to {jump.fold.error:.1e}"
    rows.append(
        f"{fold}        0 {hertz(jump.extrapolated, seen):>8} "
        f"{_late(jump, jump.extrapolated):16.2e} ± {jump.error:.1e}  {word}"
    )
    return "\n".join(rows)


def _late(jump: Jump, place: float) -> float:
    """Return how far a jump lies behind its fold [Hz]."""
    return (place - jump.fold.hertz) * (1.0 if jump.fold.upward else -1.0)


def _agrees(jump: Jump) -> bool:
    accepted = SPREAD * jump.fit_error + jump.step_error
    accepted += max(HARMONICS * jump.fold.hertz, jump.fold.error)
    return abs(_late(jump, jump.extrapolated)) <= accepted


def _draw(
    options: argparse.Namespace, traced: Traced, found: Sequence[Jump], picture: Path
) -> None:
    import numpy as np

    from microslip.figures.jumps import JumpLine, jumps_figure
    from microslip.files.store import save_figure

    lines = [
        JumpLine(
            f"{each.fold.hertz:.2f} Hz, {'up' if each.fold.upward else 'down'}",
            each.fold.hertz,
            each.rates,
            np.array([_late(each, place) for place in each.frequency]),
            _late(each, each.extrapolated),
            each.error,
            each.envelopes,
            each.fold.probe,
        )
        for each in found
    ]
    save_figure(picture, jumps_figure(traced.curve, lines, arguments.title(options)))
