"""The dense structure that shapes make of one: its matrices, projected on them."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.extended import extended_product
from microslip_mechanics.structures.structure import Structure


def projected(
    structure: Structure, shapes: Array, rank: int, names: tuple[str, ...]
) -> Structure:
    """Return the dense structure of the motions u = shapes q.

    Parameters
    ----------
    structure
        Of the motions u.
    shapes
        Shape ``(dofs, coordinates)``.
    rank
        So many coordinates come first that do no work on the others.
    names
        Of the coordinates.
    """
    mass, damping = (
        shapes.T @ (matrix @ shapes) for matrix in (structure.mass, structure.damping)
    )
    if not structure.gyroscopic:
        damping = symmetric(damping)
    forces = extended_product(structure.stiffness, shapes)
    stiffness = symmetric(shapes.T @ forces)
    stiffness[rank:, :rank] = stiffness[:rank, rank:] = 0.0
    return Structure(symmetric(mass), damping, stiffness, names, structure.gyroscopic)


def symmetric(matrix: Array) -> Array:
    """Return a matrix without the asymmetry of rounding."""
    return (matrix + matrix.T) / 2.0
