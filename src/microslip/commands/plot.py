"""microslip plot: the picture of a result file, or of several curves."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.places import demand_apart, demand_place
from microslip.errors import GivenError

if TYPE_CHECKING:
    from microslip.files.store import Stored

FEW = 4
"""files that the title of a picture names"""
TOGETHER = Path("compared.png")
"""picture of several curves"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "plot",
        help="draw a result file again, or several curves together",
        description="Draw the picture of a file that frc, follow, sweep, dwell or "
        "decay wrote, also of a run that was stopped or is still going on. Of several "
        "files of frc, or of follow along one key, draw amplitudes and dissipated "
        "energies together, and tell the largest amplitude of each. A legend names "
        "the values that --set gave to some of them, or the files. With --csv the "
        "columns of a file are written as text.",
        epilog="example: microslip plot soft-frc.nc stiff-frc.nc -o both.pdf",
    )
    parser.add_argument(
        "files", nargs="+", type=Path, metavar="file", help="netCDF file of a result"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PATH",
        help="picture to write: .png, also without an ending, .pdf or .svg (default: "
        f"FILE with .png, {TOGETHER} of several)",
    )
    arguments.add_table(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.result import result_figure
    from microslip.files.result_file import load
    from microslip.files.store import save_figure
    from microslip.files.tabulated import save_columns

    files: list[Path] = options.files
    stored = [load(each, arguments.MOST_ROWS) for each in files]
    alone = files[0].with_suffix(".png") if len(files) == 1 else TOGETHER
    picture: Path = options.output or alone
    if not picture.suffix:
        picture = picture.with_suffix(".png")
    demand_place(picture)
    for each in files:
        demand_apart(picture, each)
    if len(files) > 1:
        if options.csv is not None:
            raise GivenError("--csv writes what one file holds: give one")
        return _together(files, stored, picture)
    table = arguments.table(options)
    if table is not None:
        demand_apart(table, files[0], "table")
    title = f"{files[0].name}: {stored[0].command}"
    save_figure(picture, result_figure(stored[0].result, title))
    print(f"picture in {picture}")
    if table is not None:
        save_columns(table, load(files[0]).result)
        print(f"table in {table}")
    return 0


def _together(files: list[Path], stored: list[Stored], picture: Path) -> int:
    """Draw several curves together, and print the largest amplitude of each."""
    from microslip.commands.compared_table import compared_table
    from microslip.figures.compared import compared_figure
    from microslip.files.compared import comparable, told_apart
    from microslip.files.store import save_figure

    curves = comparable(stored, files)
    labels = told_apart(stored, files)
    print(compared_table(curves, labels))
    names = [each.name for each in files]
    title = ", ".join(names if len(names) <= FEW else [names[0], "…", names[-1]])
    save_figure(picture, compared_figure(curves, labels, title))
    print(f"picture in {picture}")
    return 0
