"""Results of marches on disk: written block by block, read in parts, continued."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from microslip.files.record_file import RecordFile
from microslip.files.record_layout import Layout, Value, Variable, layout
from microslip.files.schema import (
    GROWS,
    SCHEMAS,
    Growing,
    Schema,
    columns,
    flat,
    kind_of,
)

if TYPE_CHECKING:
    from scipy.io import netcdf_file

    from microslip_mechanics.arrays import Array

ORIGIN = ("kind", "source", "command", "scene")
"""global attributes of all files"""
RESERVED = 1024
"""bytes for the text of how a march ended"""


@dataclass(frozen=True, slots=True)
class Head:
    """What of a file does not grow, and how long it has grown."""

    kind: str
    about: Mapping[str, Value]
    """global attributes"""
    fixed: Mapping[str, np.ndarray]
    """variables without the growing dimension"""
    growing: tuple[str, ...]
    """names of the others"""
    rows: int

    @classmethod
    def of(cls, block: Growing, about: Mapping[str, Value]) -> Head:
        """Return the head of a file that begins with a block."""
        kind, schema = kind_of(block)
        width = {
            name: getattr(block, name).shape
            for name, (dimensions, *_) in schema.items()
            if dimensions[0] == GROWS[kind]
        }
        growing = tuple(
            name
            for name, (count, *others) in width.items()
            if count == len(block.time) and np.prod(others, dtype=int) > 0
        )
        whole = columns(block, schema)
        fixed = {name: each for name, each in whole.items() if name not in width}
        return cls(kind, about, fixed, growing, 0)

    @classmethod
    def read(cls, file: netcdf_file, kind: str) -> Head:
        """Return the head of an open file."""
        names = (*ORIGIN, *(field.name for field in fields(SCHEMAS[kind][0])))
        found = {name: getattr(file, name) for name in names if hasattr(file, name)}
        about = {
            name: value if isinstance(value, bytes) else value.item()
            for name, value in found.items()
        }
        held = file.variables
        growing = tuple(name for name, each in held.items() if each.isrec)
        fixed = {
            name: np.array(held[name].data) for name in held if name not in growing
        }
        rows = len(held["time"].data)
        return cls(kind, about, fixed, growing, rows)

    @property
    def schema(self) -> Schema:
        """Its variables."""
        return SCHEMAS[self.kind][1]

    def text(self, name: str) -> str:
        """Return an attribute that is a text."""
        value = self.about[name]
        return value.decode() if isinstance(value, bytes) else str(value)

    @property
    def sizes(self) -> dict[str, int]:
        """Length of each dimension, 0 of the one that grows."""
        found = {GROWS[self.kind]: 0}
        for name, values in self.fixed.items():
            found |= zip(self.schema[name][0], values.shape, strict=True)
        return found

    def width(self, name: str) -> int:
        """Return how many numbers of a growing variable a row has."""
        sizes = self.sizes
        return int(np.prod([sizes[each] for each in self.schema[name][0][1:]]))

    @property
    def layout(self) -> Layout:
        """Where everything stands; a text of how it ended has its place reserved."""
        reserved = self.text("ending").encode().ljust(RESERVED, b"\0")
        return layout(
            self.sizes,
            {**self.about, "ending": reserved},  # the last, for Layout.same
            [self._variable(name) for name in (*self.fixed, *self.growing)],
        )

    def _variable(self, name: str) -> Variable:
        dimensions, unit, meaning = self.schema[name]
        grows = name in self.growing
        sizes = self.sizes
        return Variable(
            name,
            dimensions,
            tuple(sizes[each] for each in dimensions if not grows or sizes[each]),
            {"long_name": meaning.encode(), "units": unit.encode()},
            characters="name" in dimensions,
            grows=grows,
        )


class Stream:
    """A result file that grows block by block; after each it is a whole file."""

    def __init__(self, path: Path, head: Head) -> None:
        """Begin a file, or go on with one behind the rows that its head tells."""
        self._head, self.rows = head, head.rows
        self._work = {
            name: int(head.about[name]) if head.rows else 0
            for name in ("iterations", "divided")
        }
        self._file = RecordFile(path, head.layout, goes_on=head.rows > 0)
        if head.rows:
            self._file.keep(head.rows)
        else:
            for name, values in head.fixed.items():
                if name != "checkpoint":
                    self._file.put(name, values.tobytes())

    def append(self, block: Growing) -> None:
        """Write the rows of a block, and where its march can go on."""
        count = len(block.time)
        rows = [
            getattr(block, name).reshape(count, self._head.width(name))
            for name in self._head.growing
        ]
        state = None
        if block.checkpoint is not None:
            behind = flat(block.checkpoint, self.rows + count)
            state = behind.astype(">f8").tobytes()
        self.rows = self._file.append(self.rows, rows, state)
        for name in self._work:  # of rows that are there: a full disk ends before this
            self._work[name] += getattr(block, name)
            number = min(self._work[name], 2**31 - 1)
            self._file.put_attribute(name, number.to_bytes(4, "big"))

    def end(self, ending: str) -> None:
        """Write how the march ended."""
        place = max(RESERVED, len(self._head.text("ending").encode()))
        text = ending.encode()[:place].ljust(place, b"\0")
        self._file.put_attribute("ending", text)

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def rows_of(path: Path, head: Head, first: int, count: int) -> dict[str, Array]:
    """Return some rows of each growing variable.

    Raises
    ------
    ValueError
        If the file does not hold them, or is not as :class:`Stream` writes it.
    """
    places = head.layout
    with path.open("rb") as file:
        if not places.same(file.read(len(places.header))):
            raise ValueError("the file was written by another program")
        file.seek(places.first_record + first * places.record)
        data = np.fromfile(file, ">f8", count * places.record // 8)
    widths = [head.width(name) for name in head.growing]
    table = data.reshape(count, sum(widths)).astype(float)
    parts = np.split(table, np.cumsum(widths)[:-1], axis=1)
    return {
        name: part if len(head.schema[name][0]) > 1 else part[:, 0]
        for name, part in zip(head.growing, parts, strict=True)
    }
