"""Results are equal if all that they hold is."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np


class ByValue:
    """Base of frozen dataclasses with arrays, which dataclasses cannot compare.

    They are declared with ``eq=False``. Values that are not known (NaN) are equal.
    """

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]  # arrays have none

    def __eq__(self, other: object) -> bool:
        """Return whether both are of one kind and hold the same."""
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in dataclasses.fields(self)]  # type: ignore[arg-type]
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)


def _same(one: Any, other: Any) -> bool:  # noqa: ANN401  (of any field)
    arrays = isinstance(one, np.ndarray), isinstance(other, np.ndarray)
    if all(arrays):
        return np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")
    if any(arrays):
        return False
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (one != one and other != other)
    return bool(one == other)
