"""microslip frc: the frequency response curve by harmonic balance."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from microslip.commands import arguments, frc_events, frc_tables
from microslip.commands.residual_range import residual_range
from microslip.commands.told_errors import told_errors
from microslip.commands.written import written

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from microslip.progress import Watch
    from microslip.scenes.experiments import Curve
    from microslip.scenes.scene import Scene
    from microslip.studies.curve import Traced
    from microslip_mechanics.problem import Problem


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "frc",
        help="frequency response curve by harmonic balance",
        description="Trace the frequency response curve of a scene by harmonic "
        "balance, with as many harmonics at each point as its error tolerance asks "
        "for; locate peaks, folds and changes of stability; tell how far amplitudes "
        "depend on what contacts that stick carry from before; print a short table, "
        "write SCENE-frc.nc and SCENE-frc.png. Exit status 1 if the curve does not "
        "come to its end or leaves out more than 1 % of its range, or 0.1 % beside its "
        "largest amplitude.",
        epilog="example: microslip frc two-blades --set model=A -o model-a",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--tolerance",
        metavar="ERROR",
        help="relative error of amplitude at each point, instead of the scene's "
        "curve.tolerance: harmonics and samples follow from it",
    )
    parser.add_argument(
        "--branches",
        action="store_true",
        help="also follow the branches that begin at branch points",
    )
    parser.add_argument(
        "--detached",
        action="store_true",
        help="also seek curves that do not hang together with the first one, by "
        "varying the drive at 15 frequencies and at the folds; what was searched and "
        "what not is said",
    )
    parser.add_argument(
        "--effort",
        type=arguments.positive,
        metavar="TIMES",
        help="work that the search for detached curves may take, over the usual: at "
        "each frequency 2000 evaluations with 31 harmonics, a quarter of that from "
        "each fold to either side, and fifty times that to follow a curve that is "
        "found (default: 1)",
    )
    parser.add_argument(
        "--unpruned",
        action="store_true",
        help="leave nothing out: all contact points, sectors, coordinates, orders and "
        "samples, whatever stays at zero; the curve is the same and takes longer, see "
        "microslip explain --time",
    )
    arguments.add_output(parser, "frc")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.curve import curve_figure
    from microslip.files.store import Stored, save, save_figure
    from microslip.scenes.quantity import SceneError
    from microslip.scenes.scene_file import load_scene

    data, picture = arguments.outputs(options, "frc")
    if options.tolerance is not None:
        options.overrides.append(f"curve.tolerance={options.tolerance}")
    scene = load_scene(options.scene, options.overrides)
    if options.tolerance is not None and scene.curve.harmonics is not None:
        raise SceneError(
            f"--tolerance {options.tolerance}: the scene fixes curve.harmonics = "
            f"{scene.curve.harmonics}: leave one of them out"
        )
    if options.effort is not None and not options.detached:
        raise SceneError(
            f"--effort {options.effort:g}: it is that of the search for detached "
            "curves: give --detached too, or leave it out"
        )
    traced = _traced(options, scene)
    stored = Stored(traced.curve, scene.text, options.command)
    told = f"{len(traced.responses)} points in {data}"
    with written(told, picture, lambda: save(data, stored)):
        _tell(options, scene, traced)
        save_figure(picture, curve_figure(traced.curve, arguments.title(options)))
    return arguments.ended(traced.curve.ending)


def _tell(options: argparse.Namespace, scene: Scene, traced: Traced) -> None:
    """Print the curve, its events, its errors, and what was sought."""
    from microslip.studies.creep import creep

    problem = _whole(options, scene)
    print(frc_tables.table(traced))
    if traced.rest.normal_force.any():
        print(frc_tables.rest(traced.curve, traced.rest))
    doubt = _doubt(scene, traced, problem)
    print(frc_events.events(traced.curve, sector=problem is None, doubt=doubt))
    sought = options.branches and traced.curve.ending == "complete"
    for hertz in frc_events.barren(traced.curve) if sought else ():
        print(f"no branch is found at the branch point at {hertz:.6f} Hz")
    lines = told_errors(scene, traced.curve) + residual_range(traced.curve)
    if problem is not None:
        lines += creep(problem, traced)
    print("\n".join(lines))
    if traced.searched is not None:
        print("\n".join(traced.searched.lines()))


def _whole(options: argparse.Namespace, scene: Scene) -> Problem | None:
    """Return the problem of a scene; none if one sector stands for it."""
    from microslip.scenes.rigs import problem_of, sector_of, unpruned_of

    if options.unpruned:
        return unpruned_of(scene)
    return problem_of(scene) if sector_of(scene) is None else None


def _doubt(scene: Scene, traced: Traced, problem: Problem | None) -> float:
    """Return the error of the largest multiplier of what is unstable, if it is known.

    What is stable needs nothing for that.
    """
    if problem is None or not (traced.curve.unstable > 0).any():
        return math.inf
    from microslip.studies.leading_multiplier import leading_error

    return leading_error(problem, traced, scene.curve)


def _traced(options: argparse.Namespace, scene: Scene) -> Traced:
    """Return the curve of a scene, or of one sector that stands for a disk."""
    from microslip.scenes.rigs import problem_of, sector_of, unpruned_of
    from microslip.studies.curve import Wanted, trace_curve, trace_sector

    wanted = Wanted(
        options.branches,
        options.detached,
        options.effort or 1.0,
        residual_range=True,
        contact_errors=True,
    )
    watch, searching = watched(scene.curve), search_watched
    sector = None if options.unpruned else sector_of(scene)
    if sector is not None:
        return trace_sector(sector, scene.curve, watch, wanted)
    problem = unpruned_of(scene) if options.unpruned else problem_of(scene)
    pruned = not options.unpruned
    return trace_curve(problem, scene.curve, watch, wanted, searching, pruned=pruned)


def watched(curve: Curve) -> Watch:
    """Return what shows the progress of a curve."""
    from microslip.progress import shown

    return lambda responses: shown(
        responses,
        total=abs(curve.highest - curve.lowest),
        done=lambda response: abs(response.frequency / math.tau - curve.lowest),
        unit="Hz",
        name="curve",
    )


def search_watched(found: Iterable[Any]) -> Iterator[Any]:
    """Show the progress of a search for detached curves."""
    from hbm.curves.drive_search import Sought
    from microslip.progress import shown

    def done(each: object) -> float:
        return 100.0 * each.done if isinstance(each, Sought) else 0.0

    return shown(found, total=100.0, done=done, unit="%", name="detached")
