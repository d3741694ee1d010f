"""What the steps of one length share that carry a small motion (theory §6.4).

Displacements q of the modes go with their momenta w = q̇ + M_qy ẏ. What a step makes of
the modes alone, and what it takes from ẏ, are real matrices.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import inner_kernel, kernel

ROOT = 3.0 + 1j * np.sqrt(3.0)
FACTOR = 12.0 * ROOT / (2j * ROOT.imag)
STICKING_ROOT = 2.0 + 1j * np.sqrt(2.0)
STICKING_FACTOR = (3.0 + STICKING_ROOT) / (1j * STICKING_ROOT.imag)
"""poles ρ and residues a of the Padé approximations (2, 2) and (1, 2)"""


class CarriedStructure(NamedTuple):
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


@kernel
def step_of(
    structure: CarriedStructure, length: float, sticks: bool, alone: Array, back: Array
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
    structure: CarriedStructure, length: float, root: complex, dynamic: ComplexArray
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
    structure: CarriedStructure,
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
    structure: CarriedStructure, raised: ComplexArray, share: complex, acting: Array
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
