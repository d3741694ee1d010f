"""microslip explain: what a scene keeps, what is left out, and what that saves."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments, frc

if TYPE_CHECKING:
    from microslip.studies.explain.unpruned import Timed

IMPORTS = """\
imports, by command (those that it does not need are never loaded):
  scenes            no numpy, no solver
  frc               hbm with pyfftw; not timedomain
  sweep, tables     timedomain; neither hbm nor pyfftw
  verify            both
  plot              neither"""
AGREED = 1e-6
"""relative difference of amplitudes up to which both curves are one"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "explain",
        help="what a scene keeps and what is left out, with counts and reasons",
        description="Count what a scene's solvers carry, and what they would without "
        "leaving out what the scene does not need: contact points of the full model, "
        "sectors of a disk, coordinates and orders that a symmetry keeps still, the "
        "second half of a period, tangents that are zero, code of other commands.",
        epilog="example: microslip explain two-blades --set model=A --time",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "--time",
        action="store_true",
        help="also trace the curve with and without pruning, both with the scene's "
        "fixed harmonics (31 if it has none), and compare time and amplitudes; exit "
        "status 1 if they are not the same",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.scenes.scene_file import load_scene
    from microslip.studies.explain.explain import obeyed, pruned

    scene = load_scene(options.scene, options.overrides)
    counts = pruned(scene)
    print(f"{'':48s}  kept  unpruned  reason")
    for each in counts:
        print(f"{each.what:48s} {each.kept:5d} {each.whole:9d}  {each.reason}")
    for name, law, equation in obeyed(scene):
        print(f"{name:20s} {law:18s} {equation}")
    print(IMPORTS)
    if not options.time:
        return 0
    from microslip.studies.explain.unpruned import timed

    try:
        some, every = timed(scene, frc.watched(scene.curve))
    except KeyboardInterrupt:
        return arguments.ended("interrupted", kept=False)
    return _compared(some, every)


def _compared(some: Timed, every: Timed) -> int:
    """Print both curves side by side; return the exit status."""
    from microslip.studies.explain.unpruned import difference

    harmonics, samples = some.curve.harmonics[0], some.curve.samples[0]
    title = f"curve with {harmonics:.0f} harmonics, {samples:.0f} samples"
    print(f"{title:46s}  pruned  unpruned")
    for name, form, values in _measured(some, every):
        print(f"{name:46s} {values[0]:>7{form}} {values[1]:>9{form}}")
    endings = [each.curve.ending for each in (some, every)]
    if endings != ["complete"] * 2:
        ending = next(each for each in endings if each != "complete")
        return arguments.ended(ending, kept=False)
    apart = difference(some, every)
    print(f"unpruned, the curve takes {every.seconds / some.seconds:.1f} x as long")
    same = apart <= AGREED
    print(
        f"{'agree' if same else 'DISAGREE'}: amplitudes at both ends and where the "
        f"first is largest differ by {apart:.1e}"
    )
    return 0 if same else 1


def _measured(some: Timed, every: Timed) -> list[tuple[str, str, list[float]]]:
    """Return name, format and values of what was measured."""
    both = (some, every)
    return [
        ("processor time [s]", ".2f", [each.seconds for each in both]),
        ("points", ".0f", [each.curve.frequency.size for each in both]),
        ("Newton iterations", ".0f", [_iterations(each) for each in both]),
        ("largest amplitude [mm]", ".4g", [_largest(each) for each in both]),
    ]


def _iterations(timed: Timed) -> float:
    return float(timed.curve.iterations.sum())


def _largest(timed: Timed) -> float:
    return float(1e3 * timed.curve.amplitude.max())
