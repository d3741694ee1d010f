"""microslip scenes: the built-in scenes, or the text of one."""

from __future__ import annotations

import argparse

VARIANTS = """\
two-blades   two turbine blades coupled at their shrouds by a friction element
  variants, by --set or in a copy of the file:
    model=full | B | A            full; B: no rotation, one point a face; A: B with
                                  constant normal load
    friction.law=coulomb | gkf | none
    contact.sigma=3e-9 | 3e-7     stiff or soft contact
    contact.damping_ratio=0.05    normal contact damping
    rope.stiffness=0              no rope
bladed-disk  a disk of lumped sectors, tips of neighbouring blades rub on each other
  variants:
    solve=sector | disk           one sector by cyclic symmetry, or the whole disk
    mistuning.deviation=0.01      random stiffness of the sectors, of the whole disk
    friction.law=jenkins | coulomb, sectors=…, drive.engine_order=…
systems of any matrices and elements (scene = "system"):
  duffing          a mass on a linear and a cubic spring
  jenkins          a mass on a spring and an elastic dry-friction slider
  gap              a mass that meets a stop behind a gap
  nonlinear-absorber
                   Duffing's oscillator with a tuned absorber and a detached curve
  chain            three masses, sliders, cubic springs and a stop (NLvib, example 07)
  friction-beam    a cantilever with dry friction at its tip
  tip-damper       a blade with a pin pressed to its tip, contact in three dimensions
  platform-damper  a wedge pressed under a blade's platform by its centrifugal force
  variants by --set element.NAME.KEY=VALUE, drive.DOF=VALUE, structure.damping_ratio=…
microslip scenes two-blades > mine.toml    makes a copy to change"""


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "scenes",
        help="list the built-in scenes, or print one as TOML",
        description="List the built-in scenes with their variants, or print the TOML "
        "of one, to be copied and changed.",
        epilog="example: microslip scenes two-blades > mine.toml",
    )
    parser.add_argument("scene", nargs="?", help="built-in scene to print")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    if options.scene is None:
        print(VARIANTS)
        return 0
    from microslip.scenes.quantity import SceneError
    from microslip.scenes.scene_file import BUILT_IN, built_in_text
    from microslip.scenes.table import meant

    if options.scene not in BUILT_IN:
        raise SceneError(
            f"there is no built-in scene {options.scene}"
            f"{meant(options.scene, BUILT_IN)}"
        )
    print(built_in_text(options.scene), end="")
    return 0
