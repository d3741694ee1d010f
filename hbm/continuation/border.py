"""The point at which a curve leaves its range (theory §6.2)."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from hbm.continuation.arc import tangent
from hbm.continuation.correction import Correction
from hbm.continuation.linearised import SingularError
from microslip_mechanics.arrays import Array


def border(
    accepted: Correction,
    candidate: Correction,
    limits: tuple[float, float],
    corrected: Callable[[Array], Correction],
    scale: Array,
) -> Correction:
    """Return the point exactly on the limit at which a step passes it first.

    It is sought on a parabola: near a fold beyond the limit a straight line leads to
    where the curve comes back.
    """
    limit = limits[0] if candidate.point[-1] <= limits[0] else limits[1]
    away = candidate.point - accepted.point
    length = float((accepted.along / scale) @ (away / scale))
    rise = length * accepted.along
    share = _first_share(rise[-1], away[-1], limit - accepted.point[-1])
    guess = accepted.point + share * rise + share**2 * (away - rise)
    guess[-1] = limit
    found = corrected(guess)
    point, along = found.point.copy(), candidate.along
    point[-1] = limit  # not what rounding makes of it
    if along[-1] * away[-1] < 0.0 < rise[-1] * away[-1]:
        with contextlib.suppress(SingularError):
            along = tangent(found.linearised, accepted.along, scale)
    return replace(found, point=point, tangent=along)


def _first_share(rise: float, away: float, wanted: float) -> float:
    """Return the share x of a step at which rise x + (away - rise) x² is as wanted."""
    roots = np.roots([away - rise, rise, -wanted])
    within = roots.real[(roots.imag == 0.0) & (roots.real > 0.0)]
    return float(within.min(initial=1.0))
