"""What contacts remember along a motion, with its derivatives (theory §6.5, §7.3).

The traction T of friction that remembers goes from one step to the next,

    T₁ = T(w₁ − w₀, ẇ, N₁, N₀, T₀) ,   δT₁ = F δ(y, ẏ/ω)₁ − G δ(y, ẏ/ω)₀ + H δT₀ ,

so that it is part of the state. Velocity ẇ is the mean of both ends, and N the loads at
both. A slider that never slips keeps T − k_t w: H = 1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.brink import Brink, brink_of
from microslip_mechanics.contact.memory import Press, pressed, remembers, traction
from microslip_mechanics.contact.points import ELASTIC, ContactPoints
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.jit import kernel

ROUNDING = 1e-9
"""change of a traction by slipping in a step, over the limit, that is none: what is
left of it where periods are marched until tractions repeat themselves"""


class Slides(NamedTuple):
    """Tractions at all times of a motion, the beginning included, and derivatives."""

    traction: Array
    """T [N], shape (times, sliders)"""
    limit: Array
    """slip limit of each one's point [N], shape (times, sliders); zero at the first"""
    motion: Array
    """F, shape (times, sliders, 2 rank)"""
    past: Array
    """G, shape (times, sliders, 2 rank)"""
    traction_past: Array
    """H, shape (times, sliders, sliders)"""
    stuck: NDArray[np.bool_]
    """which sliders never slip, shape (sliders,)"""
    load: Array
    """normal load by depth [N/m] and by approach [N s/m], (times, points, 2)"""
    brink: Brink
    """by how much the mean traction of these can come nearer to none, or to what
    :meth:`~microslip_mechanics.contact.sliders.Sliders.bent` has"""


def slides_of(
    sliders: Sliders,
    moved: Array,
    moving: Array,
    first: Array,
    frequency: float,
) -> Slides:
    """Return the tractions along a motion.

    Parameters
    ----------
    sliders
        Whose tractions are followed.
    moved, moving
        Displacement [m] and velocity [m/s] of the points, (times, points, 3).
    first
        Tractions at the first time [N], shape (sliders,).
    frequency
        ω [rad/s].
    """
    times, count = len(moved), len(sliders.points.load)
    tractions, limits = np.zeros((times, count, 2)), np.zeros((times, count))
    by, load = np.zeros((times, count, 2, 10)), np.zeros((times, count, 2))
    tractions[0] = sliders.spread(first)
    if sliders.count:
        recalling = np.flatnonzero(remembers(sliders.points))
        _follow(sliders.points, recalling, moved, moving, tractions, limits, by, load)
    sticking = _sticking(sliders.points, moved, tractions, limits)
    _stick(sliders.points, sticking, by)
    motion, past, kept = _derivatives(sliders, by, load, frequency)
    held = tractions[1:].mean(axis=0) - sliders.bent(moved[1:].mean(axis=0))
    return Slides(
        tractions[:, sliders.point, sliders.axis],
        limits[:, sliders.point],
        motion,
        past,
        kept,
        sticking[sliders.point],
        load,
        brink_of(sliders, tractions, limits, held, sticking, load, frequency),
    )


@kernel
def _follow(
    points: ContactPoints,
    recalling: NDArray[np.int64],
    moved: Array,
    moving: Array,
    tractions: Array,
    limits: Array,
    by: Array,
    load: Array,
) -> None:
    """Write tractions, slip limits and derivatives at all times but the first.

    The derivatives of the ``load`` are written at the first as well.
    """
    for point in recalling:
        before = Press(0.0, 0.0)
        for place in range(moved.shape[0]):
            now, rate = moved[place, point], moving[place, point]
            press, by_depth, by_approach = pressed(points, point, now[0], rate[0])
            load[place, point, 0], load[place, point, 1] = by_depth, by_approach
            if place > 0:
                last = place - 1
                limits[place, point] = points.dynamic[point] * press.load
                speed = 0.5 * (rate[1:] + moving[last, point, 1:])
                traction(
                    points, point, now[1:] - moved[last, point, 1:], speed, press,
                    before, tractions[last, point], tractions[place, point],
                    by[place, point],
                )  # fmt: skip
            before = press


def _sticking(
    points: ContactPoints, moved: Array, tractions: Array, limits: Array
) -> NDArray[np.bool_]:
    """Return at which points elastic friction never slips, but for rounding.

    That a varying load has left just within its limit at one time still sticks.
    """
    pull = points.tangential[:, None] * np.diff(moved[:, :, 1:], axis=0)
    slips = np.linalg.norm(np.diff(tractions, axis=0) - pull, axis=2)
    elastic = points.friction == ELASTIC
    small = slips.max(axis=0) <= ROUNDING * limits.max(axis=0)
    sticks: NDArray[np.bool_] = elastic & small & np.all(limits[1:] > 0.0, axis=0)
    return sticks


def _stick(points: ContactPoints, sticking: NDArray[np.bool_], by: Array) -> None:
    """Write the derivatives of what sticks."""
    by[1:, sticking] = 0.0
    for axis in range(2):
        by[1:, sticking, axis, axis] = points.tangential[sticking]
        by[1:, sticking, axis, 6 + axis] = 1.0


def _derivatives(
    sliders: Sliders, by: Array, load: Array, frequency: float
) -> tuple[Array, Array, Array]:
    """Return F, G and H from the derivatives of each traction."""
    point, basis = sliders.point, sliders.basis
    own = by[:, point, sliders.axis]
    normal = basis[3 * point]
    tangents = basis[3 * point[:, None] + np.arange(1, 3)]
    slid = np.einsum("tsa,sar->tsr", own[:, :, :2], tangents)
    drag = np.einsum("tsa,sar->tsr", own[:, :, 2:4], tangents)

    def seen(column: int, load: Array) -> tuple[Array, Array]:
        heavier = own[:, :, column, None] * load[:, point]
        deeper = heavier[:, :, :1] + own[:, :, column + 4, None]
        return deeper * normal, frequency * (0.5 * drag + heavier[:, :, 1:] * normal)

    depth, speed = seen(4, load)
    motion = np.concatenate([slid + depth, speed], axis=2)
    depth, speed = seen(5, np.roll(load, 1, axis=0))
    past = np.concatenate([slid - depth, -speed], axis=2)
    kept = np.zeros((len(by), sliders.count, sliders.count))
    for row, column in np.argwhere(point[:, None] == point):
        kept[:, row, column] = own[:, row, 6 + sliders.axis[column]]
    return motion, past, kept
