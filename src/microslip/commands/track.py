"""microslip track: peaks and bifurcations against a parameter of the scene."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.columns import KEY, about, decimal, hertz, keyed
from microslip.commands.distinct import check_distinct
from microslip.commands.written import written

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.studies.track import Tracked

COLUMNS = (
    *(KEY, "event", "frequency_hz", "frequency_error_hz", "amplitude_m", "error"),
    "ending",
)
HEADER = (
    "value           event             frequency [Hz]           amplitude [mm]    error"
)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "track",
        help="peak and bifurcations of the curve against a parameter",
        description="Trace the curve of a scene for several values of one of its keys, "
        "such as drive, preload or friction coefficient; print where its peaks, folds "
        "and changes of stability are, and what other residual tractions allow if that "
        "is more (docs/systems.md), write SCENE-track.csv and SCENE-track.png. Exit "
        "status 1 if a curve is not whole.",
        epilog="example: microslip track two-blades excitation.force 0.5 1 2 4 "
        "--set model=A",
    )
    arguments.add_scene(parser)
    parser.add_argument("key", metavar="TABLE.KEY", help="such as excitation.force")
    parser.add_argument("values", metavar="VALUE", nargs="+", help="of that key")
    arguments.add_output(parser, "track")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.track import tracked

    data, picture = arguments.outputs(options, "track", ".csv", ".png")
    check_distinct(
        options.key,
        options.values,
        (
            load_scene(options.scene, [*options.overrides, f"{options.key}={value}"])
            for value in options.values
        ),
    )
    found: list[Tracked] = []
    print(HEADER)
    ending = "complete"
    try:
        for each in collected(
            tracked(options.scene, options.overrides, options.key, options.values),
            found,
            total=len(options.values),
            unit="curves",
            name="track",
        ):
            print(_lines(each), flush=True)
    except KeyboardInterrupt:
        ending = "interrupted"
    if found:
        _keep(options, found, data.with_suffix(".csv"), picture)
    torn = sum(each.ending != "complete" for each in found)
    if torn and ending == "complete":
        ending = f"{torn} of {len(found)} curves are not whole"
    return arguments.ended(ending, kept=bool(found))


def _lines(each: Tracked) -> str:
    places = [event.frequency / math.tau for event in each.events]
    rows = [
        f"{each.value:<15} {event.name:<16} {hertz(place, [place], 6):>15} "
        f"{about(event.frequency_error / math.tau):<10}"
        f"{decimal(1e3 * event.amplitude, 1e3 * event.amplitude, 6, 15)} "
        f"{'' if math.isnan(event.error) else f'{event.error:8.1e}'}".rstrip()
        for event, place in zip(each.events, places, strict=True)
    ]
    if not rows:
        rows = [f"{each.value:<15} nothing located"]
    if each.ending != "complete":
        rows.append(f"{each.value:<15} the curve is not whole: {each.ending}")
    return "\n".join(rows)


def _keep(
    options: argparse.Namespace, found: list[Tracked], table: Path, picture: Path
) -> None:
    """Write table and picture."""
    from microslip.files.store import save_table

    def save() -> None:
        rows = [row for each in found for row in _rows(each)]
        save_table(table, keyed(COLUMNS, options.key), rows)

    with written(f"table in {table}", picture, save):
        _draw(options, found, picture)


def _rows(each: Tracked) -> list[tuple[object, ...]]:
    """Return what the table says of each event of a curve; one row if it has none."""
    rows = [
        (
            event.name,
            event.frequency / math.tau,
            event.frequency_error / math.tau,
            event.amplitude,
            event.error,
        )
        for event in each.events
    ]
    nothing = ("", math.nan, math.nan, math.nan, math.nan)
    return [(each.value, *row, each.ending) for row in rows or [nothing]]


def _draw(options: argparse.Namespace, found: list[Tracked], picture: Path) -> None:
    from microslip.figures.track import track_figure
    from microslip.files.store import save_figure
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.axis import axis

    values = [each.value for each in found]
    places, label, names = axis(
        options.key,
        values,
        [
            load_scene(options.scene, [*options.overrides, f"{options.key}={value}"])
            for value in values
        ],
    )
    peaks, others, otherwise = [], [], []
    for value, each in zip(places, found, strict=True):
        highest = each.peak
        if highest is not None:
            hertz = highest.frequency / math.tau
            peaks.append((value, hertz, highest.amplitude))
        if each.otherwise is not None:
            otherwise.append((value, each.otherwise.amplitude))
        others += [
            (value, event.name, event.frequency / math.tau)
            for event in each.events
            if event not in (highest, each.otherwise)
        ]
    title, error = arguments.title(options), _usual_error(found)
    figure = track_figure(peaks, others, label, title, names, error, otherwise)
    save_figure(picture, figure)


def _usual_error(found: list[Tracked]) -> float:
    """Return the median of the known errors of frequencies [Hz]; 0 if there is none."""
    from statistics import median

    errors = [
        event.frequency_error / math.tau
        for each in found
        for event in each.events
        if math.isfinite(event.frequency_error)
    ]
    return median(errors or [0.0])
