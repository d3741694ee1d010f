"""Any structure with any elements: from matrices and names to a Problem."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
import scipy.sparse
from numpy.typing import ArrayLike

from microslip_mechanics.arrays import Array, ComplexArray, Matrix
from microslip_mechanics.damping import check_dissipates, modal, rayleigh
from microslip_mechanics.element import Element, interface_of
from microslip_mechanics.forms import Form, Pair, form, place_of, relative
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structure import Structure

Drive: TypeAlias = Mapping[str, float | tuple[float, float]]
"""amplitude [N], or amplitude and phase [rad], by degree of freedom"""
ProbeForms: TypeAlias = Sequence[str] | Mapping[str, Form | Pair]
"""degrees of freedom, or names with a form or a pair of ends each"""
MANY = 12
"""so many degrees of freedom are all probes unless others are named"""


def system(
    *,
    mass: ArrayLike | Matrix,
    stiffness: ArrayLike | Matrix,
    damping: ArrayLike | Matrix | None = None,
    damping_ratio: float | None = None,
    rayleigh_damping: tuple[float, float] | None = None,
    names: Sequence[str] | None = None,
    elements: Sequence[Element] = (),
    drive: Drive | None = None,
    preload: Mapping[str, float] | None = None,
    probes: ProbeForms | None = None,
) -> Problem:
    """Return a structure with its elements and loads as a problem for the solvers.

    Parameters
    ----------
    mass, stiffness, damping
        M [kg], K [N/m], C [N s/m]: arrays, sparse matrices, or one axis for a diagonal.
    damping_ratio
        Of all modes, in place of C.
    rayleigh_damping
        α [1/s] and β [s] of C = α M + β K, in place of C.
    names
        Of the degrees of freedom; x1, x2, … if left out.
    elements
        Laws and where they act.
    drive
        Amplitude [N] of p sin(ωt + φ) by degree of freedom, or amplitude and φ [rad].
    preload
        Static forces [N].
    probes
        What results report; every degree of freedom, if there are few.

    Raises
    ------
    ValueError
        In one line, with what is wrong and what to give instead.
    """
    masses, elastic = _matrix(mass, "mass"), _matrix(stiffness, "stiffness")
    known = _names(names, masses.shape[0])
    _check_like(elastic, masses, "stiffness")
    _check_massive(masses, known)
    lossy = _damping(masses, elastic, damping, damping_ratio, rayleigh_damping)
    structure = Structure(masses, lossy, elastic, known)
    check_dissipates(structure.damping, known)
    return Problem(
        structure,
        interface_of(elements, known),
        preload=_loads(preload or {}, known, "preload").real,
        drive=_driven(drive or {}, known),
        probes=_probes(probes, known),
    )


def _matrix(given: Matrix, what: str) -> Matrix:
    """Return a square matrix, of floating point numbers."""
    sparse = bool(scipy.sparse.issparse(given))
    if sparse:
        return scipy.sparse.csc_array(given, dtype=float)
    try:
        matrix = np.array(given, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(
            f"{what} is no matrix of numbers: give rows of equal length, or the "
            "diagonal alone"
        ) from None
    if matrix.ndim == 1:
        matrix = np.diag(matrix)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or matrix.size == 0:
        raise ValueError(
            f"{what} has shape {matrix.shape}: give a square matrix, or its diagonal"
        )
    if not np.isfinite(matrix).all():
        row, column = np.argwhere(~np.isfinite(matrix))[0] + 1
        raise ValueError(
            f"{what} holds a value that is not finite, in row {row}, column {column}"
        )
    return matrix


def _names(given: Sequence[str] | None, count: int) -> tuple[str, ...]:
    """Return the names of the degrees of freedom."""
    names = tuple(given) if given is not None else ()
    if given is None:
        return tuple(f"x{place}" for place in range(1, count + 1))
    if len(names) != count:
        raise ValueError(
            f"there are {len(names)} names, but mass has shape ({count}, {count}): "
            "give one name for each degree of freedom"
        )
    twice = {name for name in names if names.count(name) > 1 or name == "ground"}
    if twice:
        raise ValueError(
            f"names of degrees of freedom: {', '.join(sorted(twice))} stands twice or "
            "is the ground: give each its own name"
        )
    return names


def _check_like(matrix: Matrix, mass: Matrix, what: str) -> None:
    if matrix.shape != mass.shape:
        raise ValueError(
            f"{what} has shape {matrix.shape}, but mass has {mass.shape}: give "
            "matrices of the same degrees of freedom"
        )
    if scipy.sparse.issparse(matrix) != scipy.sparse.issparse(mass):
        raise ValueError(f"mass or {what} is sparse, the other is not: give both alike")


def _check_massive(mass: Matrix, names: tuple[str, ...]) -> None:
    """Check that every degree of freedom has mass; others see to the matrix as such."""
    diagonal = mass.diagonal()
    if np.isfinite(diagonal).all() and diagonal.min() <= 0.0:
        place = int(diagonal.argmin())
        raise ValueError(
            f"mass of {names[place]} is {diagonal[place]:g} kg: give each degree of "
            "freedom some mass, or leave out those that have none"
        )


def _damping(
    mass: Matrix,
    stiffness: Matrix,
    damping: ArrayLike | Matrix | None,
    ratio: float | None,
    factors: tuple[float, float] | None,
) -> Matrix:
    """Return the damping matrix; none is no damping."""
    if sum(each is not None for each in (damping, ratio, factors)) > 1:
        raise ValueError(
            "damping is given twice: give one of damping, damping_ratio and "
            "rayleigh_damping"
        )
    if ratio is not None:
        return modal(mass, stiffness, ratio)
    if factors is not None:
        return rayleigh(mass, stiffness, *factors)
    if damping is None:
        return 0.0 * mass
    matrix = _matrix(damping, "damping")
    _check_like(matrix, mass, "damping")
    return matrix


def _loads(
    given: Mapping[str, float] | Mapping[str, complex],
    names: tuple[str, ...],
    what: str,
) -> ComplexArray:
    """Return loads over the degrees of freedom."""
    loads = np.zeros(len(names), dtype=complex)
    for name, force in given.items():
        place = place_of(name, names, what)
        if not cmath.isfinite(force):
            raise ValueError(f"{what} of {name} is {force}: give a finite number")
        loads[place] = force
    return loads


def _driven(given: Drive, names: tuple[str, ...]) -> Array | ComplexArray:
    """Return the drive: real if everything is driven in phase with the sine."""
    waves = {}
    for name, wave in given.items():
        amplitude, phase = wave if isinstance(wave, tuple) else (wave, 0.0)
        turn = math.remainder(phase, math.tau)
        if turn in (0.0, math.pi, -math.pi):
            waves[name] = complex(amplitude if turn == 0.0 else -amplitude)
        else:
            waves[name] = cmath.rect(1.0, phase) * amplitude
    drive = _loads(waves, names, "drive")
    return drive if drive.imag.any() else drive.real


def _probes(given: ProbeForms | None, names: tuple[str, ...]) -> Probes:
    """Return what results report."""
    if given is None:
        if len(names) > MANY:
            raise ValueError(
                f"there are {len(names)} degrees of freedom: name the probes, which "
                "results report"
            )
        given = names
    if isinstance(given, str) or not given:
        raise ValueError(f"probes = {given!r}: give the names of one or more")
    if not isinstance(given, Mapping):
        given = {name: name for name in given}
    rows = []
    for name, wanted in given.items():
        what = f"probe {name}"
        if isinstance(wanted, (str, Mapping)):
            row = form(wanted, names, what)
        else:
            row = relative(wanted, names, what)
        if not row.any():
            raise ValueError(f"{what} never moves: give a degree of freedom")
        rows.append(row)
    return Probes(tuple(given), np.array(rows))
