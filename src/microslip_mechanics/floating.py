"""Which motions of a problem nothing but friction holds (theory §6.5)."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.potential import potential
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.undamped_modes import ROUNDING
from microslip_mechanics.structures.unheld import holds

SEEN = 1e-9
"""of the largest motion of the contacts: a motion that moves them less is none"""


def floating(problem: Problem) -> Floating:
    """Return the motions of a dense problem that neither springs nor loads hold."""
    rows = problem.interface.displacement
    if holds(problem.structure.stiffness):
        return Floating(np.zeros((len(rows), 0)), np.zeros(len(rows)))
    rest = static_equilibrium(problem).displacement
    stiffness = potential(problem, rest).hessian
    _, motions = scipy.linalg.eigh(stiffness, problem.structure.mass)
    sizes = np.abs(motions)
    work = np.einsum("ij,ij->j", motions, stiffness @ motions)
    rounding = ROUNDING * np.einsum("ij,ij->j", sizes, np.abs(stiffness) @ sizes)
    seen = rows @ motions[:, np.abs(work) <= rounding]
    left, moved, _ = np.linalg.svd(seen, full_matrices=False)
    least = SEEN * np.abs(rows @ motions).max(initial=0.0)
    return Floating(left[:, moved > least], rows @ rest)
