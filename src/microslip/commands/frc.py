"""microslip frc: the frequency response curve by harmonic balance."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.columns import about, decimal, headed, tabled, titled

if TYPE_CHECKING:
    from microslip.experiments import Curve
    from microslip.progress import Watch
    from microslip.scene_tables import Scene
    from microslip.studies.curve import Traced
    from microslip_mechanics.response import ResponseCurve
    from microslip_mechanics.static import StaticState


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "frc",
        help="frequency response curve by harmonic balance",
        description="Trace the frequency response curve of a scene by harmonic "
        "balance, with as many harmonics at each point as its error tolerance asks "
        "for; locate peaks, folds and changes of stability; print a short table, write "
        "SCENE-frc.nc and SCENE-frc.png.",
        epilog="example: microslip frc two-blades --set model=A -o model-a",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--tolerance",
        metavar="ERROR",
        help="relative error of amplitude at each point, instead of the scene's "
        "curve.tolerance: harmonics and samples follow from it",
    )
    parser.add_argument(
        "--branches",
        action="store_true",
        help="also follow the branches that begin at branch points",
    )
    parser.add_argument(
        "--detached",
        action="store_true",
        help="also seek curves that do not hang together with the first one, by "
        "varying the drive at 15 frequencies; what was searched and what not is said",
    )
    parser.add_argument(
        "--effort",
        type=arguments.positive,
        default=1.0,
        metavar="TIMES",
        help="work that the search for detached curves may take, over the usual: at "
        "each frequency 2000 evaluations with 31 harmonics, and fifty times that to "
        "follow a curve that is found (default: 1)",
    )
    parser.add_argument(
        "--unpruned",
        action="store_true",
        help="leave nothing out: all contact points, sectors, coordinates, orders and "
        "samples, whatever stays at zero; the curve is the same and takes longer, see "
        "microslip explain --time",
    )
    arguments.add_output(parser, "frc")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.curve import curve_figure
    from microslip.quantity import SceneError
    from microslip.scene_file import load_scene
    from microslip.store import Stored, save, save_figure

    data, picture = arguments.outputs(options, "frc")
    if options.tolerance is not None:
        options.overrides.append(f"curve.tolerance={options.tolerance}")
    scene = load_scene(options.scene, options.overrides)
    if options.tolerance is not None and scene.curve.harmonics is not None:
        raise SceneError(
            f"--tolerance {options.tolerance}: the scene fixes curve.harmonics = "
            f"{scene.curve.harmonics}: leave one of them out"
        )
    traced = _traced(options, scene)
    save(data, Stored(traced.curve, scene.text, options.command))
    save_figure(picture, curve_figure(traced.curve, arguments.title(options)))
    print(_table(traced))
    if traced.rest.normal_force.any():
        print(_rest(traced.curve.contacts, traced.rest))
    print(f"{len(traced.responses)} points in {data}, picture in {picture}")
    print(events_said(traced.curve))
    sought = options.branches and traced.curve.ending == "complete"
    for hertz in _barren(traced.curve) if sought else ():
        print(f"no branch is found at the branch point at {hertz:.6f} Hz")
    print(_resolution(traced.curve))
    if traced.searched is not None:
        print("\n".join(traced.searched.lines()))
    return arguments.ended(traced.curve.ending)


def _traced(options: argparse.Namespace, scene: Scene) -> Traced:
    """Return the curve of a scene, or of one sector that stands for a disk."""
    from microslip.rigs import problem_of, sector_of, unpruned_of
    from microslip.studies.curve import Wanted, trace_curve, trace_sector

    wanted = Wanted(options.branches, options.detached, options.effort)
    watch, searching = watched(scene.curve), search_watched(scene.curve)
    sector = None if options.unpruned else sector_of(scene)
    if sector is not None:
        return trace_sector(sector, scene.curve, watch, wanted)
    problem = unpruned_of(scene) if options.unpruned else problem_of(scene)
    pruned = not options.unpruned
    return trace_curve(problem, scene.curve, watch, wanted, searching, pruned=pruned)


def events_said(curve: ResponseCurve) -> str:
    """Return what was located on the curve, where it is missing and unstable."""
    from microslip.studies.gaps import lines as gap_lines

    lines = []
    for place, name in enumerate(curve.event):
        if name:
            hertz = curve.frequency[place] / math.tau
            largest = 1e3 * curve.amplitude[place].max()
            size = decimal(largest, largest, 6, 12)
            aside = about(curve.parameter_error[place] / math.tau)
            lines.append(
                f"{name:<16} {hertz:12.6f} Hz{aside:<10} {size} mm"
                f"{about(100.0 * curve.error[place], ' %')}"
            )
    lines += gap_lines(curve)
    if not curve.peak.any():
        lines.append("nothing moves at any frequency: the scene has no drive")
    unstable = curve.unstable > 0
    if unstable.any():
        hertz = curve.frequency[unstable] / math.tau
        lines.append(
            f"unstable at {unstable.sum()} of {unstable.size} points, between "
            f"{hertz.min():.4f} and {hertz.max():.4f} Hz; largest Floquet multiplier "
            f"{curve.multiplier.max():.4f}"
        )
    elif (curve.unstable == 0).all():
        lines.append("every point is stable")
    elif (curve.unstable == 0).any():
        lines.append(
            f"{(curve.unstable == 0).sum()} of {curve.unstable.size} points are "
            "stable, of the others the stability is not known"
        )
    else:
        lines.append("stability is not known: no Floquet multipliers are computed")
    return "\n".join(lines)


def _barren(curve: ResponseCurve) -> list[float]:
    """Return the branch points at which no branch begins or ends [Hz]."""
    marks = list(curve.event)
    first = marks.index("branch") if "branch" in marks else len(marks)
    reached = set(curve.frequency[first:])
    return [
        float(frequency) / math.tau
        for frequency, mark in zip(curve.frequency[:first], marks, strict=False)
        if mark == "branch point" and frequency not in reached
    ]


def _resolution(curve: ResponseCurve) -> str:
    """Return how accurate the curve is, and with how many harmonics."""
    import numpy as np

    known = 100.0 * curve.error[np.isfinite(curve.error)]
    lost = curve.error.size - known.size
    error = (
        f"at most {known.max():.2g} % at a point, {float(np.median(known)):.2g} % in "
        "the median"
        if known.size
        else "not known"
    )
    if known.size and lost:
        error += f", not known at {lost} of {curve.error.size} points"
    return (
        f"estimated error of amplitude: {error}; "
        f"{curve.harmonics.min():.0f} to {curve.harmonics.max():.0f} harmonics, "
        f"{curve.samples.min():.0f} to {curve.samples.max():.0f} samples"
    )


def watched(curve: Curve) -> Watch:
    """Return what shows the progress of a curve."""
    from microslip.progress import shown

    return lambda responses: shown(
        responses,
        total=abs(curve.highest - curve.lowest),
        done=lambda response: abs(response.frequency / math.tau - curve.lowest),
        unit="Hz",
        name="curve",
    )


def search_watched(curve: Curve) -> Watch:
    """Return what shows the progress of a search for detached curves."""
    from hbm.detached import Sought
    from microslip.progress import shown
    from microslip.studies.detached import FREQUENCIES

    width = math.tau * (curve.highest - curve.lowest)

    def done(each: object) -> float:
        if not isinstance(each, Sought):
            return 0.0
        share = (each.frequency - math.tau * curve.lowest) / width
        return math.ceil(FREQUENCIES * share)

    return lambda found: shown(
        found, total=FREQUENCIES, done=done, unit="frequencies", name="detached"
    )


def _rest(names: tuple[str, ...], rest: StaticState) -> str:
    """Return the normal forces under the preload alone."""
    points = zip(names, rest.normal_force, strict=True)
    forces = ", ".join(f"{name} {force:.3f}" for name, force in points)
    return f"normal force at rest [N]: {forces}"


def _table(traced: Traced) -> str:
    """Return the curve at about a dozen points, among them its largest amplitude."""
    from microslip.studies.curve import shown_points

    curve = traced.curve
    presses = bool(curve.normal_smallest.any() or curve.normal_largest.any())
    rubs = bool(curve.friction_energy.any())
    probes = tabled(curve.probes, curve.amplitude.max(axis=0))
    names = [curve.probes[each] for each in probes]
    head = f"frequency {titled(' first harmonic [mm]', names, len(curve.probes))}"
    units = f"     [Hz] {headed(names)}"
    if rubs:
        head, units = f"{head}     friction", f"{units}  [mJ/period]"
    if presses:
        force = "spring force [N]" if curve.pulls else "normal force [N]"
        head, units = f"{head}      {force}", f"{units}     least      most"
    lines = [head, units]
    largest = int(curve.amplitude.max(axis=1).argmax())
    energy = curve.friction_energy
    for place in shown_points(curve, largest):
        values = [
            f"{curve.frequency[place] / math.tau:9.4f}",
            *(
                decimal(1e3 * each[place], 1e3 * each.max(), 5)
                for each in curve.amplitude.T[probes]
            ),
        ]
        if rubs:
            values.append(decimal(1e3 * energy[place], 1e3 * energy.max(), 6, 12))
        if presses:
            values.append(f"{curve.normal_smallest[place].min():z9.3f}")
            values.append(f"{curve.normal_largest[place].max():z9.3f}")
        mark = "  largest" if place == largest else ""
        lines.append(" ".join(values) + mark)
    return "\n".join(lines)
