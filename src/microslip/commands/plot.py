"""microslip plot: the picture of a result file."""

from __future__ import annotations

import argparse
from pathlib import Path


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "plot",
        help="draw a result file again",
        description="Draw the picture of a file that frc or sweep wrote.",
        epilog="example: microslip plot two-blades-frc.nc -o curve.pdf",
    )
    parser.add_argument("file", type=Path, help="netCDF file that frc or sweep wrote")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PATH",
        help="picture to write: .png, .pdf or .svg (default: FILE with .png)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.store import load, save_figure
    from microslip_mechanics.response import ResponseCurve

    stored = load(options.file)
    picture = options.output or options.file.with_suffix(".png")
    title = f"{options.file.name}: {stored.command}"
    if isinstance(stored.result, ResponseCurve):
        from microslip.figures.curve import curve_figure

        save_figure(picture, curve_figure(stored.result, title))
    else:
        from microslip.figures.sweep import sweep_figure

        save_figure(picture, sweep_figure(stored.result, title))
    print(f"picture in {picture}")
    return 0
