"""microslip tables: the paper's dissipated energies beside our own."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.studies.tables import Row

COLUMNS = (
    *("variant", "paper [J]", "microslip [J]", "ratio", "half-step change"),
    "estimated error",
    *("closing error", "march [s]"),
)
HEADER = "\n".join(
    (
        "Energy dissipated by friction over the sweep [J]: the paper's Tables 4 and 5",
        " " * 36 + "  paper  microslip   ratio half step  error  closing  time",
        " " * 36 + "    [J]        [J]              [%]    [%]    error   [s]",
    )
)
NOTES = """\
half step: excess at the scene's time step over the value, which is that of half the
step. error: of the value, the most that half the step changes at any time, or twice
the step if none is halved. closing error: of the energy balance, over the input. time:
of the march at the scene's time step. The geometry is one fit for all rows; none is
tuned by itself."""
CREEP = """\
Stiff contact: the energy is largely the viscous creep of the regularised friction in a
jammed contact (see the row with V_lim 0.1 mm/s), not sliding. Hence GKF, whose friction
coefficient is twice as high near rest, creeps half as fast and gives about half of
Coulomb's energy, where the paper has more."""
"""said of all rows together: it refers to the last one"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "tables",
        help="the paper's Tables 4 and 5 beside our own numbers",
        description="March all variants of the paper's Tables 4 and 5 through the "
        "sweep; print the paper's energy, ours, their ratio, errors and run time.",
        epilog="example: microslip tables --csv tables.csv",
    )
    arguments.add_table(parser)
    parser.add_argument(
        "--quick",
        action="store_true",
        help="do not march again with half the time step (the error of the "
        "energy is then estimated from a march with twice the step)",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.studies.tables import PAPER, SENSITIVITIES, rows

    table = arguments.table(options)
    variants = (*PAPER, *SENSITIVITIES)
    found: list[Row] = []
    print(HEADER, flush=True)
    try:
        for row in collected(
            rows("two-blades", variants, halve=not options.quick),
            found,
            total=len(variants),
            unit="sweeps",
            name="tables",
        ):
            print(_line(row), flush=True)
            if table is not None:
                _write(table, found)
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=bool(found and table))
    finally:
        if found:
            print(_jamming(found[0]))
            print(NOTES)
        if len(found) == len(variants):
            print(CREEP)
    return 0


def _line(row: Row) -> str:
    paper = row.variant.paper
    own = math.isnan(paper)
    return (
        f"{row.variant.name:36s} {'-' if own else format(paper, '.3f'):>6s} "
        f"{row.energy:10.6f} {'-' if own else format(row.energy / paper, '.3f'):>7s} "
        f"{_percent(row.half_step_change):>9s} {_told(row.estimated):>6s} "
        f"{row.closing_error:8.1e} "
        f"{row.seconds:5.1f}"
    )


def _percent(share: float) -> str:
    return "-" if math.isnan(share) else f"{100.0 * share:+.3f}"


def _told(error: float) -> str:
    return "-" if math.isnan(error) else f"{100.0 * error:.3f}"


def _jamming(row: Row) -> str:
    """Say which points leave contact in the first row, and how normal forces grow."""
    history = row.history
    lines = [f"jamming, {row.variant.name}: normal force of each point [N]"]
    lines.append(
        "  point   at rest     least      most   share of the time out of contact"
    )
    for place, name in enumerate(history.contacts):
        force = history.normal_force[history.time > row.begin, place]
        lines.append(
            f"  {name:5s} {row.rest[place]:9.3f} {force.min():9.3f} {force.max():9.3f}"
            f" {100.0 * (force == 0.0).mean():9.1f} %"
        )
    return "\n".join(lines)


def _write(path: Path, found: list[Row]) -> None:
    from microslip.files.store import save_table

    save_table(path, COLUMNS, [_cells(row) for row in found])


def _cells(row: Row) -> tuple[object, ...]:
    paper = row.variant.paper
    energies = (paper, row.energy, row.energy / paper)
    numbers = (*energies, row.half_step_change, row.estimated)
    return (
        row.variant.name,
        *("" if math.isnan(number) else number for number in numbers),
        row.closing_error,
        row.seconds,
    )
