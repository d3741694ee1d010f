"""microslip folds: how the folds of the curve move with a parameter."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.columns import KEY, decimal, hertz, keyed, span
from microslip.commands.written import written

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from microslip.figures.folds import FoldLine
    from microslip.progress import Watch
    from microslip.studies.folds import FollowedFold
    from microslip.studies.parameter import Parameter

COLUMNS = (
    *("fold", KEY, "event", "frequency_hz", "amplitude_m", "other_unstable"),
    *("frequency_error", "parameter_error"),
)
HEADER = """\
     parameter       fold  amplitude    other unstable    estimated error of
          [SI]       [Hz]       [mm]       multipliers  frequency  parameter"""
MEETINGS = {"cusp": "two folds meet", "isola": "two curves meet"}


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "folds",
        help="folds of the curve against a parameter, and where they meet",
        description="Trace the curve of a scene at the first value of one of its "
        "numbers, such as drive, preload or friction coefficient; follow each of its "
        "folds, between which the response jumps, while that number changes, through "
        "the cusps at which two folds meet; write SCENE-folds.csv and SCENE-folds.png. "
        "A curve without folds is told, writes nothing, and is exit status 0.",
        epilog="example: microslip folds two-blades excitation.force 1.8 1 "
        "--set model=A --set friction.law=gkf",
    )
    arguments.add_scene(parser)
    arguments.add_range(parser)
    arguments.add_output(parser, "folds")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.studies.folds import FoldError, NoFoldsError, followed_folds
    from microslip.studies.parameter import parameter

    data, picture = arguments.outputs(options, "folds", ".csv", ".png")
    along = parameter(
        options.scene, options.overrides, options.key, options.first, options.last
    )
    folds: list[FollowedFold] = []
    ending = "complete"
    try:
        for fold in followed_folds(along, _watched(along, options.key)):
            folds.append(fold)
            ending = fold.curve.ending if ending == "complete" else ending
            print("\n".join(_lines(fold, len(folds))), flush=True)
    except NoFoldsError as none:
        print(none)
        return 0
    except KeyboardInterrupt:
        ending = "interrupted"
        if not folds:
            raise
    if not any(fold.points for fold in folds):
        raise FoldError(ending)
    _keep(options, along, folds, (data.with_suffix(".csv"), picture))
    return arguments.ended(ending)


def _watched(along: Parameter, key: str) -> Watch:
    """Return what shows the progress of a fold."""
    from microslip.progress import shown

    return lambda points: shown(
        points,
        total=abs(along.last - along.first),
        done=lambda point: abs(point.response.parameter - along.first),
        unit="SI",
        name=key,
    )


def _lines(fold: FollowedFold, number: int) -> list[str]:
    """Return about a dozen points of a fold, and all at which folds or curves meet."""
    if not fold.points:
        return [f"fold {number}: {fold.curve.ending}"]
    count = len(fold.points)
    places = {*range(0, count, max(1, count // 12)), count - 1}
    places |= {place for place, name in enumerate(fold.curve.event) if name}
    harmonics = span([fold.points[0].response.harmonics], "harmonic")
    return [
        f"fold {number}, {harmonics}",
        HEADER,
        *(_line(fold, place) for place in sorted(places)),
    ]


def _line(fold: FollowedFold, place: int) -> str:
    point, curve = fold.points[place], fold.curve
    event, known = curve.event[place], math.isfinite(point.parameter_error)
    meeting = MEETINGS.get(event, "") if known else "not with twice the harmonics"
    note = f"  {event}: {meeting}" if event else ""
    amplitude = 1e3 * float(curve.amplitude[place].max())
    others = str(point.unstable) if point.unstable >= 0 else "-"
    seen = curve.frequency / math.tau
    return (
        f"{curve.parameter[place]:14.6g} {hertz(seen[place], seen):>10} "
        f"{decimal(amplitude, amplitude, 5)} {others:>17s} "
        f"{point.frequency_error:10.1e} {point.parameter_error:10.1e}{note}"
    )


def _keep(
    options: argparse.Namespace,
    along: Parameter,
    folds: list[FollowedFold],
    paths: tuple[Path, Path],
) -> None:
    """Write table and picture."""
    from microslip.figures.folds import folds_figure
    from microslip.files.store import save_figure, save_table

    table, picture = paths

    def save() -> None:
        rows = [
            (number, *row)
            for number, fold in enumerate(folds, start=1)
            for row in _rows(fold)
        ]
        save_table(table, keyed(COLUMNS, options.key), rows)

    with written(f"table in {table}", picture, save):
        lines, title = [_drawn(fold) for fold in folds], arguments.title(options)
        save_figure(picture, folds_figure(lines, along.label, title))


def _rows(fold: FollowedFold) -> Iterator[tuple[object, ...]]:
    """Yield the rows of a fold in the table, behind its number."""
    value, hertz, amplitude = _columns(fold)
    for place, point in enumerate(fold.points):
        yield (
            value[place],
            fold.curve.event[place],
            hertz[place],
            amplitude[place],
            point.unstable,
            point.frequency_error,
            point.parameter_error,
        )


def _drawn(fold: FollowedFold) -> FoldLine:
    """Return a fold as a line, with those of its events that are sure."""
    from microslip.figures.folds import FoldLine

    unstable = [point.unstable > 0 for point in fold.points]
    sure = [
        event if math.isfinite(point.parameter_error) else ""
        for event, point in zip(fold.curve.event, fold.points, strict=True)
    ]
    return FoldLine(*_columns(fold), unstable, sure)


def _columns(fold: FollowedFold) -> tuple[list[float], list[float], list[float]]:
    """Return parameter, frequency [Hz] and largest amplitude [m] of each point."""
    curve = fold.curve
    return (
        curve.parameter.tolist(),
        (curve.frequency / math.tau).tolist(),
        curve.amplitude.max(axis=1, initial=0.0).tolist(),
    )
