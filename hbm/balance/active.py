"""Unknowns that move: what a symmetry keeps at zero is not solved for (theory §6.6)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array, ComplexArray, largest

PROBE = FourierBasis(5, 64)
"""orders that show which harmonics a coordinate has"""
BESIDE = (0.9, 1.0, 1.1)
"""frequencies over the given one, at each of which the drive must reach a coordinate:
next to a resonance rounding stands out, but not at all of them"""
SIZES, MEAN = (1e-2, 1.0, 1e2, 1e4), 1e-3
"""of random motions, over the linear one, from tiny to sliding and lifting off; and of
their means, over that: faces stay about where they are at rest"""
STILL = 1e-12
"""amplitude [m] that such a motion has at least, if no drive reaches the coordinates"""
ROUNDING = 1e-10
"""of the largest of several values, up to which one may be rounding"""
FAINT = 1e-12
"""of the largest load of the drive, below which what reaches a coordinate is rounding:
a drive in phase does not move the sectors of a disk against each other"""


def moving(problem: RelativeProblem, frequency: float) -> NDArray[np.bool_]:
    """Return the coefficients that can differ from rest, shape (11, rank).

    Beginning with what the drive reaches, those are added that the structure couples to
    what moves, or in which the contacts answer a random motion of it, from tiny to
    sliding and lifting off. Symmetry keeps the others at rest but for rounding.
    """
    contact = problem.contact(PROBE)
    still = np.zeros((PROBE.coefficients, problem.rank))
    still[0] = problem.rest
    at_rest = contact(still, frequency)
    amplitude = linear_amplitude(problem, frequency)
    faint = FAINT * largest(problem.force[1])
    driven = [_large(_load(problem, share * frequency), faint) for share in BESIDE]
    active = np.zeros(still.shape, dtype=bool)
    active[1:3] = np.logical_and.reduce(driven)
    coupling = _coupling(problem, frequency)
    random = np.random.default_rng(0)
    while True:
        grown = active.copy()
        grown[0] |= (coupling[0] & active[0]).any(axis=1)
        coupled = (coupling[1:] & active[1::2, None, :]).any(axis=2)
        grown[1:] |= coupled.repeat(2, axis=0)
        for size in SIZES:
            motion = size * amplitude * random.normal(size=active.shape) * active
            motion[0] = problem.rest + MEAN * motion[0]
            with np.errstate(over="ignore", invalid="ignore"):
                force = contact(motion, frequency)
                grown |= _large(np.nan_to_num(force - at_rest))
        grown = _paired(grown)
        if np.array_equal(grown, active):
            return active
        active = grown


def symmetric(
    active: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.bool_] | None]:
    """Return the coordinates that move, and which of them have odd harmonics only.

    The second is None if a coordinate mixes odd and even harmonics.
    """
    odd, even = _parities(active)
    kept = np.flatnonzero(odd | even)
    return kept, None if (odd & even).any() else odd[kept]


def extended(active: NDArray[np.bool_], harmonics: int) -> NDArray[np.bool_]:
    """Return the active coefficients of more harmonics, (2 harmonics + 1, rank).

    ``active`` are those of the :data:`PROBE`: odd orders stand for all odd ones, even
    orders for all even ones.
    """
    odd, even = _parities(active)
    orders = np.arange(1, harmonics + 1) % 2 == 1
    rows = np.where(orders[:, None], odd, even).repeat(2, axis=0)
    result: NDArray[np.bool_] = np.vstack([even[None, :], rows])
    return result


def _parities(
    active: NDArray[np.bool_],
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which coordinates have odd and which have even harmonics, (rank,) each."""
    return np.any(active[1::4], axis=0), active[0] | np.any(active[3::4], axis=0)


def _load(problem: RelativeProblem, frequency: float) -> ComplexArray:
    """Return the drive as the coordinates see it [N], shape (rank,)."""
    variable = np.array([1j * frequency])
    load, _ = problem.condensed.loading(problem.force[1:])(variable)
    seen: ComplexArray = load[0]
    return seen


def linear_amplitude(problem: RelativeProblem, frequency: float) -> float:
    """Return the amplitude of the linear response about rest [m].

    It is taken a little below the frequency: at an undamped resonance, as of a mode,
    there is none.
    """
    variable = np.array([1j * BESIDE[0] * frequency])
    stiffness = problem.condensed.dynamic_stiffness(variable)
    contact = problem.contact(PROBE)
    contact(np.vstack([problem.rest, np.zeros((10, problem.rank))]), frequency)
    elastic, viscous = contact.tangents.means()
    matrix = stiffness[0] + elastic + variable[0] * viscous
    load = _load(problem, BESIDE[0] * frequency)
    moved = np.linalg.lstsq(matrix, load, rcond=None)[0]
    return max(largest(moved), STILL)


def _large(values: Array | ComplexArray, faint: float = 0.0) -> NDArray[np.bool_]:
    """Return what stands out from rounding, which may be as large as ``faint``."""
    size = np.abs(values)
    large: NDArray[np.bool_] = size > max(faint, ROUNDING * size.max(initial=0.0))
    return large


def _paired(active: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Activate cosine and sine of an order together."""
    paired = active.copy()
    both = active[1::2] | active[2::2]
    paired[1::2], paired[2::2] = both, both
    return paired


def _coupling(problem: RelativeProblem, frequency: float) -> NDArray[np.bool_]:
    """Return which coordinates the structure couples, order by order from 0."""
    orders = np.arange(PROBE.harmonics + 1)
    stiffness = problem.condensed.dynamic_stiffness(1j * frequency * orders)
    size = np.abs(stiffness)
    coupled: NDArray[np.bool_] = size > ROUNDING * size.max(
        (1, 2), keepdims=True, initial=0.0
    )
    return coupled
