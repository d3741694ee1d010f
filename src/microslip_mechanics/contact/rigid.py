"""Rigid Coulomb friction: the traction nearest to a trial within a disc (eq. 9b)."""

from __future__ import annotations

import math

from microslip_mechanics.jit import bare_kernel


@bare_kernel
def nearest_traction(
    first: float, second: float, limit: float
) -> tuple[float, float, float, float, float, float, float]:
    """Return what lies nearest to a trial traction within the disc of friction.

    Parameters
    ----------
    first, second
        Trial traction [N].
    limit
        Radius µN of the disc [N]; zero or less out of contact.

    Returns
    -------
    Traction (2) [N], its derivatives by the trial (11, 12 and 21, 22), and those by the
    radius (2).
    """
    if limit <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    size = math.hypot(first, second)
    if size <= limit:
        return first, second, 1.0, 0.0, 1.0, 0.0, 0.0
    one, two, share = first / size, second / size, limit / size
    return (
        limit * one,
        limit * two,
        share * two * two,
        -share * one * two,
        share * one * one,
        one,
        two,
    )
