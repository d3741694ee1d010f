"""The map of a small motion over all steps of a period (theory §6).

Displacements y of the contacts go with their velocities ẏ, displacements q of the modes
with their momenta w = q̇ + M_qy ẏ. What a step makes of the modes alone, and what it
takes from ẏ, are real matrices that all steps of one length share; the contacts act on
y alone.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import inner_kernel, kernel

ROOT = 3.0 + 1j * np.sqrt(3.0)
FACTOR = 12.0 * ROOT / (2j * ROOT.imag)
STICKING_ROOT = 2.0 + 1j * np.sqrt(2.0)
STICKING_FACTOR = (3.0 + STICKING_ROOT) / (1j * STICKING_ROOT.imag)
"""poles ρ and residues a of the Padé approximations (2, 2) and (1, 2)"""
EQUAL = 1e-9
"""relative difference of lengths that are equal but for rounding"""


class Structure(NamedTuple):
    """Coordinates y and modes of a structure; nothing elastic couples them."""

    mass: Array
    """rows of y, shape (rank, rank + modes)"""
    coupling: Array
    """mass of the modes by y, shape (modes, rank); that of the modes is one"""
    damping: Array
    """shape (rank + modes, rank + modes)"""
    stiffness: Array
    """of y, shape (rank, rank)"""
    squares: Array
    """of the modes' frequencies [rad²/s²], shape (modes,)"""


class Step(NamedTuple):
    """What all steps of one length share; complex rows are real ones, then imaginary.

    The stage s is what (hA − ρ)⁻¹ makes of the velocities ẏ.
    """

    length: float
    """h [s]"""
    root: complex
    """ρ"""
    factor: complex
    """a"""
    kept: float
    """of what is infinitely fast"""
    alone: Array
    """from (q, w) to themselves while s = 0, and to what acts on s, shape
    (2 modes + 2 rank, 2 modes)"""
    back: Array
    """from s to (q, w), shape (2 modes, 2 rank)"""
    block: ComplexArray
    """what acts on s is that times s, without the contacts, shape (rank, rank)"""


def carried(
    structure: Structure,
    elastic: Array,
    viscous: Array,
    lengths: Array,
    sticks: NDArray[np.bool_],
) -> Array:
    """Return the map of (displacement, velocity) over all steps.

    ``elastic`` and ``viscous`` are the tangents during each step, shape
    ``(steps, rank, rank)``. The exponential of a step is its Padé approximation (2, 2),
    x + 2 Re a (hA − ρ)⁻¹ x, or, where a contact begins to stick, (1, 2),
    2 Re a (hA − ρ)⁻¹ x, which lets no speed through.
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


def _free(structure: Structure) -> Array:
    """Return the mass of y while the modes keep their momentum."""
    rank = len(structure.mass)
    free: Array = (
        structure.mass[:, :rank] - structure.mass[:, rank:] @ structure.coupling
    )
    return free


@kernel
def _carry(
    structure: Structure,
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
        step = _step(structure, lengths[place], sticks[place], alone, back)
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
    apart = abs(step.length - length) > EQUAL * step.length
    return not apart and (step.kept == 0.0) == sticks


@kernel
def _step(
    structure: Structure, length: float, sticks: bool, alone: Array, back: Array
) -> Step:
    """Return what steps of a length share; ``alone`` and ``back`` are written.

    They come from h²K/ρ + hC + ρM, of which the modes are eliminated.
    """
    rank, count = structure.mass.shape
    root, factor, kept = ROOT, FACTOR, 1.0
    if sticks:
        root, factor, kept = STICKING_ROOT, STICKING_FACTOR, 0.0
    dynamic = np.empty((count, count), dtype=np.complex128)
    _dynamic(structure, length, root, dynamic)
    column = np.ascontiguousarray(dynamic[rank:, :rank])
    inverse = np.linalg.inv(dynamic[rank:, rank:].copy())
    lowered = np.dot(inverse, column)
    raised = np.dot(dynamic[:rank, rank:].copy(), inverse)
    block = dynamic[:rank, :rank] - np.dot(raised, column)
    moving = length * factor / root
    rest = kept - 2.0 * (factor / root).real, kept
    _write_alone(structure, inverse, length / root, (moving, factor), rest, alone)
    _write_raised(structure, raised, length / root, alone[2 * (count - rank) :])
    _write_back(structure.coupling, lowered, moving, factor, back)
    return Step(length, root, factor, kept, alone, back, block)


@inner_kernel
def _dynamic(
    structure: Structure, length: float, root: complex, dynamic: ComplexArray
) -> None:
    """Write h²K/ρ + hC + ρM."""
    rank, count = structure.mass.shape
    scale = length * length / root
    for row in range(count):
        for column in range(count):
            dynamic[row, column] = length * structure.damping[row, column]
    for row in range(rank):
        for column in range(rank):
            dynamic[row, column] += scale * structure.stiffness[row, column]
        for column in range(count):
            dynamic[row, column] += root * structure.mass[row, column]
    for mode in range(count - rank):
        row = rank + mode
        dynamic[row, row] += scale * structure.squares[mode] + root
        for column in range(rank):
            dynamic[row, column] += root * structure.coupling[mode, column]


@inner_kernel
def _write_alone(
    structure: Structure,
    inverse: ComplexArray,
    share: complex,
    factors: tuple[complex, complex],
    rest: tuple[float, float],
    alone: Array,
) -> None:
    """Write what becomes of (q, w) alone; ``share`` is h/ρ, ``factors`` ha/ρ and a.

    ``rest`` is what stays of q and w.
    """
    modes = inverse.shape[0]
    for row in range(modes):
        for column in range(modes):
            value = 2.0 * inverse[row, column]
            scaled = share * structure.squares[column] * value
            for part in range(2):
                place = part * modes + row
                alone[place, column] = (factors[part] * scaled).real
                alone[place, modes + column] = -(factors[part] * value).real
        alone[row, row] += rest[0]
        alone[modes + row, modes + row] += rest[1]


@inner_kernel
def _write_raised(
    structure: Structure, raised: ComplexArray, share: complex, acting: Array
) -> None:
    """Write how (q, w) acts on s."""
    rank, modes = raised.shape
    for row in range(rank):
        for column in range(modes):
            value = raised[row, column]
            scaled = share * structure.squares[column] * value
            acting[row, column] = -scaled.real
            acting[rank + row, column] = -scaled.imag
            acting[row, modes + column] = (
                value.real - structure.mass[row, rank + column]
            )
            acting[rank + row, modes + column] = value.imag


@inner_kernel
def _write_back(
    coupling: Array,
    lowered: ComplexArray,
    moving: complex,
    factor: complex,
    back: Array,
) -> None:
    """Write how s acts on (q, w)."""
    modes, rank = coupling.shape
    for row in range(modes):
        for column in range(rank):
            value = -2.0 * moving * lowered[row, column]
            back[row, column], back[row, rank + column] = value.real, -value.imag
            value = 2.0 * factor * (coupling[row, column] - lowered[row, column])
            back[modes + row, column] = value.real
            back[modes + row, rank + column] = -value.imag


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
