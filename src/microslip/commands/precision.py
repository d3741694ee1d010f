"""microslip precision: error against run time, method by method."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments, precision_tables
from microslip.commands.written import written

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.figures.precision import Line
    from microslip.studies.precision.precision import Run
    from microslip.studies.precision.reference import Reference


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "precision",
        help="error against run time: harmonic balance, marches and scipy's solvers",
        description="Find one periodic motion by every method at settings from loose "
        "to tight; print the error of each run against a reference of two independent "
        "methods, its CPU time from nothing to the steady state, and what 1 %, 0.1 % "
        "and 1e-6 cost; write SCENE-precision.csv and SCENE-precision.png. A march "
        "costs as many periods from rest as its slowest transient needs to fall below "
        "its error; shooting is a method of its own.",
        epilog="example: microslip precision two-blades --set model=B --frequency 134",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--frequency",
        type=arguments.hertz,
        metavar="HZ",
        help="of the drive (default: 0.99 of that of the curve's highest peak)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="fewer and looser settings"
    )
    arguments.add_output(parser, "precision")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.precision.case import case_of
    from microslip.studies.precision.methods import settings
    from microslip.studies.precision.precision import BUDGET, QUICK, runs
    from microslip.studies.precision.reference import reference

    data, picture = arguments.outputs(options, "precision", ".csv", ".png")
    case = case_of(load_scene(options.scene, options.overrides), options.frequency)
    exact = reference(case, QUICK if options.quick else BUDGET)
    print(f"{case.frequency / math.tau:.9g} Hz; " + precision_tables.reference(exact))
    print(precision_tables.multiplier(case.slope))
    chosen = list(settings(case, quick=options.quick))
    found: list[Run] = []
    ending = "complete"
    print(precision_tables.RUNS)
    try:
        for run in collected(
            runs(case, exact, chosen, quick=options.quick),
            found,
            total=len(chosen),
            unit="runs",
            name="precision",
        ):
            print(precision_tables.run(run), flush=True)
    except KeyboardInterrupt:
        ending = "interrupted"
    if found:
        _keep(options, found, exact, data.with_suffix(".csv"), picture)
    return arguments.ended(ending, kept=bool(found))


def _keep(
    options: argparse.Namespace,
    found: list[Run],
    exact: Reference,
    table: Path,
    picture: Path,
) -> None:
    """Print the summary, write table and picture."""
    from microslip.figures.precision import precision_figure
    from microslip.files.store import save_figure, save_table
    from microslip.studies.precision.orbit import QUANTITIES

    print(precision_tables.summary(found, exact))

    def save() -> None:
        save_table(table, precision_tables.COLUMNS, precision_tables.rows(found))

    doubts = dict(zip(QUANTITIES, exact.spread, strict=True))
    title = arguments.title(options)
    with written(f"table in {table}", picture, save):
        drawn = precision_figure(_lines(found, exact), doubts, title)
        save_figure(picture, drawn)


def _lines(found: list[Run], exact: Reference) -> dict[str, Line]:
    """Return what is drawn of each method that has a complete run."""
    import numpy as np

    from microslip.figures.precision import Line
    from microslip.studies.precision.fronts import front, slope

    made: dict[str, Line] = {}
    for method in dict.fromkeys(run.method for run in found):
        own = [r for r in found if r.method == method and r.ending == "complete"]
        if not own:
            continue
        made[method] = Line(
            np.array([run.seconds for run in own]),
            np.array([run.errors for run in own]),
            tuple(
                [own.index(run) for run in front(own, place)]
                for place in range(len(exact.spread))
            ),
            tuple(slope(own, place, doubt) for place, doubt in enumerate(exact.spread)),
        )
    return made
