"""One slide of friction that remembers, from a sample of a period to the next (§6)."""

from __future__ import annotations

from typing import NamedTuple

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import pressed, traction
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel


class Motion(NamedTuple):
    """Of one contact point, at all samples of a period."""

    points: ContactPoints
    point: int
    displacement: Array
    """normal and tangents [m], shape (3, samples)"""
    velocity: Array
    """shape (3, samples)"""


class Step(NamedTuple):
    """What the slide from one sample to the next makes; overwritten by the next."""

    slide: Array
    """shape (2,)"""
    speed: Array
    """mean of both ends, shape (2,)"""
    new: Array
    """traction after it, shape (2,)"""
    by: Array
    """its derivatives, shape (2, 10)"""
    by_load: Array
    """those of the load after and before it by depth and approach, shape (2, 2)"""


@bare_kernel
def take(motion: Motion, place: int, begins: bool, state: Array, step: Step) -> None:
    """Slide to a sample from the one before, or begin there: traction and change."""
    points, point, displacement, velocity = motion
    last = before(place, displacement.shape[1])
    if begins:
        last = place
    by, by_load = step.by, step.by_load
    for axis in range(2):
        was, now = displacement[axis + 1, last], displacement[axis + 1, place]
        step.slide[axis] = now - was
        step.speed[axis] = 0.5 * (velocity[axis + 1, place] + velocity[axis + 1, last])
    press, by_load[0, 0], by_load[0, 1] = pressed(
        points, point, displacement[0, place], velocity[0, place]
    )
    past, by_load[1, 0], by_load[1, 1] = pressed(
        points, point, displacement[0, last], velocity[0, last]
    )
    traction(points, point, step.slide, step.speed, press, past, state[0], step.new, by)
    one, two = state[1, 0], state[1, 1]
    for axis in range(2):
        state[0, axis] = step.new[axis]
        state[1, axis] = (
            by[axis, 2] * step.speed[0] + by[axis, 3] * step.speed[1]
            + by[axis, 4] * by_load[0, 1] * velocity[0, place]
            + by[axis, 5] * by_load[1, 1] * velocity[0, last]
            + by[axis, 6] * one + by[axis, 7] * two
        )  # fmt: skip


@bare_kernel
def before(place: int, samples: int) -> int:
    """Return the sample before one, around the period."""
    return place - 1 if place > 0 else samples - 1
