"""What contacts remember along a march of one period, with its derivatives (theory §7).

The traction T of friction that remembers goes from one step to the next,

    T₁ = T(w₁ − w₀, ẇ₁, N₁, T₀) ,   δT₁ = F δ(y, ẏ/ω)₁ − G δy₀ + H δT₀ ,

so that it is part of the state. A slider that never slips keeps T − k_t w: H = 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import ELASTIC, ContactPoints
from microslip_mechanics.contact.memory import friction_load, remembers, traction
from microslip_mechanics.jit import kernel


class Slides(NamedTuple):
    """Tractions at all times of a period, the beginning included, and derivatives."""

    traction: Array
    """T [N], shape (times, sliders)"""
    motion: Array
    """F, shape (times, sliders, 2 rank)"""
    past: Array
    """G, shape (times, sliders, rank)"""
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
    def of(cls, interface: Interface) -> Sliders:
        """Return the sliders of an interface: none where no contact remembers."""
        basis, _ = interface.relative_motion()
        moves = (basis != 0.0).any(axis=1).reshape(interface.count, 3)[:, 1:]
        point, axis = np.nonzero(moves & remembers(interface.points)[:, None])
        return cls(interface.points, basis, point, axis)

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
        self, moved: Array, moving: Array, first: Array, frequency: float
    ) -> Slides:
        """Return the tractions along a march.

        Parameters
        ----------
        moved, moving
            Displacement [m] and velocity [m/s] of the points, (times, points, 3).
        first
            Tractions at the first time [N], shape (sliders,).
        frequency
            ω [rad/s].
        """
        times, count = len(moved), len(self.points.load)
        tractions, limits = np.zeros((times, count, 2)), np.zeros((times, count))
        by, load = np.zeros((times, count, 2, 7)), np.zeros((times, count, 2))
        tractions[0] = self.spread(first)
        if self.count:
            recalling = np.flatnonzero(remembers(self.points))
            _follow(self.points, recalling, moved, moving, tractions, limits, by, load)
        motion, past, kept = self._derivatives(by, load, frequency)
        never = (kept[1:] == np.eye(self.count)).all(axis=(0, 2))
        stuck = never & (self.points.friction[self.point] == ELASTIC)
        held = tractions[1:].mean(axis=0)
        shares = _shares(tractions[1:], limits[1:], held)
        return Slides(
            tractions[:, self.point, self.axis],
            motion,
            past,
            kept,
            stuck,
            (shares[:, None] * held)[self.point, self.axis],
        )

    def _derivatives(
        self, by: Array, load: Array, frequency: float
    ) -> tuple[Array, Array, Array]:
        """Return F, G and H from the derivatives of each traction."""
        point, basis = self.point, self.basis
        own = by[:, point, self.axis]
        normal = basis[3 * point]
        tangents = basis[3 * point[:, None] + np.arange(1, 3)]
        past = np.einsum("tsa,sar->tsr", own[:, :, :2], tangents)
        drag = np.einsum("tsa,sar->tsr", own[:, :, 2:4], tangents)
        pressed = own[:, :, 4:5] * load[:, point]
        motion = np.concatenate(
            [
                past + pressed[:, :, :1] * normal,
                frequency * (drag + pressed[:, :, 1:] * normal),
            ],
            axis=2,
        )
        kept = np.zeros((len(by), self.count, self.count))
        for row, column in np.argwhere(point[:, None] == point):
            kept[:, row, column] = own[:, row, 5 + self.axis[column]]
        return motion, past, kept


def carried(
    free: Array,
    push: Array,
    seen: Array,
    tangents: Array,
    sliders: Sliders,
    slides: Slides,
) -> tuple[Array, Array]:
    """Return what a period does to a small change of the state (s, T).

    Parameters
    ----------
    free, push
        A and b of a step (:mod:`timedomain.period_map`).
    seen
        W, (y, ẏ/ω) from s.
    tangents
        D of the other laws at each time, shape (times, rank, 2 rank).
    sliders, slides
        What remembers, and what it did.

    Returns
    -------
    Derivatives of the state after the period, shape ``(states, states)``, and of the
    mean tractions, shape ``(sliders, states)``.
    """
    size, rank = push.shape
    pull, whole = sliders.along.T, np.eye(size + sliders.count)
    moved, held = whole[:size], whole[size:]
    force = tangents[0] @ (seen @ moved) + pull @ held
    moved = moved - push @ force
    slid = (seen @ whole[:size])[:rank]
    answers = tangents + pull @ slides.motion
    solvers = np.linalg.inv(np.eye(rank) - answers @ (seen @ push))
    kick, total = free @ push + push, np.zeros_like(held)
    for place in range(1, len(tangents)):
        moved = free @ moved + kick @ force
        watched = seen @ moved
        memory = slides.traction_past[place] @ held - slides.past[place] @ slid
        force = solvers[place] @ (answers[place] @ watched + pull @ memory)
        watched += (seen @ push) @ force
        held = slides.motion[place] @ watched + memory
        slid, total = watched[:rank], total + held
    return np.vstack([moved + push @ force, held]), total / (len(tangents) - 1)


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
    """Write tractions, slip limits and derivatives at all times but the first."""
    for place in range(1, moved.shape[0]):
        for point in recalling:
            now = moved[place, point]
            slide = now[1:] - moved[place - 1, point, 1:]
            force, by_depth, by_approach = friction_load(
                points, point, now[0], moving[place, point, 0]
            )
            limits[place, point] = points.dynamic[point] * max(force, 0.0)
            load[place, point, 0], load[place, point, 1] = by_depth, by_approach
            traction(
                points, point, slide, moving[place, point, 1:], force,
                tractions[place - 1, point], tractions[place, point],
                by[place, point],
            )  # fmt: skip
