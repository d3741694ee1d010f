"""Undamped modes beside far stiffer ones, and beside free ones."""

import numpy as np
import pytest

from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import Beam, Frame, Node
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.undamped_modes import undamped_modes

LENGTH, THICKNESS, YOUNG, DENSITY = 0.5, 0.01, 2.1e11, 7850.0
MOVES = ("uz", "ry")


def beam(elements: int, *, clamped: bool) -> Structure:
    """Return a beam that bends in one plane."""
    section = RectangularSection(0.02, THICKNESS, YOUNG, 0.3, DENSITY)
    nodes = [
        Node(
            f"n{place}",
            np.array([LENGTH * place / elements, 0.0, 0.0]),
            () if clamped and place == 0 else MOVES,
        )
        for place in range(elements + 1)
    ]
    up = np.array([0.0, 0.0, 1.0])
    beams = [
        Beam(f"n{place}", f"n{place + 1}", section, up, 2.0)
        for place in range(elements)
    ]
    return Frame(tuple(nodes), tuple(beams)).structure()


@pytest.mark.parametrize(
    ("clamped", "root"), [(True, 1.875104068711961), (False, 4.730040744862704)]
)
@pytest.mark.parametrize("elements", [20, 400])
def test_the_slowest_bending_mode_is_that_of_the_closed_form(
    elements: int, clamped: bool, root: float
) -> None:
    structure = beam(elements, clamped=clamped)

    squares, shapes = undamped_modes(structure.stiffness, structure.mass)

    waves = np.sqrt(YOUNG / (12.0 * DENSITY)) * THICKNESS / LENGTH**2
    bending = squares[0 if clamped else 2]
    # the elements know shear and rotary inertia as well
    assert np.sqrt(bending) == pytest.approx(root**2 * waves, rel=2e-3)
    assert (squares == 0.0).sum() == (0 if clamped else 2)
    unit = shapes.T @ structure.mass @ shapes
    np.testing.assert_allclose(unit, np.eye(len(squares)), atol=1e-6)


def test_many_elements_change_no_slow_mode() -> None:
    few, many = (
        undamped_modes(structure.stiffness, structure.mass)[0][0]
        for structure in (beam(60, clamped=True), beam(400, clamped=True))
    )

    # the eigenvalue itself is off by 5e-6, and was taken for rounding
    assert many == pytest.approx(few, rel=5e-7)


def test_a_light_stiff_part_hides_no_other_mode() -> None:
    stiffness = np.array([[1e4 + 1e10, -1e10], [-1e10, 1e10]])

    squares, _ = undamped_modes(stiffness, np.diag([1.0, 1e-9]))

    assert squares[0] == pytest.approx(1e4, rel=1e-5)


def test_negative_stiffness_stays() -> None:
    squares, _ = undamped_modes(np.diag([-1.0, 2.0]), np.eye(2))

    assert squares == pytest.approx([-1.0, 2.0])
