"""How the sections of a report are made: by commands, in this process."""

from __future__ import annotations

import contextlib
import io
import shlex
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from microslip.commands.report_parts import Part
from microslip.page import DONE, FAILED, STOPPED, Section

INTERRUPTED = 130


def section_of(
    part: Part, words: list[str], folder: Path, run: Callable[[list[str]], int]
) -> Section:
    """Run a part's command in this process; return what it prints and draws."""
    picture = (folder / part.command).with_suffix(".png")
    picture.unlink(missing_ok=True)  # that of an earlier report
    began = time.perf_counter()
    status, said, complaints = _ran(words, run)
    state = {0: DONE, INTERRUPTED: STOPPED}.get(status, FAILED)
    result = _telling(part, said) if state == DONE else ""
    if state != DONE:
        result = complaints or _telling(part, said) or f"exit status {status}"
    return Section(
        part.command,
        part.title,
        part.about,
        state,
        result or "done",
        shlex.join(["microslip", *words]),
        said,
        [picture] if part.files and picture.is_file() else [],
        time.perf_counter() - began,
    )


def words_of(
    part: Part, scene: str, overrides: Sequence[str], folder: Path, *, quick: bool
) -> list[str]:
    """Return the words of a part's command line."""
    words = [part.command]
    if part.scene:
        words.append(scene)
    words += (part.quick if quick else part.more) or ()
    if part.scene:
        words += [f"--set={each}" for each in overrides]
    return [*words, "-o", str(folder / part.command)] if part.files else words


def _ran(words: list[str], run: Callable[[list[str]], int]) -> tuple[int, str, str]:
    """Return exit status, output and complaints of a command."""
    said, complaints = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complaints):
        try:
            status = run(words)
        except Exception as error:  # a defect costs its section alone
            status = 1
            complaints.write(f"{type(error).__name__}: {error}")
    told = " ".join(complaints.getvalue().removeprefix("microslip: ").split())
    return status, said.getvalue().rstrip(), told


def _telling(part: Part, said: str) -> str:
    """Return the lines that say a part's result, the last of each kind."""
    found = [
        [line for line in said.splitlines() if words in line] for words in part.tells
    ]
    return "; ".join(" ".join(lines[-1].split()) for lines in found if lines)
