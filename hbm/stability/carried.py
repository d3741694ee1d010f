"""The map of a small motion over all steps of a period (theory §6.4).

Displacements y of the contacts go with their velocities ẏ, displacements q of the modes
with their momenta w = q̇ + M_qy ẏ. What a step makes of the modes alone, and what it
takes from ẏ, are real matrices that all steps of one length share; the contacts act on
y alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.stability.carried_step import CarriedStructure, Step, step_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import inner_kernel, kernel

EQUAL = 1e-9
"""relative difference of lengths that are equal but for rounding"""


def carried(
    structure: CarriedStructure,
    elastic: Array,
    viscous: Array,
    lengths: Array,
    sticks: NDArray[np.bool_],
) -> Array:
    """Return the map of (displacement, velocity) over all steps, y before modes.

    Its shape is ``(2 coordinates, 2 coordinates)``. ``elastic`` and ``viscous`` are the
    tangents during each step, shape ``(steps, rank, rank)``. The exponential of a step
    is its Padé approximation (2, 2), x + 2 Re a (hA − ρ)⁻¹ x, or, where a contact
    begins to stick, (1, 2), 2 Re a (hA − ρ)⁻¹ x, which lets no speed through.
    """
    rank, count = structure.mass.shape
    modes, start = count - rank, np.eye(2 * count)
    inner = start[np.r_[:rank, count : count + rank]]
    outer = start[np.r_[rank:count, count + rank : 2 * count]]
    outer[modes:, count : count + rank] = structure.coupling
    held = structure.stiffness + elastic
    _carry(
        structure,
        _free(structure),
        held,
        elastic,
        viscous,
        lengths,
        sticks,
        inner,
        outer,
    )
    speeds = outer[modes:] - structure.coupling @ inner[rank:]
    return np.concatenate((inner[:rank], outer[:modes], inner[rank:], speeds))


def _free(structure: CarriedStructure) -> Array:
    """Return the mass of y while the modes keep their momentum."""
    rank = len(structure.mass)
    free: Array = (
        structure.mass[:, :rank] - structure.mass[:, rank:] @ structure.coupling
    )
    return free


@kernel
def _carry(
    structure: CarriedStructure,
    free: Array,
    held: Array,
    elastic: Array,
    viscous: Array,
    lengths: Array,
    sticks: NDArray[np.bool_],
    inner: Array,
    outer: Array,
) -> None:
    """Bring (y, ẏ) and (q, w) to the end of all steps; ``held`` is the stiffness."""
    rank, columns = structure.mass.shape[0], inner.shape[1]
    modal = outer.shape[0]
    work, loads = np.zeros((modal + 2 * rank, columns)), np.zeros(inner.shape)
    stage, share = np.zeros(inner.shape), np.zeros(outer.shape)
    alone, back = np.empty((work.shape[0], modal)), np.empty((modal, 2 * rank))
    place = 0
    while place < lengths.size:
        step = step_of(structure, lengths[place], sticks[place], alone, back)
        while place < lengths.size and _serves(step, lengths[place], sticks[place]):
            np.dot(held[place], inner[:rank], loads[:rank])
            np.dot(free, inner[rank:], loads[rank:])
            np.dot(step.alone, outer, work)
            _load(step.length / step.root, loads, work[modal:])
            np.dot(_freed(step, elastic[place], viscous[place]), work[modal:], stage)
            np.dot(step.back, stage, share)
            _advance(step.length, step.root, step.factor, step.kept, inner, stage)
            _add(work, share, outer)
            place += 1


@inner_kernel
def _serves(step: Step, length: float, sticks: bool) -> bool:
    """Return whether a step has a given kind; equal lengths differ by rounding."""
    apart = abs(step.length - length) > EQUAL * abs(step.length)
    return not apart and (step.kept == 0.0) == sticks


@kernel
def _freed(step: Step, elastic: Array, viscous: Array) -> Array:
    """Return the inverse of what acts on s, contacts included, as real rows."""
    length = step.length
    whole = step.block + (length * length / step.root) * elastic + length * viscous
    inverse = np.linalg.inv(whole)
    rank = inverse.shape[0]
    freed: Array = np.empty((2 * rank, 2 * rank))
    for row in range(rank):
        for column in range(rank):
            value = inverse[row, column]
            freed[row, column] = freed[rank + row, rank + column] = value.real
            freed[rank + row, column] = value.imag
            freed[row, rank + column] = -value.imag
    return freed


@inner_kernel
def _load(factor: complex, loads: Array, acting: Array) -> None:
    """Add (h/ρ) K y − M ẏ, both given, to what acts on s."""
    rank = loads.shape[0] // 2
    for row in range(rank):
        for column in range(loads.shape[1]):
            elastic, inertial = loads[row, column], loads[rank + row, column]
            acting[row, column] += factor.real * elastic - inertial
            acting[rank + row, column] += factor.imag * elastic


@inner_kernel
def _advance(
    length: float,
    root: complex,
    factor: complex,
    kept: float,
    inner: Array,
    stage: Array,
) -> None:
    """Bring (y, ẏ) to the end of a step."""
    rank, share = inner.shape[0] // 2, factor / root
    rest, moving, pushing = kept - 2.0 * share.real, 2.0 * length * share, 2.0 * factor
    for row in range(rank):
        for column in range(inner.shape[1]):
            real, imag = stage[row, column], stage[rank + row, column]
            change = moving.real * real - moving.imag * imag
            inner[row, column] = rest * inner[row, column] + change
            change = pushing.real * real - pushing.imag * imag
            inner[rank + row, column] = kept * inner[rank + row, column] + change


@inner_kernel
def _add(alone: Array, share: Array, outer: Array) -> None:
    """Bring (q, w) to the end of a step."""
    for row in range(outer.shape[0]):
        for column in range(outer.shape[1]):
            outer[row, column] = alone[row, column] + share[row, column]
