"""Scenes: TOML text to checked tables; every message names file, table and key."""

from __future__ import annotations

import dataclasses
import tomllib
import typing
from importlib import resources
from pathlib import Path

from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.experiments import Curve, March, Sweep, check_curve, check_sweep
from microslip.scenes.file_content import with_files
from microslip.scenes.force_file import read_force
from microslip.scenes.override import apply_override
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Experiments, Scene
from microslip.scenes.table import meant, read_table, shown
from microslip.scenes.two_blades.tables import TwoBlades

KINDS = ("two-blades", "system", "bladed-disk")
"""what ``scene = "…"`` may name"""
SYSTEMS = (
    "duffing",
    "jenkins",
    "gap",
    "nonlinear-absorber",
    "chain",
    "friction-beam",
    "tip-damper",
    "platform-damper",
)
BUILT_IN = ("two-blades", "bladed-disk", *SYSTEMS)
"""names of built-in scenes"""


def built_in_text(name: str) -> str:
    """Return the TOML of a built-in scene."""
    kind = "systems" if name in SYSTEMS else name.replace("-", "_")
    folder = resources.files("microslip.scenes") / kind
    return (folder / f"{name}.toml").read_text(encoding="utf-8")


def load_scene(source: str, overrides: typing.Sequence[str] = ()) -> Scene:
    """Read a built-in scene by name, or a scene file.

    Parameters
    ----------
    source
        Name of a built-in scene, or path of a TOML file.
    overrides
        Texts ``table.key=value`` that replace values; ``value`` is TOML, or a text.

    Raises
    ------
    SceneError
        With file, table, key, value and remedy.
    """
    path = Path(source)
    if source in BUILT_IN and not path.is_file():
        text = built_in_text(source)
    else:
        text = _read(source)
    try:
        document = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise SceneError(f"{source}: not valid TOML: {error}") from None
    for override in overrides:
        apply_override(document, override)
        text += f"\n# --set {override}"
    scene = _with_matrices(_scene(source, document, text))
    sweep = scene.experiments.sweep
    if sweep is None or sweep.force_file is None:
        return scene
    return _with_force(path, scene, sweep.force_file)


def _with_matrices(scene: Scene) -> Scene:
    """Return a scene whose text tells the content of its files of matrices."""
    if isinstance(scene.rig, TwoBlades | BladedDisk):
        return scene
    from microslip.scenes.systems.matrix_files import matrix_digests

    text = with_files(scene.text, matrix_digests(scene.rig.matrices))
    return dataclasses.replace(scene, text=text)


def _with_force(path: Path, scene: Scene, name: str) -> Scene:
    """Return a scene with the force of a file, sought beside the scene file."""
    folder = path.parent if path.is_file() else Path()
    force = read_force(folder / name)
    text = with_files(scene.text, [("force", force.digest)])
    return dataclasses.replace(scene, force=force, text=text)


def _read(source: str) -> str:
    if not source.strip():
        raise SceneError(
            f"a scene of no name cannot be read: give a path, or one of "
            f"{', '.join(BUILT_IN)}"
        )
    try:
        return Path(source).read_text(encoding="utf-8-sig")
    except (FileNotFoundError, NotADirectoryError):
        hint = meant(source, BUILT_IN).replace("give one", "give a path, or one")
        raise SceneError(
            f"there is no scene file {source}, and no built-in scene of that name{hint}"
        ) from None
    except (OSError, ValueError) as error:
        coded = isinstance(error, UnicodeDecodeError)
        reason = "it is not UTF-8 text" if coded else getattr(error, "strerror", error)
        raise SceneError(f"{_printed(source)} cannot be read: {reason}") from None


def _printed(source: str) -> str:
    """Return a name without characters that none can have."""
    return source.replace("\0", "\\0")


def _scene(source: str, document: dict[str, typing.Any], text: str) -> Scene:
    if not document:
        raise SceneError(
            f"{source} is empty: give it a scene, such as what microslip scenes "
            f"{BUILT_IN[0]} prints"
        )
    kind = document.pop("scene", None)
    if kind not in KINDS:
        raise SceneError(
            f"{source}: scene{' is missing' if kind is None else shown(kind)}: name "
            f'the kind of scene at the top, such as scene = "{KINDS[1]}", one of '
            f"{', '.join(KINDS)}"
        )
    tables = {"sweep": Sweep, "curve": Curve, "march": March}
    made = {
        name: read_table(source, f"[{name}] ", table, document.pop(name))
        for name, table in tables.items()
        if name in document
    }
    experiments = Experiments(**made)
    rig = _rig(source, str(kind), document, [*tables, "scene"])
    if experiments.sweep is not None:
        check_sweep(source, experiments.sweep)
    if experiments.curve is not None:
        check_curve(source, experiments.curve)
    return Scene(source, rig, experiments, text)


def _rig(
    source: str, kind: str, document: dict[str, typing.Any], known: list[str]
) -> object:
    """Return the tables of a kind of scene."""
    if kind == "system":
        # what it needs knows numbers, which the list of scenes must not wait for
        from microslip.scenes.systems.read import read_system

        return read_system(source, document, known)
    table = BladedDisk if kind == "bladed-disk" else TwoBlades
    try:
        return read_table(source, "", table, document, known)
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None
