"""Files that are written at once: whoever reads one, or stops, has no half of it."""

from __future__ import annotations

import os
from pathlib import Path

from microslip.files.lock import lock


def write_whole(path: Path, content: bytes) -> None:
    """Put a file in the place of another one, whoever else writes there.

    Of two programs that write to one path, the file of the later one stays, whole; that
    of a march under way is left to it. What is no plain file, such as a pipe, is
    written to as it is.

    Raises
    ------
    OSError
        If it cannot be written, or if a march is writing it.
    """
    place = path.resolve()
    if place.exists() and not place.is_file():
        place.write_bytes(content)
        return
    beside = place.with_name(f"{place.name[:200]}.{os.getpid()}.part")
    try:
        beside.write_bytes(content)
        if place.exists():
            with place.open("r+b") as file:  # it may be closed to us
                lock(file, shared=True)
                beside.chmod(place.stat().st_mode)
        beside.replace(place)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
