"""Structures that nothing clamps, with friction between their parts."""

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system

MASSES = (1.0, 2.0, 1.5, 0.5)
SPRINGS = (4000.0, 1000.0, 2500.0)
DRIVE = {"x1": 1.0, "x3": -0.2}


def chain(*, held: float = 0.0, slider: bool = True) -> Problem:
    """Return four masses in a row, a slider beside the middle spring.

    ``held`` is the stiffness [N/m] of the springs on which each mass hangs, over its
    mass: what moves as a whole has that frequency squared.
    """
    joint = Jenkins(stiffness=2000.0, limit=0.4)
    return system(
        mass=MASSES,
        stiffness=row(SPRINGS) + held * np.diag(MASSES),
        damping=2e-3 * row(SPRINGS),
        elements=[Element(joint, between=("x2", "x3"))] if slider else [],
        drive=DRIVE,
    )


def row(springs: tuple[float, ...]) -> Array:
    """Return the stiffness of masses with springs between neighbours."""
    ends = np.diff(np.eye(len(springs) + 1), axis=0)
    stiffness: Array = ends.T @ np.diag(springs) @ ends
    return stiffness
