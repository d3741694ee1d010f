"""Arguments that commands share, and where their files go."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from microslip.commands.places import (
    OutputError,
    demand_no_device,
    demand_no_scene,
    demand_place,
    is_folder,
)

ENDINGS = (".nc", ".csv", ".png")
"""of all files that commands write"""
MOST_ROWS = 100_000
"""of a time history that a picture shows; a longer one is thinned"""


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Add the scene and its overrides."""
    parser.add_argument(
        "scene", help="name of a built-in scene, or path of a scene file (TOML)"
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="TABLE.KEY=VALUE",
        dest="overrides",
        help="replace a value of the scene, such as contact.sigma=3e-7 or model=A; "
        "may be repeated",
    )


def add_range(parser: argparse.ArgumentParser) -> None:
    """Add a number of the scene, and the values between which it changes."""
    parser.add_argument("key", metavar="TABLE.KEY", help="such as excitation.force")
    parser.add_argument("first", metavar="FROM", help="first value of that key")
    parser.add_argument("last", metavar="TO", help="last value")


def add_output(parser: argparse.ArgumentParser, suffix: str) -> None:
    """Add where the results go."""
    parser.add_argument(
        "-o",
        "--output",
        type=_place,
        metavar="PATH",
        help="where results go: a folder, or a path without ending (default: "
        f"SCENE-{suffix} here)",
    )


def _place(text: str) -> Path:
    """Read a path; one that ends like a folder must be one."""
    if text.endswith(("/", os.sep)) and not Path(text).is_dir():
        raise argparse.ArgumentTypeError(f"there is no folder {text}: make it first")
    return Path(text)


def outputs(
    options: argparse.Namespace, suffix: str, *endings: str
) -> tuple[Path, Path]:
    """Return the paths of data and picture, in a folder that exists.

    In a folder that is given itself they have the names that they have here.
    ``endings`` are those of the files to be written, .nc and .png if left out.

    Raises
    ------
    OutputError
        If one of them cannot be written, has the name of a scene, or an ending that no
        file of the command has.
    """
    endings = endings or (".nc", ".png")
    chosen: Path = options.output or Path()
    demand_no_scene(chosen, "-o", ".nc")
    if is_folder(chosen):
        chosen /= f"{Path(options.scene).stem}-{suffix}"
    elif chosen.suffix in endings:
        chosen = chosen.with_suffix("")
    elif chosen.suffix in ENDINGS:
        raise _refused(chosen, endings)
    else:
        demand_no_device(chosen, "-o")
    for ending in endings:
        demand_place(chosen.with_name(f"{chosen.name}{ending}"))
    return chosen.with_name(f"{chosen.name}.nc"), chosen.with_name(f"{chosen.name}.png")


def _refused(chosen: Path, endings: Sequence[str]) -> OutputError:
    """Return the error of an ending that no file of the command has."""
    names = " and ".join(f"{chosen.stem}{ending}" for ending in endings)
    text = f"-o {chosen}: {names} would be written: give that name without its ending"
    if ".nc" in endings:
        text += "; microslip plot FILE --csv TABLE writes columns as text"
    return OutputError(text)


def add_processes(parser: argparse.ArgumentParser, what: str) -> None:
    """Add in how many processes something is done."""
    parser.add_argument(
        "--processes",
        type=whole(1, 64),
        default=2,
        help=f"{what} at the same time (default: 2)",
    )


def add_table(parser: argparse.ArgumentParser) -> None:
    """Add where a table goes."""
    parser.add_argument(
        "--csv", type=Path, metavar="FILE", help="also write a CSV file"
    )


def table(options: argparse.Namespace) -> Path | None:
    """Return the path of the table, if there is to be one.

    Raises
    ------
    OutputError
        If it cannot be written, or has the name of a scene.
    """
    chosen: Path | None = options.csv
    if chosen is not None:
        demand_no_scene(chosen, "--csv", ".csv")
        demand_place(chosen)
    return chosen


def title(options: argparse.Namespace) -> str:
    """Return the scene and its overrides in one line."""
    return ", ".join([str(options.scene), *options.overrides])


def ended(ending: str, *, kept: bool = True) -> int:
    """Say on standard error how a result that is not complete ended; return the status.

    It is 0 if complete, 130 if interrupted, 1 otherwise; results up to there are
    ``kept`` in a file, or stand in what was printed alone.
    """
    if ending == "complete":
        return 0
    more = "what was computed is kept" if kept else "no file is written"
    print(f"microslip: {ending}; {more}", file=sys.stderr)
    return 130 if ending == "interrupted" else 1


def positive(text: str) -> float:
    """Read a positive finite number from the command line."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not (number > 0.0 and math.isfinite(number)):
        raise argparse.ArgumentTypeError(f"{text}: give a positive finite number")
    return number


def share(text: str) -> float:
    """Read a number above 0 and below 1 from the command line."""
    number = positive(text)
    if number >= 1.0:
        raise argparse.ArgumentTypeError(f"{text}: give a number above 0 and below 1")
    return number


def whole(lowest: int, highest: int) -> Callable[[str], int]:
    """Return what reads a whole number within bounds from the command line."""

    def read(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = lowest - 1
        if not lowest <= number <= highest:
            raise argparse.ArgumentTypeError(
                f"{text}: give a whole number from {lowest} to {highest}"
            )
        return number

    return read


def hertz(text: str) -> float:
    """Read a frequency from the command line [Hz]; it may have a unit."""
    from microslip.scenes.experiments import HERTZ

    return _quantity("Hz", text, *HERTZ)


def millimetres(text: str) -> float:
    """Read a length from the command line [mm]; it may have a unit."""
    return 1e3 * _quantity("m", text if text.strip()[-1:].isalpha() else f"{text} mm")


def _quantity(
    unit: str, text: str, lowest: float = 0.0, highest: float = math.inf
) -> float:
    from microslip.scenes.quantity import Quantity

    try:
        value: float | str = float(text)
    except ValueError:
        value = text
    try:
        return Quantity(unit, lowest, highest, positive=lowest == 0.0).read(value)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text} {error}") from None
