"""Modes of the structure and relative coordinates that touch few points each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.undamped_modes import undamped_modes


class Contacts(NamedTuple):
    """Contact points and the few relative coordinates that each one sees."""

    points: ContactPoints
    basis: Array
    """relative displacements from the point's coordinates, (points, 3, width)"""
    first: NDArray[np.int64]
    """the first of the point's coordinates, shape (points,)"""
    width: NDArray[np.int64]
    """the number of the point's coordinates, shape (points,)"""


class Modes(NamedTuple):
    """A structure in its mass-normalised undamped modes."""

    stiffness: Array
    """Ω² [1/s²], shape (modes,)"""
    damping: Array
    """diagonal of Φᵀ C Φ [1/s], shape (modes,)"""
    coupling: Array
    """Φᵀ C Φ without its diagonal, shape (modes, modes)"""
    reach: NDArray[np.int64]
    """first and behind the last entry of each of its rows, shape (modes, 2)"""
    loads: Array
    """of preload and drive, shape (loads, modes)"""
    selection: Array
    """relative coordinates from the modes, shape (rank, modes)"""
    seen: Array
    """the same, transposed: shape (modes, rank)"""
    mobility: Array
    """relative acceleration from a force on the same coordinates, (rank, rank)"""
    probes: Array
    """shape (probes, modes)"""


@dataclass(frozen=True, slots=True)
class Coordinates:
    """What a march in modes needs of a problem."""

    modes: Modes
    contacts: Contacts
    shapes: Array
    """Φ, shape (dofs, modes)"""
    inverse: Array
    """Φᵀ M, shape (modes, dofs)"""


def modal_coordinates(problem: Problem) -> Coordinates:
    """Return all modes of the structure and its contacts in compact coordinates."""
    structure = problem.structure.dense
    squares, shapes = undamped_modes(structure.stiffness, structure.mass)
    damping = shapes.T @ structure.damping @ shapes
    floor = 1e-12 * np.abs(damping).max(initial=0.0)
    _, families = connected_components(np.abs(damping) > floor)
    order = np.argsort(families, kind="stable")
    squares, shapes, damping = (
        squares[order],
        shapes[:, order],
        damping[order][:, order],
    )
    coupling = damping - np.diag(np.diag(damping))
    coupling[np.abs(coupling) <= floor] = 0.0
    inverse = shapes.T @ structure.mass
    contacts, selection = compact_contacts(problem.interface)
    seen = np.ascontiguousarray((selection @ shapes).T)
    modes = Modes(
        squares,
        np.diag(damping).copy(),
        coupling,
        _reach(coupling),
        np.ascontiguousarray(problem.loads @ shapes),
        np.ascontiguousarray(seen.T),
        seen,
        seen.T @ seen,
        np.ascontiguousarray(problem.probes.rows @ shapes),
    )
    return Coordinates(modes, contacts, shapes, inverse)


def _reach(matrix: Array) -> NDArray[np.int64]:
    """Return where the entries of each row begin and end."""
    size = len(matrix)
    filled = matrix != 0.0
    begin = np.where(filled.any(axis=1), filled.argmax(axis=1), 0)
    end = np.where(filled.any(axis=1), size - filled[:, ::-1].argmax(axis=1), 0)
    return np.stack([begin, end], axis=1).astype(np.int64)


def compact_contacts(interface: Interface) -> tuple[Contacts, Array]:
    """Return contacts in coordinates that touch as few points as possible.

    The coordinates span what :meth:`Interface.relative_motion` spans. Points whose
    motions are independent of those of all others get coordinates of their own.

    Returns
    -------
    contacts, selection
        The second maps the structure to the coordinates, shape ``(rank, dofs)``.
    """
    count = interface.count
    whole, rows = interface.relative_motion()
    if count == 0:
        none = np.zeros(0, dtype=np.int64)
        return Contacts(interface.points, np.zeros((0, 3, 0)), none, none), rows
    projection = np.abs(whole @ whole.T).reshape(count, 3, count, 3).max(axis=(1, 3))
    _, group = connected_components(projection > 1e-9)
    pieces = [np.flatnonzero(group == each) for each in np.unique(group)]
    spans = [_part(interface, members).relative_motion() for members in pieces]
    widths = [basis.shape[1] for basis, _ in spans]
    table = np.zeros((count, 3, max(widths)))
    first, width = np.zeros((2, count), dtype=np.int64)
    place = 0
    for members, (basis, _), size in zip(pieces, spans, widths, strict=True):
        table[members, :, :size] = basis.reshape(-1, 3, size)
        first[members], width[members] = place, size
        place += size
    selection = np.vstack([rows for _, rows in spans])
    return Contacts(interface.points, table, first, width), selection


def _part(interface: Interface, members: NDArray[np.int64]) -> Interface:
    """Return the interface of some points."""
    rows = interface.displacement.reshape(interface.count, 3, -1)[members]
    columns = interface.points._asdict()
    points = ContactPoints(**{name: each[members] for name, each in columns.items()})
    names = tuple(interface.names[each] for each in members)
    return Interface(points, rows.reshape(3 * len(members), -1), names)
