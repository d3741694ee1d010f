"""Rigid Coulomb friction as a projection, and a mass that slides under it (eq. 9b)."""

from __future__ import annotations

import math

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel


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
def slide_in_plane(
    push: Array, limit: float, loss: float, old: Array, step: Array, by: Array
) -> None:
    """Write what one step does to a mass that slides in a plane.

    With the momentum p = m v / h before a step of length h, the mean push g over it and
    the loss a = c h / (2 m) by a dashpot c, the traction is that nearest to the trial
    g + (1 − a) p, and (1 + a) p is what it leaves: the mass slides on, or stops.

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
    kept, left = 1.0 - loss, 1.0 / (1.0 + loss)
    one, two = push[0] + kept * old[0], push[1] + kept * old[1]
    first, second, d11, d12, d22, by_first, by_second = nearest_traction(
        one, two, limit
    )
    step[0], step[1] = first, second
    step[2], step[3] = left * (one - first), left * (two - second)
    by[0, 0], by[0, 1], by[0, 2] = d11, d12, by_first
    by[1, 0], by[1, 1], by[1, 2] = d12, d22, by_second
    for row in range(2):
        by[row, 3], by[row, 4] = kept * by[row, 0], kept * by[row, 1]
        by[row, 5] = -by[row, 0] * old[0] - by[row, 1] * old[1]
        for column in range(6):
            by[row + 2, column] = -left * by[row, column]
        by[row + 2, row] += left
        by[row + 2, row + 3] += left * kept
        by[row + 2, 5] -= left * (old[row] + step[row + 2])


@bare_kernel
def slide_on_line(
    push: float, limit: float, loss: float, old: float, step: Array, by: Array
) -> None:
    """Write what one step does to a mass that slides along a line.

    As :func:`slide_in_plane`, but the moment within the step at which the mass stops,
    or turns, is found: the mean traction is a smooth function of the push.

    ``step``, shape ``(2,)``, and ``by``, shape ``(2, 4)``: as there, for one direction.
    """
    side = 1.0 if old > 0.0 or (old == 0.0 and push > 0.0) else -1.0
    by[:] = 0.0
    left = 1.0 / (1.0 + loss)
    end = left * ((1.0 - loss) * old + push - side * limit)
    if limit <= 0.0 or (old != 0.0 and side * end >= 0.0):
        if limit <= 0.0:
            side, end = 0.0, left * ((1.0 - loss) * old + push)
        step[0], step[1] = side * limit, end
        by[0, 1] = side
        by[1, 0], by[1, 1], by[1, 2] = left, -left * side, left * (1.0 - loss)
        by[1, 3] = -left * (old + end)
        return
    # the share of the step after which the mass stands still, and its derivatives
    slowing = push - side * limit - loss * old
    share, turn = 0.0, 0.0
    before = (0.0, 0.0, 0.0, 0.0)
    if old != 0.0:
        share, turn = -old / slowing, old / (slowing * slowing)
        before = (turn, -side * turn, -1.0 / slowing - loss * turn, -old * turn)
    rest = 1.0 - share
    held = min(max(push, -limit), limit)
    sticks = 1.0 if abs(push) < limit else 0.0
    slips = 0.0 if sticks > 0.0 else math.copysign(1.0, push)
    tail = 1.0 / (1.0 + loss * rest)
    step[0] = share * side * limit + rest * held
    step[1] = tail * rest * (push - held)
    for column in range(4):
        by[0, column] = (side * limit - held) * before[column]
        by[1, column] = -tail * tail * (push - held) * before[column]
    by[0, 0] += rest * sticks
    by[0, 1] += share * side + rest * slips
    by[1, 0] += tail * rest * (1.0 - sticks)
    by[1, 1] -= tail * rest * slips
    by[1, 3] -= tail * tail * rest * rest * (push - held)
