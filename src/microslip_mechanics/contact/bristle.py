"""Bristle friction: Dahl's law, with Stribeck's fall that of LuGre (theory, eq. 10b).

The traction T of the bristles follows dT = k_t (dw − |dw| T / g(v)) with the sliding
force g(v) = N (µd + (µs − µd) exp(−(|v|/V_str)^γ)) (Dahl, 1968; Canudas de Wit et al.,
1995, without their micro-damping). Over a slide along a straight line with constant g
that is solved exactly, so that any slide is stable.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel


class Bristles(NamedTuple):
    """Bristles that bend and slip."""

    stiffness: float
    """k_t [N/m]"""
    dynamic: float
    """µd"""
    static: float
    """µs"""
    stribeck: float
    """V_str [m/s]"""
    exponent: float
    """γ"""


@bare_kernel
def bristle_traction(
    law: Bristles,
    slide: tuple[float, float],
    velocity: Array,
    load: float,
    past_load: float,
    old: Array,
    new: Array,
    by: Array,
) -> None:
    """Write the traction of the bristles after a small slide, and its derivatives.

    Arguments are those of :func:`~microslip_mechanics.contact.elastic.elastic_traction`
    and the sliding velocity [m/s], shape ``(2,)``, the mean of both ends. The sliding
    force is that of the mean load.
    """
    by[:] = 0.0
    if load <= 0.0:
        new[:] = 0.0
        return
    coefficient, fall = _coefficient(law, math.hypot(velocity[0], velocity[1]))
    load = 0.5 * (load + max(past_load, 0.0))
    limit = load * coefficient
    length = math.hypot(slide[0], slide[1])
    if limit <= 0.0:
        new[:] = 0.0
        return
    bend = law.stiffness * length / limit
    keeps = math.exp(-bend)
    # (1 − exp(−b)) / b, and its derivative by b
    mean = -math.expm1(-bend) / bend if bend > 1e-8 else 1.0 - 0.5 * bend
    turn = (keeps - mean) / bend if bend > 1e-4 else -0.5 + bend / 3.0
    for row in range(2):
        pull = law.stiffness * slide[row]
        new[row] = keeps * old[row] + mean * pull
        by[row, row] = mean * law.stiffness
        by[row, 6 + row] = keeps
        by_bend = turn * pull - keeps * old[row]
        if length > 0.0:
            for column in range(2):
                change = law.stiffness / limit * slide[column] / length
                by[row, column] += by_bend * change
        by_limit = -by_bend * bend / limit
        by[row, 4] = by[row, 5] = 0.5 * by_limit * coefficient
        by[row, 2] = by_limit * load * fall * velocity[0]
        by[row, 3] = by_limit * load * fall * velocity[1]


@bare_kernel
def _coefficient(law: Bristles, speed: float) -> tuple[float, float]:
    """Return µ(|v|), and its derivative by |v| over |v|."""
    if law.static == law.dynamic:
        return law.dynamic, 0.0
    share = (speed / law.stribeck) ** law.exponent
    fading = (law.static - law.dynamic) * math.exp(-share)
    if speed == 0.0:
        return law.static, 0.0
    return law.dynamic + fading, -fading * share * law.exponent / speed**2
