"""microslip verify: whether harmonic balance and time integration agree."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments, frc, sweep
from microslip.commands.columns import SHOWN, headed, titled

if TYPE_CHECKING:
    from pathlib import Path

    from microslip.scene_file import Scene
    from microslip.studies.curve import Traced
    from microslip.studies.verify import SweepAgreement
    from microslip_mechanics.problem import Problem
    from timedomain.verify import Agreement

SLOWEST = 1000.0
"""times the length of the scene's sweep"""
SWEEPS = """\
swept sine beside the curve's prediction for an infinitely slow one
  slower   energy of friction [J]  predicted [J]  difference  envelope  closing error"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "verify",
        help="check harmonic balance against time integration",
        description="March from orbits that harmonic balance found, and march the "
        "scene's sweep and slower ones against the curve; write SCENE-verify.png. Exit "
        "status 1 if an amplitude deviates by more than the tolerance, or if energy "
        "and envelope of the sweep do not approach the curve as it slows.",
        epilog="example: microslip verify two-blades --set model=B --frequencies 15",
    )
    arguments.add_scene(parser)
    arguments.add_output(parser, "verify")
    for name, kind, default, meaning in (
        ("--frequencies", _count, 9, "orbits along the curve"),
        ("--periods", _several, 200, "length of each march in periods"),
        ("--steps", _count, 600, "time steps per period"),
        ("--tolerance", arguments.positive, 0.01, "relative deviation of amplitudes"),
    ):
        parser.add_argument(
            name, type=kind, default=default, help=f"{meaning} (default: {default})"
        )
    parser.add_argument(
        "--slower",
        type=_slowness,
        nargs="*",
        default=[1.0, 4.0, 10.0],
        metavar="FACTOR",
        help="lengths of the sweeps over that of the scene, at most "
        f"{SLOWEST:g} (default: 1 4 10)",
    )
    parser.set_defaults(run=_run)


def _count(text: str, least: int = 1) -> int:
    number = int(text)
    if number < least:
        raise argparse.ArgumentTypeError(f"{number} is too few: give at least {least}")
    return number


def _several(text: str) -> int:
    return _count(text, 2)


def _slowness(text: str) -> float:
    number = arguments.positive(text)
    if number > SLOWEST:
        raise argparse.ArgumentTypeError(
            f"{text} times as long is too long: give at most {SLOWEST:g}"
        )
    return number


def _run(options: argparse.Namespace) -> int:
    from microslip.quantity import SceneError
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene
    from microslip.studies.curve import trace_curve

    _, picture = arguments.outputs(options, "verify")
    scene = load_scene(options.scene, options.overrides)
    problem = problem_of(scene)
    if not problem.drive.any():
        raise SceneError(
            f"{options.scene}: no force drives it: nothing vibrates, so there is "
            "nothing to verify: give a force in [excitation] or [drive]"
        )
    curve, swept = scene.curve, scene.sweep
    covered = curve.lowest <= swept.lowest and swept.highest <= curve.highest
    if options.slower and not covered:
        raise SceneError(
            f"{options.scene}: [curve] {curve.lowest:g} to {curve.highest:g} Hz does "
            f"not cover [sweep] {swept.lowest:g} to {swept.highest:g} Hz: give it the "
            "sweep's range, or leave the sweeps out by --slower without a value"
        )
    traced = trace_curve(problem, scene.curve, frc.watched(scene.curve))
    if traced.curve.ending != "complete":
        return arguments.ended(traced.curve.ending)
    orbits: list[Agreement] = []
    sweeps: list[SweepAgreement] = []
    try:
        _orbits(options, problem, traced, orbits)
        _sweeps(options, scene, problem, traced, sweeps)
    except KeyboardInterrupt:
        return arguments.ended("interrupted")
    finally:
        _report(problem.probes.names, orbits, sweeps)
    _draw(options, traced, orbits, sweeps, picture)
    print(f"picture in {picture}")
    return _verdict(options, orbits, sweeps)


def _orbits(
    options: argparse.Namespace,
    problem: Problem,
    traced: Traced,
    found: list[Agreement],
) -> None:
    """March the orbits; what is found stays when the march is stopped."""
    from microslip.progress import shown
    from microslip.studies.verify import orbits, spread

    chosen = spread(traced, options.frequencies)
    marches = orbits(
        problem, chosen, periods=options.periods, steps_per_period=options.steps
    )
    bar = shown(
        marches,
        total=len(chosen),
        done=lambda _: len(found) + 1.0,
        unit="",
        name="orbits",
    )
    for each in bar:
        found.append(each)  # noqa: PERF402


def _sweeps(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    traced: Traced,
    found: list[SweepAgreement],
) -> None:
    """March the sweeps; what is found stays when a march is stopped."""
    from microslip.studies.sweep import swept_sine
    from microslip.studies.verify import sweep_agreement

    for slower in sorted(set(options.slower)):
        length = swept_sine(scene.sweep, slower=slower).duration
        watch = sweep.watched(length, f"sweep, {slower:g} times as long")
        found.append(
            sweep_agreement(scene, problem, traced.curve, slower=slower, watch=watch)
        )


def _report(
    probes: tuple[str, ...], orbits: list[Agreement], sweeps: list[SweepAgreement]
) -> None:
    """Print what was found."""
    from microslip.studies.verify import rate_of

    if orbits:
        heads = headed(probes).replace(" ", "", 1)
        print("steady state: march started on the orbit that harmonic balance found")
        print(
            f"frequency  amplitude [mm]   {titled('deviation [%]', probes)} distance "
            "from orbit  drift"
        )
        print(f"     [Hz]  {probes[0]:>13s}  {heads}       first      last")
    for orbit in orbits:
        print(
            f"{orbit.frequency / math.tau:9.4f}  {1e3 * orbit.predicted[0]:13.6f}  "
            + " ".join(
                f"{100.0 * deviation:9.4f}" for deviation in orbit.deviation[:SHOWN]
            )
            + f"  {orbit.first_distance:10.1e}{orbit.last_distance:10.1e}"
            f"{orbit.drift:9.1e}"
            f"{'  unstable: need not stay' if orbit.unstable > 0 else ''}"
        )
    if sweeps:
        print(SWEEPS)
    for each in sweeps:
        print(
            f"{each.slower:8g} {each.energy:24.6f} {each.quasi_static:14.6f}"
            f" {100.0 * each.energy_error:9.2f} % {100.0 * each.envelope_error:7.1f} %"
            f" {each.closing_error:14.1e}"
        )
    rate = rate_of(sweeps)
    if rate is not None:
        print(f"the difference falls as duration^-{rate:.2f}")


def _draw(
    options: argparse.Namespace,
    traced: Traced,
    orbits: list[Agreement],
    sweeps: list[SweepAgreement],
    picture: Path,
) -> None:
    import numpy as np

    from microslip.figures.agreement import agreement_figure
    from microslip.store import save_figure

    figure = agreement_figure(
        traced.curve,
        (
            np.array([each.frequency for each in orbits]) / math.tau,
            np.array([each.marched for each in orbits]),
            np.array([_deviation(each) for each in orbits]),
        ),
        [
            (f"{s.slower:g} x as long", s.envelope_frequency, s.envelope[:, 0])
            for s in sweeps
        ],
        (
            np.array([each.slower for each in sweeps]),
            np.array([each.energy_error for each in sweeps]),
        ),
        arguments.title(options),
    )
    save_figure(picture, figure)


def _deviation(each: Agreement) -> float:
    """Return the largest deviation among the probes of the table."""
    return float(each.deviation[:SHOWN].max())


def _verdict(
    options: argparse.Namespace, orbits: list[Agreement], sweeps: list[SweepAgreement]
) -> int:
    """Print whether the solvers agree; return the exit status."""
    from microslip.studies.verify import falls

    held = [orbit for orbit in orbits if orbit.unstable <= 0]
    worst = max(held or orbits, key=_deviation)
    stays = _deviation(worst) <= options.tolerance
    among = "" if len(held) == len(orbits) else f" of {len(held)} stable orbits"
    print(
        f"{'agree' if stays else 'DISAGREE'}: largest deviation of an amplitude{among} "
        f"{100.0 * _deviation(worst):.3g} % at {worst.frequency / math.tau:.4f} Hz, "
        f"tolerance {100.0 * options.tolerance:g} %"
    )
    slows = falls(sweeps)
    if len(sweeps) > 1:
        print(
            f"{'agree' if slows else 'DISAGREE'}: energy and envelope of the sweep "
            f"{'approach' if slows else 'do not approach'} the curve as it slows"
        )
    return 0 if stays and slows else 1
