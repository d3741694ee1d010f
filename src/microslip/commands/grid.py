"""microslip grid: whole curves over a grid of parameters."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.studies.grid import Attempt

COLUMNS = (
    *("law", "sigma", "threshold", "friction", "preload", "drive"),
    *("ending", "points", "error", "gap", "seconds"),
)
HEADER = (
    "law        sigma   V_lim    mu preload   drive points   error    gap  time  ending"
)
SHARE = 0.97
"""of the curves that must be traced whole"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "grid",
        help="trace the curve over a grid of contact parameters and loads",
        description="Trace the curve of a scene for combinations of friction law, "
        "sigma, threshold velocity, friction coefficient, preload and drive; print how "
        "each ends. Exit status 1 if less than 97 % are traced from end to end, where "
        "a gap of 1 % of the range does not count, nor one of 0.1 % beside the largest "
        "amplitude.",
        epilog="example: microslip grid two-blades --set model=A --csv grid.csv",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--quick", action="store_true", help="every tenth combination only"
    )
    parser.add_argument(
        "--seconds",
        type=arguments.positive,
        default=300.0,
        help="of processor time that a curve may take (default: 300)",
    )
    arguments.add_processes(parser, "curves are traced")
    arguments.add_table(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.grid import QUICK, attempts, cases, demand_free

    table = arguments.table(options)
    scene = load_scene(options.scene, options.overrides)
    chosen = cases(scene)[:: QUICK if options.quick else 1]
    demand_free(options.overrides, chosen)
    found: list[Attempt] = []
    print(HEADER)
    try:
        for attempt in collected(
            attempts(
                options.scene,
                options.overrides,
                chosen,
                seconds=options.seconds,
                processes=options.processes,
            ),
            found,
            total=len(chosen),
            unit="curves",
            name="grid",
        ):
            print(_line(attempt), flush=True)
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=bool(found and table))
    finally:
        if found and table is not None:
            _write(table, found)
    whole = sum(attempt.whole for attempt in found)
    print(f"{whole} of {len(found)} curves are traced from end to end")
    return 0 if whole >= SHARE * len(found) else 1


def _line(attempt: Attempt) -> str:
    case = attempt.case
    return (
        f"{case.law:<8} {case.sigma:7.0e} {case.threshold:7.0e} {case.friction:5.2g} "
        f"{case.preload:7.2g} {case.drive:7.2g} {attempt.points:6d} "
        f"{attempt.error:7.1e} {attempt.gap:5.1%} {attempt.seconds:5.1f}  "
        f"{attempt.ending}"
    )


def _write(path: Path, found: list[Attempt]) -> None:
    from dataclasses import astuple

    from microslip.files.store import save_table

    rows = [(*astuple(each.case), *astuple(each)[1:]) for each in found]
    save_table(path, COLUMNS, rows)
