"""microslip explain: what a scene keeps and what is left out."""

from __future__ import annotations

import argparse

from microslip.commands import arguments

IMPORTS = """\
imports, by command (those that it does not need are never loaded):
  scenes            no numpy, no solver
  frc               hbm with pyfftw; not timedomain
  sweep, tables     timedomain; neither hbm nor pyfftw
  verify            both
  plot              neither"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "explain",
        help="what a scene keeps and what is left out, with counts and reasons",
        description="Count what a scene's solvers carry, and what they leave out "
        "because the scene does not need it.",
        epilog="example: microslip explain two-blades --set model=A",
    )
    arguments.add_scene(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.scene_file import load_scene
    from microslip.studies.explain import obeyed, pruned

    scene = load_scene(options.scene, options.overrides)
    print(f"{'':36s}  kept  left out  reason")
    for each in pruned(scene):
        left = each.whole - each.kept
        print(f"{each.what:36s} {each.kept:5d} {left:9d}  {each.reason}")
    for name, law, equation in obeyed(scene):
        print(f"{name:20s} {law:18s} {equation}")
    print(IMPORTS)
    return 0
