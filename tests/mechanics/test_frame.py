"""Frames: assembly, rigid motions, damping, and the structure of the rig."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh, null_space

from microslip.scenes.two_blades import layout
from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import (
    Beam,
    Frame,
    GroundSpring,
    Node,
    RigidBody,
)
from microslip_mechanics.structures.rigid_body import point_motion
from microslip_mechanics.structures.structure import Structure
from rigs import rig, rig_problem

SECTION = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
MATRICES = ("mass", "damping", "stiffness")


def free_frame() -> Frame:
    """Return an elbow of two beams with a body, held by nothing."""
    places = np.array([[0.1, -0.2, 0.3], [0.4, 0.1, 0.2], [0.5, 0.1, 0.6]])
    upward = np.cross(places[1] - places[0], [0.0, 0.3, 0.8])
    outward = np.cross(places[2] - places[1], [0.2, -0.7, 0.1])
    return Frame(
        tuple(Node(name, place) for name, place in zip("abc", places, strict=True)),
        (
            Beam("a", "b", SECTION, upward),
            Beam("b", "c", SECTION, outward),
        ),
        (RigidBody("c", 0.7, np.diag([1e-4, 2e-4, 3e-4]), places[2] + 0.05),),
    )


def damped(frame: Frame, alphas: tuple[float, float], beta: float = 1.4e-6) -> Frame:
    """Return the frame with Rayleigh damping, α beam by beam."""
    beams = tuple(
        replace(beam, mass_damping=alpha, stiffness_damping=beta)
        for beam, alpha in zip(frame.beams, alphas, strict=True)
    )
    return replace(frame, beams=beams)


def hertz(structure: Structure, allowed: Array | None = None) -> Array:
    """Return natural frequencies [Hz], of the allowed motions alone if given."""
    allowed = np.eye(structure.dofs) if allowed is None else allowed
    stiffness, mass = (
        allowed.T @ matrix @ allowed for matrix in (structure.stiffness, structure.mass)
    )
    return np.sqrt(eigh(stiffness, mass, eigvals_only=True)) / (2.0 * np.pi)


def test_free_frame_has_the_six_rigid_motions_and_no_other_without_force() -> None:
    frame = free_frame()
    structure = frame.structure()
    lift = [np.zeros((3, 3)), np.eye(3)]
    rigid = np.vstack(
        [
            row
            for node in frame.nodes
            for row in (point_motion(node.position), np.hstack(lift))
        ]
    )

    force = structure.stiffness @ rigid

    rank = np.linalg.matrix_rank(structure.stiffness, rtol=1e-11)
    largest = np.abs(structure.stiffness).max()
    np.testing.assert_allclose(force / largest, 0.0, atol=1e-15)
    assert rank == structure.dofs - 6


def test_moving_frame_has_the_mass_of_its_parts() -> None:
    frame = free_frame()
    moves = np.tile(np.eye(3, 6).T, (3, 1))

    mass = moves.T @ frame.structure().mass @ moves

    lengths = [
        np.linalg.norm(frame.nodes[k + 1].position - frame.nodes[k].position)
        for k in (0, 1)
    ]
    total = 7800.0 * 2e-4 * sum(lengths) + 0.7
    np.testing.assert_allclose(mass, total * np.eye(3), rtol=1e-14, atol=1e-15)


def test_damping_comes_from_the_beams_and_not_from_bodies_or_springs() -> None:
    spring = GroundSpring("b", np.array([0.6, 0.0, 0.8]), 1e5)
    frame = damped(replace(free_frame(), springs=(spring,)), (2.5, 2.5))

    damping = frame.structure().damping

    bare = replace(frame, bodies=(), springs=()).structure()
    expected = 2.5 * bare.mass + 1.4e-6 * bare.stiffness
    np.testing.assert_allclose(damping, expected, rtol=1e-13, atol=1e-15)


def test_frame_is_undamped_unless_told_otherwise() -> None:
    damping = free_frame().structure().damping

    np.testing.assert_array_equal(damping, 0.0)


def test_each_beam_is_damped_by_its_own_coefficient() -> None:
    first, second, both = (
        damped(free_frame(), alphas, 0.0).structure().damping
        for alphas in ((2.5, 0.0), (0.0, 0.5), (2.5, 0.5))
    )

    alone = first + second

    np.testing.assert_array_equal(alone, both)
    np.testing.assert_array_equal(first[12:], 0.0)
    np.testing.assert_array_equal(second[:6], 0.0)
    assert np.all(np.diag(first)[:12] > 0.0)
    assert np.all(np.diag(second)[6:] > 0.0)


@pytest.mark.parametrize("lean", [-0.5, -2e-9, 2e-9, 0.5])
@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
def test_thickness_that_is_not_across_the_beam_is_refused(
    lean: float, size: float
) -> None:
    beam = Beam("a", "b", SECTION, size * np.array([lean, 0.0, 1.0]))
    places = Node("a", np.zeros(3)), Node("b", np.array([0.2, 0.0, 0.0]))

    with pytest.raises(
        ValueError,
        match=r"^beam a to b: thickness_direction \[.*\] is not perpendicular to "
        r"the beam's axis$",
    ):
        Frame(places, (beam,)).structure()


def test_ground_spring_pulls_back_along_its_direction_alone() -> None:
    frame = free_frame()
    direction = np.array([0.6, 0.0, 0.8])

    sprung = replace(frame, springs=(GroundSpring("b", direction, 1e5),)).structure()

    added = sprung.stiffness - frame.structure().stiffness
    moves = frame.motion("b", frame.nodes[1].position)
    expected = 1e5 * np.outer(moves.T @ direction, moves.T @ direction)
    np.testing.assert_allclose(added, expected, rtol=0.0, atol=1e-8)


def test_locked_motions_are_left_out_of_matrices_names_and_maps() -> None:
    frame = free_frame()
    kept = ("uz", "rx")
    nodes = (frame.nodes[0], replace(frame.nodes[1], free=kept), frame.nodes[2])

    locked = replace(frame, nodes=nodes)

    places = [*range(6), 8, 9, *range(12, 18)]
    whole, part = frame.structure(), locked.structure()
    assert part.names == tuple(whole.names[place] for place in places)
    for name in MATRICES:
        np.testing.assert_array_equal(
            getattr(part, name), getattr(whole, name)[np.ix_(places, places)]
        )
    point = np.array([0.3, 0.2, 0.1])
    np.testing.assert_array_equal(
        locked.motion("b", point), frame.motion("b", point)[:, places]
    )


def test_force_at_a_point_of_a_node_enters_with_its_moment() -> None:
    frame = free_frame()
    point, force = np.array([0.9, -0.4, 0.3]), np.array([2.0, -3.0, 5.0])

    load = frame.motion("c", point).T @ force

    moment = np.cross(point - frame.nodes[2].position, force)
    np.testing.assert_allclose(load[12:], [*force, *moment], rtol=1e-14)
    np.testing.assert_array_equal(load[:12], 0.0)


@pytest.mark.parametrize(
    "ask",
    [
        lambda frame: frame.motion("d", np.zeros(3)),
        lambda frame: replace(
            frame, springs=(GroundSpring("d", np.array([0.0, 0.0, 1.0]), 1e5),)
        ).structure(),
    ],
    ids=["motion", "spring"],
)
def test_node_that_the_frame_does_not_have_is_refused(
    ask: Callable[[Frame], object],
) -> None:
    with pytest.raises(ValueError, match=r"^no node 'd': give one of a, b, c$"):
        ask(free_frame())


@pytest.mark.parametrize(("model", "dofs"), [("full", 54), ("B", 51), ("A", 51)])
def test_rig_has_as_many_degrees_of_freedom_as_the_paper_counts(
    model: str, dofs: int
) -> None:
    structure = rig_problem(model=model).structure

    assert structure.dofs == dofs
    assert len(set(structure.names)) == dofs
    assert structure.names[:2] == ("excited-blade.1.ux", "excited-blade.1.uy")
    assert structure.names[-1] == "friction-element." + ("rz" if dofs == 54 else "uz")


def test_stuck_rig_has_its_first_axial_mode_at_135_hz() -> None:
    rig = rig_problem()
    stuck = null_space(rig.interface.displacement)

    lowest = hertz(rig.structure, stuck)[0]

    assert lowest == pytest.approx(135.1, abs=0.05)


@pytest.mark.parametrize("blade", [0, 1])
def test_single_blade_has_its_modes_at_136_84_and_273_4_hz(blade: int) -> None:
    structure = rig_problem().structure
    own = np.eye(54)[:, 24 * blade : 24 * (blade + 1)]

    axial, circumferential = hertz(structure, own)[:2]

    assert axial == pytest.approx(136.84, abs=0.005)
    assert circumferential == pytest.approx(273.4, abs=0.05)


@pytest.mark.parametrize("name", MATRICES)
def test_rig_without_fan_is_its_own_mirror_image(name: str) -> None:
    structure = rig_problem(blade__fan="0 deg").structure
    blades = np.array([1, -1, 1, -1, 1, -1])  # y and the turns about x and z
    mirror = np.zeros((54, 54))
    for place in range(54):
        image = place if place >= 48 else (place + 24) % 48
        mirror[image, place] = blades[place % 6]

    matrix = getattr(structure, name)

    mirrored = mirror.T @ matrix @ mirror
    np.testing.assert_allclose(mirrored, matrix, rtol=1e-14, atol=0.0)


def test_fan_turns_the_excited_blade_alone() -> None:
    straight, leaning = (
        rig_problem(blade__fan=fan).structure for fan in ("0 deg", "6 deg")
    )

    changed = np.any(straight.stiffness != leaning.stiffness, axis=1)

    assert not np.any(changed[24:])
    own = np.eye(54)[:, :24]
    np.testing.assert_allclose(hertz(leaning, own), hertz(straight, own), rtol=1e-10)


@pytest.mark.parametrize("absent", [{"rope": None}, {"rope__stiffness": 0}])
def test_without_rope_there_is_no_spring(absent: dict[str, object]) -> None:
    springs = layout.frame(rig(**absent)).springs

    assert springs == ()


def test_rope_stiffens_the_friction_element_along_z_alone() -> None:
    roped, loose = rig_problem(rope__stiffness="0.01 N/mm"), rig_problem(rope=None)

    added = roped.structure.stiffness - loose.structure.stiffness

    place = roped.structure.names.index("friction-element.uz")
    expected = np.zeros((54, 54))
    expected[place, place] = 10.0
    np.testing.assert_array_equal(added, expected)
    np.testing.assert_array_equal(roped.structure.mass, loose.structure.mass)
    np.testing.assert_array_equal(roped.structure.damping, loose.structure.damping)
