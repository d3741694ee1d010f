"""What lies between the pieces of a curve, where none was found (theory §6)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hbm.errors import REMEDY
from microslip_mechanics.response_curve import ResponseCurve

NARROW = 0.01
"""share of its range that a whole curve may leave out"""
MISSING = "no curve is found between"
"""begins the ending of a curve that comes to its end with a gap"""
OTHERS = ("branch", "detached")
"""marks of the first point of what does not belong to the curve itself"""


def told(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve whose ending says where it is missing, if that is not narrow."""
    if curve.ending != "complete" or uncovered(curve) <= NARROW:
        return curve
    missing = " and ".join(lines(curve))
    return replace(curve, ending=f"{missing}: {REMEDY}")


def lines(curve: ResponseCurve) -> list[str]:
    """Return what is said of each gap."""
    unit = 1.0 if curve.along else math.tau
    aside = f" of {curve.along}" if curve.along else " Hz"
    return [
        f"{MISSING} {low / unit:.8g} and {high / unit:.8g}{aside}"
        for low, high in gaps(curve)
    ]


def uncovered(curve: ResponseCurve) -> float:
    """Return the share of a curve's range that lies between its pieces."""
    found = gaps(curve)
    if not found:
        return 0.0
    own = _own(curve)
    return sum(high - low for low, high in found) / float(own.max() - own.min())


def gaps(curve: ResponseCurve) -> list[tuple[float, float]]:
    """Return the ends of what no piece covers, along what the curve is followed."""
    own = _own(curve)
    begins = [n for n, name in enumerate(curve.event[: own.size]) if name == "restart"]
    pieces = sorted(
        (float(piece.min()), float(piece.max()))
        for piece in np.split(own, begins)
        if piece.size
    )
    found: list[tuple[float, float]] = []
    reached = math.inf
    for low, high in pieces:
        if low > reached:
            found.append((reached, low))
        reached = high if math.isinf(reached) else max(reached, high)
    return found


def _own(curve: ResponseCurve) -> np.ndarray:
    """Return the parameter of the curve's points, without what hangs off it."""
    first = next((n for n, name in enumerate(curve.event) if name in OTHERS), None)
    return curve.parameter[:first]
