"""A force over time from a text file of two columns."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from microslip.scenes.file_content import digest
from microslip.scenes.quantity import SceneError

if TYPE_CHECKING:
    from microslip_mechanics.arrays import Array

COLUMNS = "give time [s] and force [N], two numbers in each line"

POINT = ", with a decimal point, as a comma separates the two"
DECIMAL_COMMA = re.compile(r"\d,\d.*[;\s]|[;\s].*\d,\d")
"""in a line that is separated otherwise"""


@dataclass(frozen=True, slots=True)
class Force:
    """Values of a force."""

    time: Array
    """increasing, from 0 or later [s], shape (values,)"""
    force: Array
    """[N], shape (values,)"""
    digest: str
    """tells files of different content apart"""


def read_force(path: Path) -> Force:
    """Read a file of time [s] and force [N], separated by commas, semicolons or blanks.

    The first line may be a header; empty lines and those that begin with # say nothing.

    Raises
    ------
    SceneError
        With file, line and remedy.
    """
    import numpy as np

    content = _content(path)
    rows: list[tuple[float, float]] = []
    header = True
    for number, line in enumerate(content.splitlines(), start=1):
        text = line.strip()
        if not text or text.startswith("#"):
            continue
        row = _row(text)
        named = header and not re.match(r"[-+.\d]|nan\b|inf", text, re.IGNORECASE)
        if row is None and not named:
            hint = f"{COLUMNS}{POINT if DECIMAL_COMMA.search(text) else ''}"
            raise SceneError(f"{path}, line {number}: {_cut(text)}: {hint}")
        header = False
        if row is not None:
            _demand_later(path, number, row[0], rows[-1][0] if rows else None)
            rows.append(row)
    if len(rows) < 2:
        has = "one line" if rows else "no lines"
        raise SceneError(
            f"{path} has {has} with numbers: a force needs at least two: {COLUMNS}"
        )
    time, force = np.array(rows).T.copy()
    return Force(time, force, digest(content.encode()))


def _content(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (FileNotFoundError, NotADirectoryError):
        raise SceneError(f"there is no force file {path}: give its path") from None
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        raise SceneError(f"force file {path} cannot be read: {reason}") from None


def _row(text: str) -> tuple[float, float] | None:
    """Return two finite numbers, or None if the line has something else."""
    words = re.split(r"\s*[,;]\s*|\s+", text)
    try:
        time, force = (float(word) for word in words)
    except ValueError:
        return None
    return (time, force) if math.isfinite(time) and math.isfinite(force) else None


def _demand_later(path: Path, number: int, time: float, before: float | None) -> None:
    if before is None and time < 0.0:
        raise SceneError(f"{path}, line {number}: time {time:g} s: begin at 0 or later")
    if before is not None and not time > before:
        raise SceneError(
            f"{path}, line {number}: time {time:g} s does not come after {before:g} s: "
            "give increasing times"
        )


def _cut(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:40] + "…")
