"""microslip stress: stiff and extreme cases by both solvers."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.written import written

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from microslip.studies.stress.case import Case
    from microslip.studies.stress.finding import Tried

COLUMNS = (
    *("parameter", "value", "outcome", "cause", "points", "harmonics", "iterations"),
    *("compared", "difference", "estimated", "steps", "condition", "seconds"),
)
HEADER = (
    "parameter          value        harm.  iter.  difference  estimated  condition"
    "   time  outcome"
)
SHARE = 0.95
"""of the cases that must converge in both solvers and agree within 1 %"""
QUICK = 5.0
"""seconds for a case in a quick look"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "stress",
        help="stiff and extreme cases by both solvers, side by side",
        description="Take each number of a scene of two blades to its extremes; trace "
        "the curve, find its largest orbit again by shooting, and compare; give every "
        "number a value that is none. Write SCENE-stress.png and SCENE-stress.csv. "
        "Exit status 1 if a value disagrees, or if, of all cases, less than "
        f"{100.0 * SHARE:g} % converge in both and agree within 1 %; with --quick, "
        "whose time is short, if a value disagrees.",
        epilog="example: microslip stress two-blades --set model=B",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--quick", action="store_true", help="one extreme of each parameter only"
    )
    parser.add_argument(
        "--seconds",
        type=arguments.positive,
        help=f"a case may take at most (default: {QUICK:g} with --quick, else twice "
        "its part of what is left of ten minutes for all, and no more than 40)",
    )
    arguments.add_processes(parser, "cases are tried")
    arguments.add_output(parser, "stress")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.stress.budget import Budget
    from microslip.studies.stress.cases import cases
    from microslip.studies.stress.stress import tried

    _, picture = arguments.outputs(options, "stress", ".csv", ".png")
    scene = load_scene(options.scene, options.overrides)
    chosen = cases(scene, quick=options.quick)
    seconds = options.seconds or (QUICK if options.quick else None)
    budget = Budget(options.processes)
    if seconds is not None:
        budget = Budget.each(seconds, options.processes)
    found: list[Tried] = []
    print(HEADER)
    try:
        for each in collected(
            tried(options.scene, options.overrides, chosen, budget),
            found,
            total=len(chosen),
            unit="cases",
            name="stress",
        ):
            print(_line(each), flush=True)
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=bool(found))
    finally:
        if found:
            _write(options, picture, chosen, found)
    return _verdict(found, 0.0 if options.quick else SHARE)


def _line(tried: Tried) -> str:
    case, made = tried.case, tried.finding
    return (
        f"{case.parameter:<18} {case.value:<12} {made.harmonics:5d} "
        f"{made.iterations:6.1f}  {made.difference:10.1e} {made.estimated:10.1e} "
        f"{made.condition:10.1e} {tried.seconds:6.1f}  {made.outcome.value}"
        + (f": {made.cause}" if made.cause else "")
    )


def _verdict(found: Sequence[Tried], share: float) -> int:
    """Print the rates and each case that falls short; return the exit status."""
    from microslip.studies.stress.finding import Outcome, rate

    good, solved = rate(found)
    bad = [each for each in found if each.finding.outcome is Outcome.DISAGREES]
    short = [each for each in found if each.finding.outcome is Outcome.HONEST]
    for name, several in (("honest outcomes", short), ("DISAGREE", bad)):
        if several:
            print(f"{name}:")
        for each in several:
            print(f"  {each.case.parameter} = {each.case.value}: {each.finding.cause}")
    refused = sum(each.finding.outcome is Outcome.REFUSED for each in found)
    longest = max((each.seconds for each in found), default=0.0)
    print(
        f"{good} of {solved} cases ({100.0 * good / max(solved, 1):.0f} %) converge in "
        f"both solvers and agree within 1 %; {len(short)} end with a cause; "
        f"{len(bad)} disagree; {refused} rows of bad values are refused "
        "or come to a finite end; "
        f"longest case {longest:.0f} s"
    )
    return 0 if not bad and good >= share * solved else 1


def _write(
    options: argparse.Namespace,
    picture: Path,
    chosen: Sequence[Case],
    found: Sequence[Tried],
) -> None:
    """Write table and picture of what there is."""
    from dataclasses import astuple

    from microslip.files.store import save_table

    rows = [
        (
            each.case.parameter,
            each.case.value,
            each.finding.outcome.value,
            *astuple(each.finding)[1:],
            each.seconds,
        )
        for each in found
    ]
    table = picture.with_suffix(".csv")
    told = f"table in {table}"
    with written(told, picture, lambda: save_table(table, COLUMNS, rows)):
        _draw(options, picture, chosen, found)


def _draw(
    options: argparse.Namespace,
    picture: Path,
    chosen: Sequence[Case],
    found: Sequence[Tried],
) -> None:
    from microslip.figures.stress import Cell, stress_figure
    from microslip.files.store import save_figure
    from microslip.studies.stress.finding import Outcome

    known = {each.case: each.finding for each in found}
    cells = []
    for case in chosen:
        made = known.get(case)
        measured = made is not None and made.difference == made.difference
        note = f"{made.difference:.0e}" if made is not None and measured else ""
        said = "" if made is None else made.outcome.value
        cells.append(Cell(case.parameter, case.value, said, note))
    counts = {
        each.value: sum(made.outcome is each for made in known.values())
        for each in Outcome
    }
    title = f"{arguments.title(options)}: difference of both solvers' amplitudes"
    save_figure(picture, stress_figure(cells, counts, title))
