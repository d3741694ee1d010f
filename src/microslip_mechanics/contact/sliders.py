"""What contacts remember along a motion, step by step, with its derivatives (§6, §7).

The traction T of friction that remembers goes from one step to the next,

    T₁ = T(w₁ − w₀, ẇ, N₁, N₀, T₀) ,   δT₁ = F δ(y, ẏ/ω)₁ − G δ(y, ẏ/ω)₀ + H δT₀ ,

so that it is part of the state. Velocity ẇ is the mean of both ends, and N the loads at
both. A slider that never slips keeps T − k_t w: H = 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import (
    friction_load,
    remembers,
    traction,
)
from microslip_mechanics.contact.points import ELASTIC, ContactPoints
from microslip_mechanics.jit import kernel


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
    mean: Array
    """by how much the mean traction of these can come nearer to zero [N], (sliders,)"""


@dataclass(frozen=True, slots=True)
class Sliders:
    """The tractions that are part of a state: one for each direction that can slide."""

    points: ContactPoints
    basis: Array
    """relative displacements of the points from the coordinates, (3 points, rank)"""
    point: NDArray[np.int64]
    """of each slider, shape (sliders,)"""
    axis: NDArray[np.int64]
    """0 or 1: along which tangent, shape (sliders,)"""

    @classmethod
    def of(cls, points: ContactPoints, basis: Array) -> Sliders:
        """Return the sliders of a contact table: none where no contact remembers."""
        moves = (basis != 0.0).any(axis=1).reshape(-1, 3)[:, 1:]
        point, axis = np.nonzero(moves & remembers(points)[:, None])
        return cls(points, basis, point, axis)

    @property
    def count(self) -> int:
        """Number of sliders."""
        return int(self.point.size)

    @property
    def along(self) -> Array:
        """Displacement of each slider from the coordinates, shape (sliders, rank)."""
        rows: Array = self.basis[3 * self.point + 1 + self.axis]
        return rows

    @property
    def stiffness(self) -> Array:
        """k_t [N/m], shape (sliders,)."""
        found: Array = self.points.tangential[self.point]
        return found

    def seen(self, traction: Array | None) -> Array:
        """Return the sliders' part of all tractions, (points, 2); zero if None."""
        if traction is None:
            return np.zeros(self.count)
        found: Array = traction[self.point, self.axis]
        return found

    def spread(self, held: Array) -> Array:
        """Return the tractions of all points, shape (points, 2)."""
        tractions = np.zeros((self.points.load.size, 2))
        tractions[self.point, self.axis] = held
        return tractions

    def slides(
        self,
        moved: Array,
        moving: Array,
        first: Array,
        frequency: float,
        *,
        continuous: bool = False,
    ) -> Slides:
        """Return the tractions along a motion.

        Parameters
        ----------
        moved, moving
            Displacement [m] and velocity [m/s] of the points, (times, points, 3).
        first
            Tractions at the first time [N], shape (sliders,).
        frequency
            ω [rad/s].
        continuous
            Whether derivatives are those of the motion, not of its steps: a contact
            that touches within a step begins to stick there, sooner where it is deeper.
        """
        times, count = len(moved), len(self.points.load)
        tractions, limits = np.zeros((times, count, 2)), np.zeros((times, count))
        by, load = np.zeros((times, count, 2, 8)), np.zeros((times, count, 2))
        tractions[0] = self.spread(first)
        if self.count:
            recalling = np.flatnonzero(remembers(self.points))
            _follow(self.points, recalling, moved, moving, tractions, limits, by, load)
        motion, past, kept = self._derivatives(by, load, frequency)
        if continuous:
            before, after = self._touches(moved, moving, by)
            past[:, :, : before.shape[2]] -= before
            motion[:, :, : after.shape[2]] += after
        never = (kept[1:] == np.eye(self.count)).all(axis=(0, 2))
        stuck = never & (self.points.friction[self.point] == ELASTIC)
        held = tractions[1:].mean(axis=0)
        shares = _shares(tractions[1:], limits[1:], held)
        return Slides(
            tractions[:, self.point, self.axis],
            limits[:, self.point],
            motion,
            past,
            kept,
            stuck,
            (shares[:, None] * held)[self.point, self.axis],
        )

    def _touches(self, moved: Array, moving: Array, by: Array) -> tuple[Array, Array]:
        """Return the tractions by y before and after steps in which a point touches.

        From where it touches on T = k_t (w − w_touch), and a depth that is greater by
        δd moves w_touch by −ẇ δd/ḋ; shapes (times, sliders, rank).
        """
        point, points = self.point, self.points
        depth = moved[:, :, 0] - points.gap
        begins = (depth[1:] > 0.0) & (depth[:-1] <= 0.0) & ~points.constant_load
        time, where = np.nonzero(begins)
        above, below = depth[time, where], depth[time + 1, where]
        share = above / (above - below)
        speed = (1.0 - share)[:, None] * moving[time, where]
        speed += share[:, None] * moving[time + 1, where]
        ahead = np.zeros((*moved.shape[:2], 2))
        ahead[time + 1, where] = speed[:, 1:] / np.maximum(speed[:, :1], 1e-300)
        within = np.zeros(moved.shape[:2])
        within[time + 1, where] = share
        own = by[:, point, self.axis, :2]
        leap = (own * ahead[:, point]).sum(axis=2)[:, :, None] * self.basis[3 * point]
        part = within[:, point, None]
        return (1.0 - part) * leap, part * leap

    def _derivatives(
        self, by: Array, load: Array, frequency: float
    ) -> tuple[Array, Array, Array]:
        """Return F, G and H from the derivatives of each traction."""
        point, basis = self.point, self.basis
        own = by[:, point, self.axis]
        normal = basis[3 * point]
        tangents = basis[3 * point[:, None] + np.arange(1, 3)]
        slid = np.einsum("tsa,sar->tsr", own[:, :, :2], tangents)
        drag = np.einsum("tsa,sar->tsr", own[:, :, 2:4], tangents)

        def seen(column: int, load: Array) -> tuple[Array, Array]:
            pressed = own[:, :, column, None] * load[:, point]
            moved = pressed[:, :, :1] * normal
            return moved, frequency * (0.5 * drag + pressed[:, :, 1:] * normal)

        depth, speed = seen(4, load)
        motion = np.concatenate([slid + depth, speed], axis=2)
        depth, speed = seen(5, np.roll(load, 1, axis=0))
        past = np.concatenate([slid - depth, -speed], axis=2)
        kept = np.zeros((len(by), self.count, self.count))
        for row, column in np.argwhere(point[:, None] == point):
            kept[:, row, column] = own[:, row, 6 + self.axis[column]]
        return motion, past, kept


def _shares(tractions: Array, limits: Array, held: Array) -> Array:
    """Return which share of the mean can be taken off all tractions of each point.

    None may exceed its limit at any time, shape (times, points).
    """
    square = (held**2).sum(axis=1)
    along = (tractions * held).sum(axis=2)
    room = np.maximum(limits**2 - (tractions**2).sum(axis=2), 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        shares = (along + np.sqrt(along**2 + square * room)) / square
    shares = np.where(square > 0.0, shares, 1.0)
    least: Array = np.clip(shares.min(axis=0), 0.0, 1.0)
    return least


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
        before = 0.0
        for place in range(moved.shape[0]):
            now, rate = moved[place, point], moving[place, point]
            force, by_depth, by_approach = friction_load(points, point, now[0], rate[0])
            if force > 0.0:
                load[place, point, 0], load[place, point, 1] = by_depth, by_approach
            if place > 0:
                last = place - 1
                limits[place, point] = points.dynamic[point] * max(force, 0.0)
                speed = 0.5 * (rate[1:] + moving[last, point, 1:])
                traction(
                    points, point, now[1:] - moved[last, point, 1:], speed, force,
                    before, tractions[last, point], tractions[place, point],
                    by[place, point],
                )  # fmt: skip
            before = max(force, 0.0)
