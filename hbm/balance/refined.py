"""Newton steps at a finer resolution, and what they leave to be done (theory §6.3)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from hbm.continuation.linearised import Linearised
from hbm.continuation.newton import CHORD, ROUNDING
from microslip_mechanics.arrays import Array

SURE = 0.25
"""share of a residual that a Newton step leaves, after which the next leaves less"""
MANY = 500
"""harmonics with which a step is halved that would raise the residual; from fewer that
lead away a point goes on to more
"""
LOST = 0.5
"""share of a residual that is still there after steps that lead to no point"""
FEW = 16
"""harmonics below which a series may not have begun to fall as it will"""
WARY, SAFE = 9.0, 4.5
"""factors of the impulses beyond: with few harmonics, and with more"""
MOST = 2.0
"""what all harmonics beyond change at the most, over what the last octave did"""


class Resolved(Protocol):
    """A system at one resolution."""

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        """Return the residual, and what solves with its Jacobian."""

    def residual(self, point: Array) -> Array:
        """Return the residual alone."""

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""

    def answer(self, point: Array, residual: Array, above: int) -> Array:
        """Return the step with which orders above one answer the residual there.

        That is the last one made.
        """


class Patience(NamedTuple):
    """With which a finer point is sought."""

    steps: int
    """that are taken at the most until one leaves little"""
    halvings: int
    """of one that would raise the residual"""


HASTY, FIRM, PATIENT = Patience(4, 0), Patience(4, 3), Patience(16, 3)
"""from which more harmonics follow; with many; what is reported, of the most"""


class Refined(NamedTuple):
    """A point after some Newton steps, and what they leave."""

    residual: Array
    """of the finer resolution before them"""
    before: Array
    """the point before the last step"""
    corrected: Array
    """and after it"""
    left: float
    """what further steps would change, over what the last did"""
    beyond: float
    """what still more harmonics would change, over what all steps did"""
    rest: Array
    """the residual there"""
    slope: Linearised
    """the derivative that the last step had"""
    further: Array
    """the point after one more step, where harmonics are few, else the last"""


def refined(
    system: Resolved,
    point: Array,
    harmonics: int,
    normal: Array,
    far: Callable[[Sequence[Array]], bool] = lambda _: True,
    patience: Patience | None = None,
) -> Refined:
    """Return a point after Newton steps in the plane normal to ``normal``.

    ``harmonics`` are those of ``system``, about twice those of the point. There are two
    steps, and as many as the ``patience`` allows until one leaves little, or one alone
    that is mere rounding; twice as many where one takes back but what another has
    raised, away from the point, if points before all steps, before the last and after
    it are ``far`` from each other. Patience that is left out is :data:`FIRM` with
    :data:`MANY` harmonics, else :data:`HASTY`. A step has the factors of the one before
    if that left a tenth.

    Raises
    ------
    SingularError
        If the point lies on a fold.
    """
    steps, halvings = patience or (FIRM if harmonics >= MANY else HASTY)
    residual, latest = system(point)
    known = system.impulses(harmonics // 2, harmonics)
    before, after, now, sizes = point, point, residual, [_size(residual)]
    moves, slope = True, latest
    while moves and (
        _due(sizes, steps)
        or (_takes_back(sizes, 2 * steps) and far((point, before, after)))
    ):
        slope = slope if _served(sizes) else latest
        step = slope.solve(normal, np.append(-now, 0.0))
        before = after
        after, now, latest = _lowered(system, before, step, sizes[-1], halvings)
        sizes.append(_size(now))
        moves = _size(step) > ROUNDING * _size(point[:-1])
    share = system.impulses(harmonics, 2 * harmonics + 1) / known if known else 0.0
    left = _left(sizes, steps <= FIRM.steps) if moves else 1.0
    beyond = _beyond(share, harmonics)
    tells = moves and harmonics < FEW
    further = _stepped(latest, after, now, normal) if tells else after
    return Refined(residual, before, after, left, beyond, now, slope, further)


def _stepped(slope: Linearised, point: Array, residual: Array, normal: Array) -> Array:
    """Return where one more step leads, with the derivative at the point itself.

    From few harmonics the steps before may have led far, beside a fold perhaps: the
    residual that they leave tells too little.
    """
    return point - slope.solve(normal, np.append(residual, 0.0))


def _lowered(
    system: Resolved, point: Array, step: Array, size: float, halvings: int
) -> tuple[Array, Array, Linearised]:
    """Return where a step leads that lowers the residual from ``size``, and what is.

    It is halved until it does, or so many times.
    """
    for halving in range(halvings + 1):
        reached = point + 0.5**halving * step
        residual, linearised = system(reached)
        if _size(residual) <= size:
            break
    return reached, residual, linearised


def _size(values: Array) -> float:
    return float(np.linalg.norm(values))


def _due(sizes: list[float], most: int) -> bool:
    """Return whether another step is due, from the residuals before and after each."""
    return len(sizes) < 3 or (sizes[-1] > SURE * sizes[-2] and len(sizes) <= most)


def _takes_back(sizes: list[float], most: int) -> bool:
    """Return whether the last step left little but of what one before had raised."""
    falls = SURE * min(sizes[:-1]) < sizes[-1] <= SURE * sizes[-2]
    return falls and len(sizes) <= most


def _served(sizes: list[float]) -> bool:
    """Return whether there was a step that left little, from the residuals."""
    return len(sizes) > 1 and sizes[-1] <= CHORD * sizes[-2]


def _left(sizes: list[float], few: bool) -> float:
    """Return what steps to come change, over the last, from the residuals.

    Infinite where the steps lead to no point. The last of a few tells no more than that
    the next may change as much.
    """
    between, after = sizes[-2:]
    if not after <= max(SURE * between, LOST * sizes[0]):
        return math.inf
    if few and after > SURE * between:
        return 1.0
    if after < between:
        return after / (between - after)
    return math.inf if after > 0.0 else 0.0


def _beyond(share: float, harmonics: int) -> float:
    """Return what still more harmonics change, over what the last octave did.

    ``share`` is that of the contact impulses beyond, over those of the octave. Motions
    of high order answer these impulses, and act on the low orders through tangents that
    fall alike: what they change is like the square.
    """
    if harmonics < FEW:
        return (WARY * share) ** 2
    return min(MOST, (SAFE * share) ** 2)
