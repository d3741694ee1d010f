"""How much of its mean traction a slider that never slips can shed (theory §7.3)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.sliders import Sliders

ALONG = 0.1
"""least cosine, in size, between what is taken off and the traction at its limit"""


class Brink(NamedTuple):
    """What can be taken off tractions at all times, until one comes to its limit.

    With the excess |T| − µN at that time, what can be taken off changes by
    pull δT + push δ(y, ẏ/ω).
    """

    shed: Array
    """what can be taken off [N], shape (sliders,)"""
    place: NDArray[np.int64]
    """time of the limit, after the beginning; zero where all can be taken off"""
    pull: Array
    """shape (sliders, sliders)"""
    push: Array
    """[N/m], shape (sliders, 2 rank)"""


def brink_of(
    sliders: Sliders,
    tractions: Array,
    limits: Array,
    held: Array,
    sticking: NDArray[np.bool_],
    load: Array,
    frequency: float,
) -> Brink:
    """Return what can be taken off the tractions of points that never slip.

    Parameters
    ----------
    sliders
        Whose tractions they are.
    tractions, limits
        At all times, the beginning included [N], (times, points, 2) and (times,
        points); those at the beginning do not count.
    held
        What would be taken off [N], shape (points, 2).
    sticking
        Which points never slip, shape (points,).
    load
        Normal load by depth [N/m] and by approach [N s/m], (times, points, 2).
    frequency
        ω [rad/s].
    """
    shares, places = _shares(tractions[1:], limits[1:], held)
    off = shares[:, None] * held
    point, axis, rank = sliders.point, sliders.axis, sliders.basis.shape[1]
    place = np.where(sticking & (shares < 1.0), places + 1, 0)
    pull, push = (
        np.zeros((sliders.count, sliders.count)),
        np.zeros((sliders.count, 2 * rank)),
    )
    for each in np.flatnonzero(place[point] > 0):
        own, at = point[each], place[point[each]]
        outward = _unit(tractions[at, own] - off[own])
        way = _unit(held[own])
        part = way[axis[each]] / min(float(outward @ way), -ALONG)
        same = point == own
        pull[each, same] = part * outward[axis[same]]
        heavier = sliders.points.dynamic[own] * load[at, own] * (1.0, frequency)
        push[each] = -part * np.kron(heavier, sliders.basis[3 * own])
    return Brink(off[point, axis], place[point], pull, push)


def _unit(vector: Array) -> Array:
    """Return a vector's direction."""
    made: Array = vector / max(float(np.linalg.norm(vector)), TINY)
    return made


def _shares(
    tractions: Array, limits: Array, held: Array
) -> tuple[Array, NDArray[np.int64]]:
    """Return which share of a constant can be taken off each point, and what ends it.

    No traction may exceed its limit at any time, shape (times, points); the second is
    the time at which it would first.
    """
    square = (held**2).sum(axis=1)
    along = (tractions * held).sum(axis=2)
    room = np.maximum(limits**2 - (tractions**2).sum(axis=2), 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = (along + np.sqrt(along**2 + square * room)) / square
    shares = np.where(square > 0.0, shares, 1.0)
    return np.clip(shares.min(axis=0), 0.0, 1.0), shares.argmin(axis=0)
