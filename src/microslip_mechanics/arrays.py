"""Arrays: the types that every signature of the project speaks of, and their size."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.floating[Any]]
"""real, always float64 at run time"""
ComplexArray: TypeAlias = NDArray[np.complexfloating[Any, Any]]
"""always complex128 at run time"""
Matrix: TypeAlias = Any
"""an :data:`Array` of two axes, or the like of scipy.sparse"""
TINY = 1e-300
"""in place of a size of zero, by which nothing can be divided"""


def largest(values: Array | ComplexArray) -> float:
    """Return the largest modulus of values of any shape, zero if there are none."""
    return float(np.abs(values).max(initial=0.0))


def masked(given: object) -> bool:
    """Return whether some entries of an array are masked: they hold no numbers."""
    return bool(np.ma.is_masked(given))


def shown(given: object) -> str:
    """Return what was given, arrays too, in one line."""
    return " ".join(repr(given).split())


def numbers_of(given: object) -> Array:
    """Return finite real numbers as an array; one of shape (0,) if they are none."""
    if masked(given):
        return np.empty(0)
    try:
        found: Array = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        return np.empty(0)
    plain = np.asarray(given).dtype.kind in "iuf"
    return found if plain and np.isfinite(found).all() else np.empty(0)
