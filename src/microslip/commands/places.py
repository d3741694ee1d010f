"""Places of results: whether they can be written is told before the work."""

from __future__ import annotations

import os
from pathlib import Path

from microslip.errors import GivenError


class OutputError(GivenError):
    """Results have no place to go."""


def is_folder(path: Path) -> bool:
    """Return whether there is a folder of this name.

    Raises
    ------
    OutputError
        If there can be nothing of this name.
    """
    try:
        return path.is_dir()
    except OSError as error:
        raise _refused(path, error) from None


def demand_place(path: Path) -> None:
    """Refuse a file that cannot be written: better before the work than after it.

    Raises
    ------
    OutputError
        If its folder does not exist or is closed, a folder has its name, or its name is
        too long.
    """
    if not is_folder(path.parent):
        raise OutputError(
            f"there is no folder {path.parent} to write to: make it first"
        )
    if is_folder(path):
        raise OutputError(
            f"{path} is a folder and cannot be written: give the name of a file"
        )
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise OutputError(
            f"the folder {path.parent} cannot be written to: give another one"
        )
    try:
        there = path.exists()
    except OSError as error:
        raise _refused(path, error) from None
    if there and not os.access(path, os.W_OK):
        raise OutputError(f"{path} cannot be written to: give another name")


def demand_no_scene(path: Path, option: str, ending: str) -> None:
    """Refuse a result with the ending of scene files, in place of one of its own.

    Raises
    ------
    OutputError
        If it has that, and is no folder.
    """
    if path.suffix == ".toml" and not is_folder(path):
        raise OutputError(
            f"{option} {path} is the name of a scene, not of a result: give one that "
            f"ends with {ending}, or has no ending"
        )


def demand_no_device(path: Path, option: str) -> None:
    """Refuse a device or a pipe as the name that files get endings to.

    Raises
    ------
    OutputError
        If it is one: files of its name with endings would stand beside it.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise OutputError(
            f"{option} {path} is no file: results would stand beside it, with endings: "
            "give a folder, or a path without ending"
        )


def demand_apart(shown: Path, data: Path, what: str = "picture") -> None:
    """Refuse a picture, or a table, that would be written over the data that it shows.

    Raises
    ------
    OutputError
        If both are one file.
    """
    if data.exists() and shown.exists() and shown.samefile(data):
        raise OutputError(
            f"{shown} holds the result, and its {what} would be written over it: "
            f"give the result a name that ends with .nc, or the {what} another name"
        )


def _refused(path: Path, error: OSError) -> OutputError:
    reason = error.strerror or error
    name = f"{path.name[:40]}…" if len(path.name) > 40 else path.name
    where = path.with_name(name) if path.name else path
    return OutputError(f"{where} cannot be written: {reason}: give another name")
