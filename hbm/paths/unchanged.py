"""What two problems along a parameter have in common."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.problem import Problem


def one_equilibrium(one: Problem, two: Problem) -> bool:
    """Return whether two problems of one structure have one equilibrium."""
    pairs = zip(one.interface.points, two.interface.points, strict=True)
    return _equal(one.preload, two.preload) and all(_equal(*pair) for pair in pairs)


def one_structure(one: Problem, two: Problem) -> bool:
    """Return whether two problems have one structure, seen by the same contacts."""
    names = ("mass", "damping", "stiffness")
    pairs = [
        (getattr(one.structure, name), getattr(two.structure, name)) for name in names
    ]
    pairs.append((one.interface.displacement, two.interface.displacement))
    return all(first is last or _equal(first, last) for first, last in pairs)


def _equal(first: np.ndarray, last: np.ndarray) -> bool:
    return first.shape == last.shape and not np.any(first != last)
