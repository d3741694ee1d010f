"""NetCDF 3 files that grow record by record, readable after each of them."""

from __future__ import annotations

import errno
import io
import os
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array

DIMENSION, VARIABLE, ATTRIBUTE = 10, 11, 12
"""what marks the lists of a header"""
CHARACTERS, INTEGER, DOUBLE = 2, 4, 6
"""types of numbers, as the format counts them"""
RECORDS = 4
"""where in a file the number of its records stands"""
Value: TypeAlias = bytes | int | float


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of the file; a record's share of it where it grows."""

    name: str
    dimensions: tuple[str, ...]
    """with the record's, if it grows"""
    shape: tuple[int, ...]
    """without the record's"""
    attributes: dict[str, Value]
    characters: bool
    grows: bool

    @property
    def size(self) -> int:
        """Bytes, or bytes in each record."""
        return (1 if self.characters else 8) * int(np.prod(self.shape, dtype=int))


@dataclass(frozen=True, slots=True)
class Layout:
    """Where everything stands in a file."""

    header: bytes
    attributes: dict[str, int]
    """begin of the value of each global attribute"""
    variables: dict[str, int]
    """begin of each variable that does not grow"""
    first_record: int
    record: int
    """bytes of a record"""

    def same(self, header: bytes) -> bool:
        """Return whether a file has its variables where this one has them."""
        last = max(self.attributes.values())
        return len(header) == len(self.header) and header[last:] == self.header[last:]


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
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        file.close()
        reason = "another command is writing it: wait for it, or give another name"
        raise OSError(errno.EWOULDBLOCK, reason) from None
    except (ImportError, OSError):  # a system, or a disk, that knows no locks
        pass
    return file


def layout(
    dimensions: Mapping[str, int],
    attributes: Mapping[str, Value],
    variables: Sequence[Variable],
) -> Layout:
    """Return header and places; the dimension of length 0 is that of the records."""
    begins = dict.fromkeys((each.name for each in variables), 0)
    length = len(_header(dimensions, attributes, variables, begins)[0])
    fixed = [each for each in variables if not each.grows]
    growing = [each for each in variables if each.grows]
    for each in (*fixed, *growing):
        begins[each.name] = length
        length += _padded(each.size)
    first = begins[growing[0].name]
    header, places = _header(dimensions, attributes, variables, begins)
    return Layout(
        header,
        places,
        {each.name: begins[each.name] for each in fixed},
        first,
        length - first,
    )


def _header(
    dimensions: Mapping[str, int],
    attributes: Mapping[str, Value],
    variables: Sequence[Variable],
    begins: Mapping[str, int],
) -> tuple[bytes, dict[str, int]]:
    """Return the header, and where in it the values of the attributes begin."""
    made = b"CDF\x02" + struct.pack(">i", 0)
    made += struct.pack(">ii", DIMENSION, len(dimensions))
    for name, size in dimensions.items():
        made += _name(name) + struct.pack(">i", size)
    made += struct.pack(">ii", ATTRIBUTE, len(attributes))
    places = {}
    for name, value in attributes.items():
        entry = _attribute(name, value)
        places[name] = len(made) + len(entry) - _padded(len(_content(value)))
        made += entry
    made += struct.pack(">ii", VARIABLE, len(variables))
    order = list(dimensions)
    for each in variables:
        places_of = [order.index(name) for name in each.dimensions]
        made += _name(each.name)
        made += struct.pack(f">i{len(places_of)}i", len(places_of), *places_of)
        made += struct.pack(">ii", ATTRIBUTE, len(each.attributes))
        made += b"".join(_attribute(*entry) for entry in each.attributes.items())
        kind = CHARACTERS if each.characters else DOUBLE
        made += struct.pack(">iiq", kind, _padded(each.size), begins[each.name])
    return made, places


def _name(name: str) -> bytes:
    text = name.encode()
    return struct.pack(">i", len(text)) + text.ljust(_padded(len(text)), b"\0")


def _attribute(name: str, value: Value) -> bytes:
    content = _content(value)
    kind = DOUBLE if isinstance(value, float) else INTEGER
    count = 1
    if isinstance(value, bytes):
        kind, count = CHARACTERS, len(content)
    made = _name(name) + struct.pack(">ii", kind, count)
    return made + content.ljust(_padded(len(content)), b"\0")


def _content(value: Value) -> bytes:
    if isinstance(value, bytes):
        return value
    return struct.pack(">d" if isinstance(value, float) else ">i", value)


def _padded(size: int) -> int:
    """Return the next multiple of four bytes."""
    return -(-size // 4) * 4
