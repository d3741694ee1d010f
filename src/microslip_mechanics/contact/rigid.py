"""Rigid Coulomb friction as a projection, and a mass that slides under it (eq. 9b)."""

from __future__ import annotations

import math

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel


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


@bare_kernel
def slide(
    push: Array, limit: float, loss: float, old: Array, step: Array, by: Array
) -> None:
    """Write what one step does to a mass that slides under friction.

    With the momentum p = m v / h at the beginning of a step of length h, the mean push
    g over it and the loss a = c h / (2 m) by a dashpot c. Along its direction the mass
    would stop after the share x of the step. Until then friction opposes the mean
    velocity, which the projection of x g + 2 p gives; what is left of the step is
    implicit, the projection of (1 − x) g + p, so that the mass stands still or slides
    off again. All of it is a continuous function of push, limit and momentum.

    Parameters
    ----------
    push, limit, loss
        g [N], shape ``(2,)``; µN [N]; a.
    old
        p [N], shape ``(2,)``.
    step
        Written: mean traction over the step, and p after it [N], shape ``(4,)``.
    by
        Written: derivatives of these by push (2), limit (1), p (2) and loss (1), shape
        ``(4, 6)``.
    """
    share, slowing, speed = _share(push, limit, loss, old)
    one, two = share * push[0] + 2.0 * old[0], share * push[1] + 2.0 * old[1]
    tail = 1.0 / (1.0 + loss * share)
    first = nearest_traction(one, two, share * limit)
    past = (tail * (one - first[0]) - old[0], tail * (two - first[1]) - old[1])
    rest = 1.0 - share
    kept, end = 1.0 - loss * rest, 1.0 / (1.0 + loss * rest)
    second = nearest_traction(
        rest * push[0] + kept * past[0], rest * push[1] + kept * past[1], rest * limit
    )
    for axis in range(2):
        step[axis] = first[axis] + second[axis]
        trial = rest * push[axis] + kept * past[axis]
        step[2 + axis] = end * (trial - second[axis])
    for column in range(6):
        turn = _turn(push, loss, old, share, slowing, speed, column)
        wider = limit * turn + (share if column == 2 else 0.0)
        narrower = -limit * turn + (rest if column == 2 else 0.0)
        lost = share if column == 5 else 0.0
        left = rest if column == 5 else 0.0
        tried = (
            push[0] * turn + _seed(column, 0, share, 2.0),
            push[1] * turn + _seed(column, 1, share, 2.0),
        )
        held = _varied(first, tried, wider)
        drop = tail * (loss * turn + lost)
        before = (
            tail * (tried[0] - held[0]) - drop * (past[0] + old[0])
            - (1.0 if column == 3 else 0.0),
            tail * (tried[1] - held[1]) - drop * (past[1] + old[1])
            - (1.0 if column == 4 else 0.0),
        )  # fmt: skip
        fall = loss * turn - left
        tried = (
            kept * before[0] + (fall * past[0] - push[0] * turn)
            + _seed(column, 0, rest, 0.0),
            kept * before[1] + (fall * past[1] - push[1] * turn)
            + _seed(column, 1, rest, 0.0),
        )  # fmt: skip
        also = _varied(second, tried, narrower)
        for axis in range(2):
            by[axis, column] = held[axis] + also[axis]
            by[2 + axis, column] = end * (
                tried[axis] - also[axis] + fall * step[2 + axis]
            )


@inner_kernel
def _share(
    push: Array, limit: float, loss: float, old: Array
) -> tuple[float, float, float]:
    """Return the share of a step until a mass stops, what slows it, and p's size."""
    speed = math.hypot(old[0], old[1])
    if limit <= 0.0:
        return 1.0, 0.0, speed
    if speed == 0.0:
        return 0.0, 0.0, speed
    along = (push[0] * old[0] + push[1] * old[1]) / speed
    slowing = limit - along + loss * speed
    if slowing <= speed:
        return 1.0, 0.0, speed
    return speed / slowing, slowing, speed


@inner_kernel
def _turn(
    push: Array,
    loss: float,
    old: Array,
    share: float,
    slowing: float,
    speed: float,
    column: int,
) -> float:
    """Return the derivative of the share by one of push, limit, p and loss."""
    if slowing == 0.0:
        return 0.0
    one, two = float(old[0] / speed), float(old[1] / speed)
    if column == 2:
        return -share / slowing
    if column == 5:
        return -share * speed / slowing
    own = one if column in (0, 3) else two
    if column < 2:
        return share * own / slowing
    across = float(push[0] * two - push[1] * one)
    side = (two if column == 3 else -one) * across / speed
    return (own - share * (loss * own - side)) / slowing


@inner_kernel
def _seed(column: int, axis: int, by_push: float, by_momentum: float) -> float:
    """Return the direct part of a trial's derivative."""
    if column == axis:
        return by_push
    return by_momentum if column == axis + 3 else 0.0


@inner_kernel
def _varied(
    nearest: tuple[float, float, float, float, float, float, float],
    trial: tuple[float, float],
    limit: float,
) -> tuple[float, float]:
    """Return the change of a projection with those of its trial and its radius."""
    _, _, d11, d12, d22, by_first, by_second = nearest
    return (
        d11 * trial[0] + d12 * trial[1] + by_first * limit,
        d12 * trial[0] + d22 * trial[1] + by_second * limit,
    )
