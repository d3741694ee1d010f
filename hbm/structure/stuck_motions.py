"""What moves of a structure while all of its contacts stick (theory §6.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.stuck import DRIVEN
from microslip_mechanics.structures.undamped_modes import undamped_modes
from microslip_mechanics.structures.unheld import dragged, unheld_motions


class StuckMotions(NamedTuple):
    """u = static y + free z + unheld w, of which the contacts see y alone."""

    static: Array
    """T: response to y, static but for what nothing holds, (dofs, rank)"""
    free: Array
    """N: what moves against stiffness while y = 0, (dofs, free)"""
    unheld: Array
    """Ψ: what nothing holds while y = 0, of unit mass, (dofs, unheld); neither y nor z
    moves it"""


def stuck_motions(structure: Structure, selection: Array) -> StuckMotions:
    """Return what a dense structure does by y = selection u, and while that is zero.

    Raises
    ------
    ValueError
        If its stiffness drives it away while all contacts stick, or if damping acts on
        what nothing holds.
    """
    stiffness = structure.stiffness
    unheld = unheld_motions(structure, selection)
    if dragged(structure, unheld):
        raise ValueError(
            "the structure can move freely while all contacts stick, and is damped in "
            "doing so: hold it by a spring, a soft one perhaps, or do not damp that"
        )
    momenta = unheld.T @ structure.mass
    seen = np.vstack([selection, momenta])
    free = scipy.linalg.null_space(seen) if seen.size else np.eye(structure.dofs)
    held, direct = free.T @ stiffness, np.linalg.pinv(selection)
    stuck = held @ free
    if (undamped_modes(stuck)[0] < 0.0).any():
        raise ValueError(DRIVEN)
    static = direct - free @ np.linalg.solve(stuck, held @ direct)
    return StuckMotions(static - unheld @ (momenta @ static), free, unheld)
