"""Motions that nothing holds, against bodies whose rigid motions are known."""

import numpy as np
import pytest

from free_structures import MASSES, chain
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import Beam, Frame, Node
from microslip_mechanics.structures.unheld import dragged, unheld_motions
from rigs import rig_problem


def unheld(problem: Problem) -> int:
    _, selection = problem.interface.relative_motion()
    return len(unheld_motions(problem.structure, selection).T)


def test_a_chain_moves_as_a_whole() -> None:
    problem = chain()
    _, selection = problem.interface.relative_motion()

    motions = unheld_motions(problem.structure, selection)

    np.testing.assert_allclose(np.abs(motions), np.full((4, 1), sum(MASSES) ** -0.5))
    assert not dragged(problem.structure, motions)


@pytest.mark.parametrize("held", [1e-9, 1e-3, 1.0])
def test_a_soft_spring_holds(held: float) -> None:
    # springs of 1e3 N/m leave 1e-10 N/m of rounding
    assert unheld(chain(held=held)) == 0


def test_a_body_that_contacts_hold_is_held() -> None:
    assert unheld(rig_problem(rope=None)) == 0


def test_a_frame_in_space_has_six_rigid_motions() -> None:
    section = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
    corners = ([0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.3, 0.0])
    nodes = tuple(
        Node(f"{place}", np.array(corner)) for place, corner in enumerate(corners)
    )
    beams = tuple(
        Beam(f"{place}", f"{place + 1}", section, np.array([0.0, 0.0, 1.0]), 0.0, 1e-6)
        for place in range(2)
    )
    structure = Frame(nodes, beams).structure()

    motions = unheld_motions(structure, np.zeros((0, structure.dofs)))

    assert motions.shape == (18, 6)
    unit = motions.T @ structure.mass @ motions
    np.testing.assert_allclose(unit, np.eye(6), atol=1e-12)
    assert not dragged(structure, motions)
    assert (
        np.abs(structure.stiffness @ motions).max()
        < 1e-9 * np.abs(structure.stiffness).max()
    )
