"""Elastic dry friction: a tangential spring in series with a slider (theory, eq. 10a).

With one tangent and constant normal load it is Jenkins' element; with two, a variable
load and separation it is the contact of under-platform dampers and shrouds (Jenkins,
1962; Yang and Menq, 1998). A slide is straight, and the load goes in proportion to it.
The spring sticks until its traction meets the slip limit, and turns along it then: on a
constant limit that is solved exactly, as metal plasticity does (Krieg and Krieg, 1977).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel

ON = 1e-12
"""share of the limit's square by which a traction on it may seem to be within"""


class ElasticFriction(NamedTuple):
    """Coulomb slider behind a spring."""

    stiffness: float
    """k_t [N/m]"""
    coefficient: float
    """µd"""


@bare_kernel
def elastic_traction(
    law: ElasticFriction,
    slide: tuple[float, float],
    load: float,
    past_load: float,
    old: Array,
    new: Array,
    by: Array,
) -> None:
    """Write the traction after a small slide, and its derivatives.

    Parameters
    ----------
    law
        Spring and friction coefficient.
    slide
        Increment of the sliding displacement [m] along both tangents.
    load, past_load
        Normal loads [N] at the end and the beginning of the slide; zero or less out of
        contact.
    old
        Traction before [N], shape ``(2,)``.
    new
        Written: the traction that resists, shape ``(2,)``.
    by
        Written: derivatives of both components by slide (2), velocity (2), load (1),
        load before (1) and old traction (2), shape ``(2, 8)``
        or with more columns, which are zero.
    """
    by[:] = 0.0
    first, last = law.coefficient * max(past_load, 0.0), law.coefficient * load
    if last <= 0.0:
        new[:] = 0.0
        return
    pull_one, pull_two = law.stiffness * slide[0], law.stiffness * slide[1]
    one, two = old[0] + pull_one, old[1] + pull_two
    if math.hypot(one, two) <= last:
        new[0], new[1] = one, two
        by[0, 0] = by[1, 1] = law.stiffness
        by[0, 6] = by[1, 7] = 1.0
        return
    share, slope = _stuck(pull_one, pull_two, old, first, last)
    rest, limit = 1.0 - share, first + share * (last - first)
    one, two = old[0] + share * pull_one, old[1] + share * pull_two
    along_one, along_two, met_one, met_two, slid_one, slid_two, limits = _turned(
        one, two, rest * pull_one, rest * pull_two, limit, last
    )
    new[0], new[1] = last * along_one, last * along_two
    # where slip begins moves with all that it follows from
    later = 0.0
    if slope > 0.0:
        gained = (met_one - slid_one) * pull_one + (met_two - slid_two) * pull_two
        later = -2.0 * (gained + limits * (last - first)) / slope
    met_one, met_two = met_one + later * one, met_two + later * two
    begun = limits - later * limit
    for row in range(2):
        across = last * (along_one if row == 1 else -along_two)
        by[row, 0] = across * law.stiffness * (share * met_one + rest * slid_one)
        by[row, 1] = across * law.stiffness * (share * met_two + rest * slid_two)
        by[row, 4] = across * law.coefficient * (share * begun + limits)
        by[row, 4] += law.coefficient * (along_two if row == 1 else along_one)
        by[row, 5] = across * law.coefficient * rest * begun
        by[row, 6], by[row, 7] = across * met_one, across * met_two


@inner_kernel
def _stuck(
    one: float, two: float, old: Array, first: float, last: float
) -> tuple[float, float]:
    """Return the share of a slide that sticks, and how fast it then leaves the limit.

    That is the derivative by the share of the traction's square less the limit's; zero
    where nothing sticks, or all does, whatever little changes.
    """
    square = one**2 + two**2 - (last - first) ** 2
    linear = 2.0 * (old[0] * one + old[1] * two - first * (last - first))
    within = min(old[0] ** 2 + old[1] ** 2 - first**2, 0.0)
    if within >= -ON * first**2 and linear >= 0.0:
        return 0.0, 0.0
    slope = math.sqrt(max(linear**2 - 4.0 * square * within, 0.0))
    if linear > 0.0:
        return min(-2.0 * within / (linear + slope), 1.0), slope
    if slope - linear >= 2.0 * square:
        return 1.0, 0.0
    return 0.5 * (slope - linear) / square, slope


@inner_kernel
def _turned(
    one: float, two: float, pull_one: float, pull_two: float, first: float, last: float
) -> tuple[float, float, float, float, float, float, float]:
    """Return where a traction points that slips from (one, two) on, and derivatives.

    Its angle ψ to the pull falls as R dψ = − |pull| sin ψ, so that tan(ψ/2) falls with
    the exponential of |pull| / R; R is the mean of both limits. The derivatives are
    those of its angle by the traction before (2), the pull (2), and each limit.
    """
    pull, size = math.hypot(pull_one, pull_two), math.hypot(one, two)
    if size == 0.0:
        ahead_one, ahead_two = pull_one / pull, pull_two / pull
        return ahead_one, ahead_two, 0.0, 0.0, -ahead_two / pull, ahead_one / pull, 0.0
    one, two = one / size, two / size
    ahead_one, ahead_two = one, two
    if pull > 0.0:
        ahead_one, ahead_two = pull_one / pull, pull_two / pull
    along = one * ahead_one + two * ahead_two
    across = two * ahead_one - one * ahead_two
    mean = 0.5 * (first + last)
    bend = pull / mean
    left, lost = math.exp(-bend), 1.0
    if bend > 0.0:
        lost = -math.expm1(-bend) / bend
    whole = (1.0 + along) + left**2 * (1.0 - along)
    cosine = ((1.0 + along) - left**2 * (1.0 - along)) / whole
    sine = 2.0 * left * across / whole
    keeps = 2.0 * left / whole / size
    turns = lost * ((1.0 - left) + along * (1.0 + left)) / whole / mean
    return (
        cosine * ahead_one - sine * ahead_two,
        cosine * ahead_two + sine * ahead_one,
        -keeps * two,
        keeps * one,
        -turns * ahead_two - sine * ahead_one / mean,
        turns * ahead_one - sine * ahead_two / mean,
        0.5 * sine * bend / mean,
    )
