"""Elastic dry friction: a tangential spring in series with a slider (theory, eq. 10a).

With one tangent and constant normal load it is Jenkins' element; with two, a variable
load and separation it is the contact of under-platform dampers and shrouds (Jenkins,
1962; Yang and Menq, 1998; return mapping of the two tangents together).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel


class ElasticFriction(NamedTuple):
    """Coulomb slider behind a spring."""

    stiffness: float
    """k_t [N/m]"""
    coefficient: float
    """µd"""


@kernel
def elastic_traction(
    law: ElasticFriction, slide: Array, load: float, old: Array, new: Array, by: Array
) -> None:
    """Write the traction after a small slide, and its derivatives.

    Parameters
    ----------
    law
        Spring and friction coefficient.
    slide
        Increment of the sliding displacement [m], shape ``(2,)``.
    load
        Normal load [N] at the end of the slide; zero or less out of contact.
    old
        Traction before [N], shape ``(2,)``.
    new
        Written: the traction that resists, shape ``(2,)``.
    by
        Written: derivatives of both components by slide (2), velocity (2), load (1) and
        old traction (2), shape ``(2, 7)``.
    """
    by[:] = 0.0
    if load <= 0.0:
        new[:] = 0.0
        return
    one = old[0] + law.stiffness * slide[0]
    two = old[1] + law.stiffness * slide[1]
    size, limit = math.hypot(one, two), law.coefficient * load
    if size <= limit:
        new[0], new[1] = one, two
        by[0, 0] = by[1, 1] = law.stiffness
        by[0, 5] = by[1, 6] = 1.0
        return
    one, two = one / size, two / size
    share = limit / size
    new[0], new[1] = limit * one, limit * two
    by[0, 4], by[1, 4] = law.coefficient * one, law.coefficient * two
    by[0, 5] = share * two * two
    by[0, 6] = by[1, 5] = -share * one * two
    by[1, 6] = share * one * one
    for row in range(2):
        for column in range(2):
            by[row, column] = law.stiffness * by[row, 5 + column]
