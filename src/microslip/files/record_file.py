"""NetCDF 3 files that grow record by record, readable after each of them."""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from microslip.files.lock import lock
from microslip.files.record_layout import Layout
from microslip_mechanics.arrays import Array

RECORDS = 4
"""where in a file the number of its records stands"""


class RecordFile:
    """A file open for more records; each number is written in one go.

    Whoever reads it sees whole records only, as their number is raised last. Nobody
    else writes it as long as it is open.
    """

    def __init__(self, path: Path, layout: Layout, *, goes_on: bool) -> None:
        """Open a file for a new march, or for one that goes on.

        Raises
        ------
        OSError
            If it cannot be written, or if another command is writing it.
        """
        self._layout = layout
        self._file = _alone(path, 0 if goes_on else os.O_CREAT)
        if not goes_on:
            if os.fstat(self._file.fileno()).st_size:
                self._file.truncate(0)
            self._file.write(layout.header)
            missing = layout.first_record - len(layout.header)
            self._file.write(b"\0" * missing)

    def keep(self, records: int) -> None:
        """Forget the records behind so many."""
        self._file.truncate(self._layout.first_record + records * self._layout.record)
        self._at(RECORDS, struct.pack(">i", records))

    def append(self, records: int, rows: Sequence[Array], states: bytes | None) -> int:
        """Write rows behind so many records; return how many there are then.

        ``rows`` are the columns of the growing variables, in their order, each of shape
        ``(records, numbers)``; ``states`` replaces the last of the others before the
        new records count.

        Raises
        ------
        ValueError
            If the states are not as long as those that they replace.
        """
        count = len(rows[0])
        table = np.concatenate(rows, axis=1)
        place = self._layout.first_record + records * self._layout.record
        self._at(place, table.astype(">f8").tobytes())
        if states is not None:
            begin = self._layout.first_record - len(states)
            if begin not in self._layout.variables.values():
                raise ValueError("a state is as long as the one before it")
            self._at(begin, states)
        self._at(RECORDS, struct.pack(">i", records + count))
        return records + count

    def put(self, name: str, content: bytes) -> None:
        """Write a variable that does not grow."""
        self._at(self._layout.variables[name], content)

    def put_attribute(self, name: str, content: bytes) -> None:
        """Write the value of a global attribute over one as long."""
        self._at(self._layout.attributes[name], content)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _at(self, place: int, content: bytes) -> None:
        self._file.seek(place)
        left = memoryview(content)
        while left:
            left = left[self._file.write(left) :]


def _alone(path: Path, create: int) -> io.FileIO:
    """Open a file as it is; keep other commands from it, where the system can."""
    file = io.FileIO(
        path, "r+", opener=lambda name, flags: os.open(name, flags | create, 0o666)
    )
    try:
        lock(file)
    except OSError:
        file.close()
        raise
    return file
