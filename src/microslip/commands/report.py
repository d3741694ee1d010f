"""microslip report: one page with all that is known of a scene."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from microslip.commands import arguments
from microslip.commands.places import OutputError, demand_place, is_folder
from microslip.commands.report_parts import PARTS
from microslip.commands.report_sections import section_of, words_of
from microslip.page import DONE, LEFT_OUT, STOPPED, Section, page

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene

LIBRARIES = ("numpy", "scipy", "numba", "pyfftw", "matplotlib")
PAGE = "index.html"


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = commands.add_parser(
        "report",
        help="one HTML page: curve, sweep, agreement, precision, tables, stress, …",
        description="Run the commands that tell something of a scene, one after the "
        "other, and write one page, index.html, with what they print and draw, that "
        "needs no network. Their own files lie beside it. Exit status 1 if a section "
        "fails.",
        epilog="example: microslip report two-blades --set model=A -o report",
    )
    arguments.add_scene(parser)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="DIR",
        help="folder of the page, made if there is none (default: SCENE-report here)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="fewer and looser settings in each section"
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from microslip.progress import shown
    from microslip.scenes.scene_file import load_scene

    scene = load_scene(options.scene, options.overrides)
    folder = _folder(options)
    made = [_scene(scene)]
    try:
        for section in shown(
            _sections(options, scene, folder),
            total=len(PARTS),
            done=lambda _: float(len(made)),
            unit="sections",
            name="report",
        ):
            made.append(section)
            print(f"{section.name:10s} {section.state:8s} {section.result}", flush=True)
            _write(folder, options, made)
            if section.state == STOPPED:
                break
    except KeyboardInterrupt:
        made.append(Section("stopped", "Stopped", "", STOPPED, "interrupted"))
    written = _write(folder, options, [*made, _versions()])
    print(f"page in {written}")
    states = {each.state for each in made}
    if STOPPED in states:
        return arguments.ended("interrupted")
    return 0 if states <= {DONE, LEFT_OUT} else 1


def _folder(options: argparse.Namespace) -> Path:
    """Return the folder of the page, which is made if need be.

    Raises
    ------
    OutputError
        If it cannot be made.
    """
    chosen: Path = options.output or Path(f"{Path(options.scene).stem}-report")
    if is_folder(chosen.parent) and chosen.exists() and not is_folder(chosen):
        raise OutputError(
            f"{chosen} is a file: the page goes into a folder, give the name of one"
        )
    try:
        chosen.mkdir(exist_ok=True)
    except OSError as error:
        reason = error.strerror or error
        raise OutputError(f"the folder {chosen} cannot be made: {reason}") from None
    demand_place(chosen / PAGE)
    return chosen


def _sections(
    options: argparse.Namespace, scene: Scene, folder: Path
) -> Iterator[Section]:
    """Yield a section for each part, also where it does not apply."""
    for part in PARTS:
        excuse = part.excuse(scene)
        if options.quick and part.quick is None:
            excuse = excuse or "Left out of a quick report: it takes minutes."
        if excuse:
            yield Section(part.command, part.title, part.about, LEFT_OUT, excuse)
        else:
            place = (options.scene, options.overrides, folder)
            words = words_of(part.suited(scene), *place, quick=options.quick)
            yield section_of(part, words, folder, options.main)


def _scene(scene: Scene) -> Section:
    """Return the section with the scene's text."""
    return Section(
        "scene",
        "The scene",
        "All numbers, as TOML; what --set has replaced stands at the end.",
        DONE,
        f'scene = "{_kind(scene)}"',
        text=scene.text.rstrip(),
    )


def _kind(scene: Scene) -> str:
    return {"TwoBlades": "two-blades", "BladedDisk": "bladed-disk"}.get(
        type(scene.rig).__name__, "system"
    )


def _versions() -> Section:
    """Return the section with what made the page."""
    import platform
    from importlib.metadata import version

    lines = [f"{name:12s} {version(name)}" for name in ("microslip", *LIBRARIES)]
    lines.append(f"{'Python':12s} {platform.python_version()}")
    lines.append(f"{'system':12s} {platform.platform()}, {platform.machine()}")
    return Section(
        "versions",
        "Versions",
        "What made this page.",
        DONE,
        lines[0].replace("  ", " "),
        text="\n".join(lines),
    )


def _write(folder: Path, options: argparse.Namespace, sections: list[Section]) -> Path:
    """Write the page with the sections that there are; return its path.

    Raises
    ------
    StoreError
        If it cannot be written.
    """
    from microslip.files.store import told
    from microslip.files.whole_file import write_whole

    path = folder / PAGE
    made = time.strftime("%Y-%m-%d %H:%M %Z")
    about = f"microslip report, {made}"
    text = page(arguments.title(options), about, options.command, sections)
    with told(path):
        write_whole(path, text.encode())
    return path
