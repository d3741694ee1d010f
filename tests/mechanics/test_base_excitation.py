"""Moving ground: relative coordinates against absolute ones."""

import re

import numpy as np
import pytest

from microslip_mechanics.loads.base_excitation import (
    carried_inertia,
    frame_carried_inertia,
    translation,
)
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import (
    MOTIONS,
    Beam,
    Frame,
    GroundSpring,
    Node,
)
from microslip_mechanics.structures.structure import Structure

DIRECTION = np.array([0.3, -0.5, 0.8])
SECTION = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
MOTION = 2e-3 * np.exp(0.4j)
"""of the ground [m]"""


def clamped(root: tuple[str, ...] = ()) -> Frame:
    """Return a bent beam; ``root`` are the free motions of its first node."""
    places = np.array([[0.0, 0, 0], [0.2, 0.1, 0.0], [0.3, 0.1, 0.2]])
    nodes = tuple(
        Node(name, place, free)
        for name, place, free in zip(
            "abc", places, (root, MOTIONS, MOTIONS), strict=True
        )
    )
    beams = (
        Beam("a", "b", SECTION, np.array([-0.1, 0.2, 0.0]), 0.0, 1e-5),
        Beam("b", "c", SECTION, np.array([0.2, 0.0, -0.1]), 0.0, 1e-5),
    )
    spring = GroundSpring("c", np.array([0.0, 0.0, 1.0]), 5e4)
    return Frame(nodes, beams, (), (spring,) if not root else ())


@pytest.mark.parametrize("frequency", [150.0, 900.0, 4000.0])
def test_a_frame_on_moving_ground_moves_as_one_with_its_root_prescribed(
    frequency: float,
) -> None:
    whole = clamped(MOTIONS).structure()
    dynamic = whole.stiffness + 1j * frequency * whole.damping
    dynamic -= frequency**2 * whole.mass
    root = np.concatenate([MOTION * DIRECTION, np.zeros(3)])
    absolute = np.linalg.solve(dynamic[6:, 6:], -dynamic[6:, :6] @ root)

    frame = Frame(clamped().nodes, clamped().beams)
    load = frequency**2 * MOTION * frame_carried_inertia(frame, DIRECTION)

    relative = np.linalg.solve(dynamic[6:, 6:], load)
    carried = MOTION * translation(frame.structure().names, DIRECTION)
    np.testing.assert_allclose(
        relative + carried, absolute, rtol=0, atol=1e-9 * np.abs(absolute).max()
    )


def test_ground_springs_move_with_the_ground() -> None:
    with_spring, without = (
        frame_carried_inertia(frame, DIRECTION)
        for frame in (clamped(), Frame(clamped().nodes, clamped().beams))
    )

    np.testing.assert_array_equal(with_spring, without)


def test_a_mass_on_a_moving_support_has_the_textbook_transmissibility() -> None:
    mass, damping, stiffness, frequency = 2.0, 7.0, 300.0, 17.0
    structure = Structure(
        np.array([[mass]]), np.array([[damping]]), np.array([[stiffness]]), ("x",)
    )

    load = frequency**2 * carried_inertia(structure, np.ones(1))

    dynamic = stiffness + 1j * frequency * damping - frequency**2 * mass
    absolute = 1.0 + load[0] / dynamic
    wanted = (stiffness + 1j * frequency * damping) / dynamic
    assert absolute == pytest.approx(wanted)


def test_names_say_which_motions_the_ground_carries() -> None:
    names = ("a.ux", "a.uz", "a.ry", "12.y", "12.rz")

    found = translation(names, DIRECTION)

    np.testing.assert_array_equal(found, [0.3, 0.8, 0.0, -0.5, 0.0])


def test_what_is_no_motion_is_refused() -> None:
    structure = clamped().structure()

    message = (
        "the carried motion has shape (3,): give 12 finite numbers, "
        "one for each degree of freedom"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        carried_inertia(structure, DIRECTION)
    with pytest.raises(
        ValueError, match=r"^degree of freedom 7 does not say in which d"
    ):
        translation(("7",), DIRECTION)
