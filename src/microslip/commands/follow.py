"""microslip follow: the response at one frequency against a parameter."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.columns import about, decimal, headed, tabled, titled
from microslip.commands.residual_range import residual_range
from microslip.commands.told_errors import told_errors
from microslip.commands.written import written

if TYPE_CHECKING:
    from microslip_mechanics.results.response_curve import ResponseCurve

ROWS = 13
"""of a table, about"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "follow",
        help="response at one frequency against a parameter, through folds",
        description="Follow the periodic response at one excitation frequency while a "
        "number of the scene changes - drive, friction coefficient, preload, contact "
        "stiffness, threshold velocity - by arc length, through folds; locate folds "
        "and changes of stability; write SCENE-follow.nc and SCENE-follow.png.",
        epilog="example: microslip follow two-blades excitation.force 0.1 4 "
        "--frequency 136.8 --set model=A --set friction.law=gkf",
    )
    arguments.add_scene(parser)
    arguments.add_range(parser)
    parser.add_argument(
        "--frequency",
        type=arguments.hertz,
        required=True,
        metavar="HZ",
        help="excitation frequency [Hz]",
    )
    arguments.add_output(parser, "follow")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.curve import curve_figure
    from microslip.files.store import Stored, save, save_figure
    from microslip.progress import shown
    from microslip.studies.follow import follow
    from microslip.studies.parameter import parameter

    data, picture = arguments.outputs(options, "follow")
    followed = parameter(
        options.scene, options.overrides, options.key, options.first, options.last
    )
    curve = follow(
        followed,
        math.tau * options.frequency,
        lambda responses: shown(
            responses,
            total=abs(followed.last - followed.first),
            done=lambda response: abs(response.parameter - followed.first),
            unit="SI",
            name=options.key,
        ),
    )
    stored = Stored(curve, followed.scene.text, options.command)
    title = f"{arguments.title(options)}, {options.frequency:.9g} Hz"
    told = f"{curve.frequency.size} points in {data}"
    with written(told, picture, lambda: save(data, stored)):
        errors = told_errors(followed.scene, curve)
        print(_table(curve), *errors, *residual_range(curve), sep="\n")
        save_figure(picture, curve_figure(curve, title))
    return arguments.ended(curve.ending)


def _table(curve: ResponseCurve) -> str:
    """Return about a dozen points, and all events."""
    places = _spread(curve)
    places |= {place for place, name in enumerate(curve.event) if name}
    probes = tabled(curve.probes, curve.amplitude.max(axis=0))
    names = [curve.probes[each] for each in probes]
    energy = curve.friction_energy
    rubs = bool(energy.any())
    lines = [
        f"     parameter {titled(' first harmonic [mm]', names, len(curve.probes))}"
        f"{'     friction' if rubs else ''}     largest",
        f"          [SI] {headed(names)}{'  [mJ/period]' if rubs else ''}  multiplier",
    ]
    for place in sorted(places):
        values = (
            f"{curve.parameter[place]:14.6g}",
            *(
                decimal(1e3 * each[place], 1e3 * each.max(), 5)
                for each in curve.amplitude.T[probes]
            ),
            *([decimal(1e3 * energy[place], 1e3 * energy.max(), 6, 12)] * rubs),
            _multiplier(curve, place),
        )
        event = curve.event[place] + about(curve.parameter_error[place])
        lines.append(" ".join(values) + f"  {event}")
    return "\n".join(lines)


def _spread(curve: ResponseCurve) -> set[int]:
    """Return points about evenly spread along the curve as a picture shows it."""
    import numpy as np

    from microslip.figures.abscissa import over_decades

    at, size = curve.parameter, curve.amplitude.max(axis=1, initial=0.0)
    at = np.log(at) if over_decades(at) else at
    across, up = (np.diff(each) / (np.ptp(each) or 1.0) for each in (at, size))
    way = np.append(0.0, np.hypot(across, up).cumsum())
    wanted = np.linspace(0.0, way[-1], ROWS)
    return {int(abs(way - each).argmin()) for each in wanted}


def _multiplier(curve: ResponseCurve, place: int) -> str:
    """Return the largest Floquet multiplier in a column; a dash if none is known."""
    known = curve.unstable[place] >= 0
    return f"{curve.multiplier[place]:11.5f}" if known else f"{'-':>11}"
