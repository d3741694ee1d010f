"""microslip plot: the picture of a result file."""

from __future__ import annotations

import argparse
from pathlib import Path

from microslip.commands import arguments
from microslip.commands.places import demand_apart, demand_place


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "plot",
        help="draw a result file again",
        description="Draw the picture of a file that frc, follow, sweep, dwell or "
        "decay wrote, also of a run that was stopped or is still going on.",
        epilog="example: microslip plot two-blades-frc.nc -o curve.pdf",
    )
    parser.add_argument("file", type=Path, help="netCDF file of a result")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PATH",
        help="picture to write: .png, also without an ending, .pdf or .svg (default: "
        "FILE with .png)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.result import result_figure
    from microslip.files.result_file import load
    from microslip.files.store import save_figure

    stored = load(options.file, arguments.MOST_ROWS)
    picture: Path = options.output or options.file.with_suffix(".png")
    if not picture.suffix:
        picture = picture.with_suffix(".png")
    demand_place(picture)
    demand_apart(picture, options.file)
    title = f"{options.file.name}: {stored.command}"
    save_figure(picture, result_figure(stored.result, title))
    print(f"picture in {picture}")
    return 0
