"""microslip poles: frequencies and damping of the linearised scene against friction."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.columns import KEY, decimal, hertz, keyed
from microslip.commands.distinct import check_distinct
from microslip.commands.written import written

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.studies.pole_question import Question
    from microslip.studies.poles import Linearised
    from microslip_mechanics.arrays import ComplexArray

COLUMNS = (
    *(KEY, "branch", "frequency_hz", "damping_ratio", "real_1_s", "imag_rad_s"),
    *("response_frequency_hz", "response_amplitude_m", "response_error"),
    *("response_frequency_error", "friction_energy_j"),
)
HEADER = (
    f"{'value      response in one harmonic':58s}poles of the linearised scene\n"
    "      frequency [Hz]  off by  amplitude [mm]  off by   "
    "   frequency [Hz] (damping ratio [%])"
)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "poles",
        help="frequencies and damping of the linearised scene against friction",
        description="Replace each contact by a spring and a damper that do the same in "
        "one harmonic (friction's energy per period included); print the poles of that "
        "linear structure within the curve's range and how far its response is from "
        "that with all harmonics, write SCENE-poles.csv and SCENE-poles.png.",
        epilog="example: microslip poles two-blades friction 0 0.1 0.3 1 --set model=A",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "key",
        metavar="TABLE.KEY",
        nargs="?",
        default="friction",
        help='what is varied, such as preload.force (default: "friction", the '
        "coefficient mu_dynamic, and mu_static in proportion)",
    )
    parser.add_argument(
        "values",
        metavar="VALUE",
        nargs="*",
        help="of that key (default: from no friction to 32 times the scene's)",
    )
    parser.add_argument(
        "--frequency",
        type=arguments.hertz,
        metavar="HZ",
        help="of the response that decides springs and dampers (default: where its "
        "amplitude is largest)",
    )
    arguments.add_output(parser, "poles")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import collected
    from microslip.studies.pole_question import Question
    from microslip.studies.poles import linearised

    data, picture = arguments.outputs(options, "poles", ".csv", ".png")
    frequency = options.frequency and math.tau * options.frequency
    question = Question(options.scene, tuple(options.overrides), options.key, frequency)
    values = options.values or question.usual_values()
    check_distinct(options.key, values, map(question.at, values))
    found: list[Linearised] = []
    print(HEADER)
    ending = "complete"
    try:
        for each in collected(
            linearised(question, values),
            found,
            total=len(values),
            unit="values",
            name="poles",
        ):
            print(_line(question, each), flush=True)
    except KeyboardInterrupt:
        ending = "interrupted"
    kept = any(each.linear for each in found)
    if kept:
        _keep(options, question, found, data.with_suffix(".csv"), picture)
    elif ending == "complete":
        ending = "no value has a response"
    return arguments.ended(ending, kept=kept)


def _line(question: Question, each: Linearised) -> str:
    from hbm.structure.poles import damping_ratios, frequencies, poles
    from microslip.studies.poles import limits_of, within

    linear = each.linear
    if linear is None:
        return f"{each.value:<10} no response: {each.ending}"
    values = poles(linear.structure).values
    values = values[within(values, limits_of(question.at(each.value)))]
    shown = [
        f"{hertz(natural, [natural])} ({_percent(100.0 * ratio)})"
        for natural, ratio in zip(
            frequencies(values), damping_ratios(values), strict=True
        )
    ]
    beyond = "  (the peak lies outside the range)" if linear.outside else ""
    place, size = linear.response.frequency / math.tau, 1e3 * linear.amplitude
    return (
        f"{each.value:<10} {hertz(place, [place]):>9} "
        f"{_off(linear.error.frequency)} {decimal(size, size, 6, 14)} "
        f"{_off(linear.error.amplitude)}   {'  '.join(shown) or 'none'}{beyond}"
    )


def _percent(ratio: float) -> str:
    """Return a damping ratio [%] with three decimals, or digits if it is small."""
    return f"{ratio:.3f}" if abs(ratio) >= 0.1 else f"{ratio:.3g}"


def _off(error: float) -> str:
    """Return a relative error as it is printed."""
    return f"{'unknown' if math.isnan(error) else f'{100.0 * error:.3f} %':>9}"


def _keep(
    options: argparse.Namespace,
    question: Question,
    found: list[Linearised],
    table: Path,
    picture: Path,
) -> None:
    """Write table and picture of the values that have a response."""
    lines: list[ComplexArray] = []

    def save() -> None:
        from microslip.studies.poles import branches, limits_of

        lines.append(branches(found, limits_of(question.at(found[0].value))))
        _write(table, options.key, found, lines[0])

    with written(f"table in {table}", picture, save):
        _draw(options, question, (found, lines[0]), picture)


def _draw(
    options: argparse.Namespace,
    question: Question,
    linear: tuple[list[Linearised], ComplexArray],
    picture: Path,
) -> None:
    from microslip.figures.poles import poles_figure
    from microslip.files.store import save_figure
    from microslip.studies.axis import axis
    from microslip.studies.poles import limit_lines, limits_of

    found, lines = linear
    span = limits_of(question.at(found[0].value))
    limits = {name: limit_lines(found, name, span) for name in ("free", "stuck")}
    values = [each.value for each in found]
    scenes = [question.at(value) for value in values]
    places, key, names = axis(options.key, values, scenes)
    key = "friction coefficient µd" if options.key == "friction" else key
    title = arguments.title(options)
    save_figure(picture, poles_figure(places, lines, limits, span, key, title, names))


def _write(path: Path, key: str, found: list[Linearised], lines: ComplexArray) -> None:
    """Write a row for each pole of each value."""
    from microslip.files.store import save_table

    pairs = zip(found, lines, strict=True)
    rows = (row for pair in pairs for row in _rows(*pair))
    save_table(path, keyed(COLUMNS, key), rows)


def _rows(each: Linearised, poles: ComplexArray) -> list[list[object]]:
    """Return what the table says of each pole of a value."""
    from hbm.structure.poles import damping_ratios, frequencies

    if each.linear is None:
        return []
    response, error = each.linear.response, each.linear.error
    hertz = response.frequency / math.tau
    shared = [hertz, each.linear.amplitude, *error, response.friction_energy]
    columns = zip(frequencies(poles), damping_ratios(poles), poles, strict=True)
    return [
        [each.value, branch, decay, ratio, pole.real, pole.imag, *shared]
        for branch, (decay, ratio, pole) in enumerate(columns, start=1)
        if not math.isnan(decay)
    ]
