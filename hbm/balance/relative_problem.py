"""From a problem to that in the relative coordinates of its contacts (theory §6.1)."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from hbm.balance.pinned import pinned
from hbm.balance.relative import RelativeProblem
from hbm.structure.condensation import condense
from hbm.structure.condensed import Condensed
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState


def relative_problem(
    problem: Problem,
    rest: StaticState,
    known: RelativeProblem | None = None,
    like: Array | None = None,
) -> RelativeProblem:
    """Return the problem in relative coordinates; ``rest`` is its equilibrium.

    ``known`` is one of the same structure and contact geometry, if there is one;
    ``like`` is a basis of others, to which that of the problem is turned.
    """
    condensed: Condensed
    if known is None:
        basis, selection = problem.interface.relative_motion()
        if like is not None and like.shape == basis.shape:
            turn, _ = scipy.linalg.orthogonal_procrustes(basis, like)
            basis, selection = basis @ turn, turn.T @ selection
        condensed = condense(problem, selection)
    else:
        basis, selection, condensed = known.basis, known.selection, known.condensed
    force = np.array([problem.preload, -1j * problem.drive])
    rank = basis.shape[1]
    made = RelativeProblem(
        problem.interface.points,
        basis,
        selection,
        np.zeros(basis.shape[0]),
        condensed,
        force,
        np.zeros((rank, 0)),
        np.zeros((rank, rank)),
        selection @ rest.displacement,
        np.zeros(problem.structure.dofs),
    )
    return pinned(made)
