"""Times at which a contact touches, lifts off, slips, sticks or turns (§6.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.forces.sampled_orbit import SampledOrbit
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.points import ELASTIC
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides, slides_of

TURN = 2.0 * np.pi
PERIODS = 400
"""most that are marched until tractions repeat themselves"""
STEADY = 1e-10
"""change of a traction over a period, over the largest one"""
AROUND = (1e-2, 1e-4)
"""distance of the two times around the beginning of a slip from it, over an equal step,
in the first and second search"""
CLOSEST = 1e-9
"""phases that are one [rad]"""


@dataclass(frozen=True, slots=True)
class SlidOrbit:
    """Times of a period, the last one a period after the first, and what slides."""

    phase: Array
    """[rad], shape (times,)"""
    slides: Slides


def slid_orbit(
    sliders: Sliders, orbit: SampledOrbit, pressed: Array, steps: int
) -> SlidOrbit:
    """Return times that are no further apart than equal steps, and lie around events.

    Parameters
    ----------
    sliders
        What remembers.
    orbit
        How the contact points move.
    pressed
        Phases at which a point touches, parts or is let go of [rad].
    steps
        Over the period, without those that events add.
    """
    made = even_slides(sliders, orbit, steps)
    even = made.phase
    for around in AROUND:
        found = _events(sliders, orbit, made, around * TURN / steps)
        phase = _joined(even, np.concatenate([pressed, found]))
        made = _settled(sliders, orbit, phase, made.slides.traction[-1])
    return made


def even_slides(sliders: Sliders, orbit: SampledOrbit, steps: int) -> SlidOrbit:
    """Return what slides from one of so many equal steps to the next."""
    even = np.linspace(0.0, TURN, steps + 1)
    moved, _ = orbit.at(even)
    along = moved[:, sliders.point, 1 + sliders.axis]
    first = sliders.stiffness * (along[0] - along[:-1].mean(axis=0))
    first += sliders.seen(sliders.bent(moved[:-1].mean(axis=0)))
    return _settled(sliders, orbit, even, first)


def _settled(
    sliders: Sliders, orbit: SampledOrbit, phase: Array, first: Array
) -> SlidOrbit:
    """Return the tractions that repeat themselves."""
    moved, moving = orbit.at(phase)
    for _ in range(PERIODS):
        slides = slides_of(sliders, moved, moving, first, orbit.frequency)
        first = slides.traction[-1]
        change = np.abs(first - slides.traction[0]).max(initial=0.0)
        if change <= STEADY * np.abs(slides.traction).max(initial=TINY):
            break
    # the first time is the last one of the period before
    slides.limit[0] = slides.limit[-1]
    slides.traction_past[0] = slides.traction_past[-1]
    return SlidOrbit(phase, slides)


def _joined(even: Array, events: Array) -> Array:
    """Return all times in order, without those that are nearly equal to another."""
    inside = events[(events > 0.0) & (events < TURN)]
    phase: Array = np.sort(np.concatenate([even, inside]))
    phase = phase[np.append(True, np.diff(phase) > CLOSEST)]
    phase[-1] = TURN
    return phase


def _events(
    sliders: Sliders, orbit: SampledOrbit, made: SlidOrbit, around: float
) -> Array:
    """Return the phases at which a slider slips, sticks or turns [rad]."""
    moved, moving = orbit.at(made.phase)
    points = sliders.points
    speed = moving[:, sliders.point, 1 + sliders.axis]
    found = [_zeros(made.phase, speed[:, points.friction[sliders.point] != ELASTIC])]
    for point in np.unique(sliders.point):
        if points.friction[point] != ELASTIC:
            continue
        own = np.flatnonzero(sliders.point == point)
        axes = 1 + sliders.axis[own]
        slider = _Slider(
            made.phase,
            points.tangential[point] * moved[:, point, axes],
            points.tangential[point] * moving[:, point, axes] / orbit.frequency,
            made.slides.traction[:, own],
            made.slides.limit[:, own[0]],
            _slips(made.slides, own),
        )
        found += [slider.begins(around), slider.ends()]
    return np.concatenate(found)


def _slips(slides: Slides, own: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return at the ends of which steps a point slips, shape (times,)."""
    kept = slides.traction_past[:, own[:, None], own]
    slips: NDArray[np.bool_] = (kept != np.eye(own.size)).any(axis=(1, 2))
    return slips & (slides.limit[:, own[0]] > 0.0)


def _zeros(phase: Array, values: Array) -> Array:
    """Return the phases at which values, shape (times, columns), change their sign."""
    place, column = np.nonzero(values[1:] * values[:-1] < 0.0)
    before, after = values[place, column], values[place + 1, column]
    share = before / (before - after)
    found: Array = phase[place] + share * (phase[place + 1] - phase[place])
    return found


@dataclass(frozen=True, slots=True)
class _Slider:
    """One point with elastic friction over a period; forces in [N]."""

    phase: Array
    spring: Array
    """k_t w, shape (times, axes)"""
    rate: Array
    """its derivative by the phase"""
    traction: Array
    """shape (times, axes)"""
    limit: Array
    """shape (times,)"""
    slips: NDArray[np.bool_]
    """shape (times,)"""

    def begins(self, around: float) -> Array:
        """Return phases a little before and after each beginning of a slip.

        Between them the traction forgets what it was, at once.
        """
        (before,) = np.nonzero(self.slips[1:] & ~self.slips[:-1])
        old, slide = self.traction[before], np.diff(self.spring, axis=0)[before]
        limit, more = self.limit[before], np.diff(self.limit)[before]
        # |T + s k_t Δw| = L + s ΔL
        square = (slide**2).sum(axis=1) - more**2
        linear = (old * slide).sum(axis=1) - limit * more
        room = np.maximum(limit**2 - (old**2).sum(axis=1), 0.0)
        root = np.sqrt(np.maximum(linear**2 + square * room, 0.0))
        share = room / np.maximum(linear + root, TINY)
        length = np.diff(self.phase)[before]
        place = self.phase[before] + np.clip(share, 0.0, 1.0) * length
        return np.concatenate([place - around, place + around])

    def ends(self) -> Array:
        """Return the phases at which a slip ends: it would go backwards."""
        (last,) = np.nonzero(self.slips[:-1] & ~self.slips[1:])
        direction = self.traction / np.maximum(self.limit, TINY)[:, None]
        growth = np.gradient(self.limit, self.phase)
        found = []
        for place in last:
            forward = self.rate @ direction[place] - growth
            first = int(place) if forward[place] > 0.0 else max(int(place) - 1, 0)
            ends = forward[first], forward[first + 1]
            if ends[0] > 0.0 >= ends[1]:
                share = ends[0] / (ends[0] - ends[1])
                length = self.phase[first + 1] - self.phase[first]
                found.append(self.phase[first] + share * length)
        return np.array(found)
