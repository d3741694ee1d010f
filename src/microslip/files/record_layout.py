"""Headers of NetCDF 3 files that grow, and where their variables begin."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

DIMENSION, VARIABLE, ATTRIBUTE = 10, 11, 12
"""what marks the lists of a header"""
CHARACTERS, INTEGER, DOUBLE = 2, 4, 6
"""types of numbers, as the format counts them"""
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
