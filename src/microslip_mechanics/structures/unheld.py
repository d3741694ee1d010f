"""Motions of a structure that nothing holds, neither a stiffness nor a contact."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.undamped_modes import ROUNDING

SURE = 1e-9
"""stiffness over that of the same degrees of freedom alone, above which it holds"""
DRAG = 1e-10
"""force of damping over that of its largest part, above which it is no rounding"""


def unheld_motions(structure: Structure, selection: Array) -> Array:
    """Return the motions of a dense structure that nothing holds, of unit mass.

    They move no contact and cost no work of the stiffness but rounding, as those of a
    structure that hangs on soft ropes, without the ropes. Shape ``(dofs, motions)``.

    Parameters
    ----------
    structure
        Without contacts.
    selection
        Map to the relative motion of the contacts, shape ``(rank, dofs)``.
    """
    mass, stiffness = structure.mass, structure.stiffness
    if holds(stiffness):
        return np.zeros((structure.dofs, 0))
    still = scipy.linalg.null_space(selection) if selection.size else np.eye(len(mass))
    _, shapes = scipy.linalg.eigh(
        *(still.T @ matrix @ still for matrix in (stiffness, mass))
    )
    motions = still @ shapes
    sizes = np.abs(motions)
    work = np.einsum("ij,ij->j", motions, stiffness @ motions)
    rounding = ROUNDING * np.einsum("ij,ij->j", sizes, np.abs(stiffness) @ sizes)
    return np.ascontiguousarray(motions[:, np.abs(work) <= rounding])


def dragged(structure: Structure, motions: Array) -> bool:
    """Return whether damping or Coriolis forces act on motions, (dofs, motions)."""
    force = np.abs(structure.damping @ motions).max(initial=0.0)
    parts = np.abs(structure.damping) @ np.abs(motions)
    return bool(force > DRAG * parts.max(initial=0.0))


def holds(stiffness: Array) -> bool:
    """Return whether a stiffness is positive definite without any doubt."""
    diagonal = stiffness.diagonal()
    if not (diagonal > 0.0).all():
        return False
    scale = 1.0 / np.sqrt(diagonal)
    scaled = scale[:, None] * stiffness * scale
    try:
        np.linalg.cholesky(scaled - SURE * np.eye(len(scaled)))
    except np.linalg.LinAlgError:
        return False
    return True
