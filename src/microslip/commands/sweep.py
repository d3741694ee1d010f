"""microslip sweep: the swept sine by time integration."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from microslip.commands import arguments

if TYPE_CHECKING:
    from microslip.progress import Watch
    from microslip_mechanics.time_history import TimeHistory


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "sweep",
        help="swept sine by time integration",
        description="March the scene through its swept sine; print energies and "
        "extremes, write SCENE-sweep.nc and SCENE-sweep.png.",
        epilog="example: microslip sweep two-blades --set sweep.highest='150 Hz'",
    )
    arguments.add_scene(parser)
    arguments.add_output(parser, "sweep")
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.figures.sweep import sweep_figure
    from microslip.rigs import problem_of
    from microslip.scene_file import load_scene
    from microslip.store import Stored, save, save_figure
    from microslip.studies.sweep import march_sweep, swept_sine

    data, picture = arguments.outputs(options, "sweep")
    scene = load_scene(options.scene, options.overrides)
    history = march_sweep(
        problem_of(scene),
        swept_sine(scene.sweep),
        scene.march,
        watched(scene.sweep.duration),
    )
    save(data, Stored(history, scene.text, options.command))
    save_figure(picture, sweep_figure(history, arguments.title(options)))
    print(_table(history))
    print(f"{len(history.time)} times in {data}, picture in {picture}")
    return arguments.ended(history.ending)


def watched(duration: float, name: str = "sweep") -> Watch:
    """Return what shows the progress of a march."""
    from microslip.progress import shown

    return lambda blocks: shown(
        blocks, total=duration, done=lambda block: block.time[-1], unit="s", name=name
    )


def _table(history: TimeHistory) -> str:
    """Return energies, closing error and extremes."""
    lines = [f"energy until {history.time[-1]:g} s [J]"]
    lines += [
        f"  {name.replace('_', ' '):20s} {history.of(name)[-1]:12.6g}"
        for name in history.energies
    ]
    closing = abs(history.closing_error).max()
    share = closing / max(abs(history.of("input")).max(), 1e-300)
    lines.append(f"  {'closing error':20s} {closing:12.2g}  ({share:.1e} of the input)")
    lines.append("largest displacement [mm] and velocity [m/s]")
    for place, name in enumerate(history.probes):
        moved = 1e3 * abs(history.displacement[:, place]).max()
        moving = abs(history.velocity[:, place]).max()
        lines.append(f"  {name:20s} {moved:12.6g} {moving:12.6g}")
    lines.append("normal force [N], least and most")
    for place, name in enumerate(history.contacts):
        force = history.normal_force[:, place]
        lines.append(f"  {name:20s} {force.min():12.6g} {force.max():12.6g}")
    if history.divided:
        lines.append(f"{history.divided} steps converged only when divided")
    return "\n".join(lines)
