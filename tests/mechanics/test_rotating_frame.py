"""Rotating beams and bodies against published frequencies, closed forms and energy."""

import numpy as np
import pytest
import scipy.linalg
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation as Turn

from convergence import observed_order
from microslip.scenes.two_blades import layout
from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection, beam_matrices
from microslip_mechanics.structures.frame import MOTIONS, Beam, Frame, Node, RigidBody
from microslip_mechanics.structures.rotating_beam import (
    rotating_beam,
    tension_stiffness,
)
from microslip_mechanics.structures.rotating_body import rotating_body
from microslip_mechanics.structures.rotating_frame import RotatingFrame
from microslip_mechanics.structures.rotation import Rotation, cross
from rigs import rig

SECTION = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
SQUARE = RectangularSection(0.01, 0.01, 2.1e11, 0.3, 7800.0)
LENGTH = 1.0
ALONG, UP = np.eye(3)[0], np.eye(3)[2]
FLAP, LAG = ("uz", "ry"), ("uy", "rz")
WRIGHT = {
    1.0: (3.6816, 22.1810, 61.8418),
    2.0: (4.1373, 22.6149, 62.2732),
    3.0: (4.7973, 23.3203, 62.9850),
    4.0: (5.5850, 24.2733, 63.9668),
    5.0: (6.4495, 25.4461, 65.2050),
    10.0: (11.2023, 33.6404, 74.6493),
}
"""ω √(ρ A L⁴/E I) out of the plane of rotation at Ω √(ρ A L⁴/E I), hub radius zero

Wright, Smith, Thresher, Wang (1982), Vibration modes of centrifugally stiffened beams,
Journal of Applied Mechanics 49, 197–202."""


def blade(elements: int, section: RectangularSection = SECTION) -> Frame:
    """Return a beam along x from the origin, clamped there."""
    nodes = tuple(
        Node(f"{k}", place * ALONG, MOTIONS if k else ())
        for k, place in enumerate(np.linspace(0.0, LENGTH, elements + 1))
    )
    beams = tuple(Beam(f"{k}", f"{k + 1}", section, UP) for k in range(elements))
    return Frame(nodes, beams)


def unit_rate(inertia: float) -> float:
    """Return √(E I/(ρ A L⁴)) [rad/s]."""
    rigidity = SECTION.young_modulus * inertia
    return float(np.sqrt(rigidity / (SECTION.density * SECTION.area * LENGTH**4)))


def bending(frame: RotatingFrame, motions: tuple[str, str]) -> Array:
    """Return frequencies [rad/s] with all motions but these locked."""
    structure = frame.structure()
    kept = [name.split(".")[1] in motions for name in structure.names]
    place = np.ix_(kept, kept)
    squares = scipy.linalg.eigh(
        structure.stiffness[place], structure.mass[place], eigvals_only=True
    )
    return np.sqrt(squares)


def gyroscopic(frame: RotatingFrame, *, coriolis: bool = True) -> Array:
    """Return all frequencies [rad/s] of M ü + G u̇ + K u = 0."""
    structure, count = frame.structure(), frame.frame.structure().dofs
    gyro = frame.coriolis() if coriolis else np.zeros((count, count))
    system = np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-structure.stiffness, -gyro],
        ]
    )
    weight = scipy.linalg.block_diag(np.eye(count), structure.mass)
    found: Array = np.imag(scipy.linalg.eigvals(system, weight))
    return np.sort(found[found > 0.0])


def exact(speed: float, hub: float, mode: int) -> float:
    """Return a frequency of (w'')'' − (T w')' = ω² w, all without dimension.

    The tension T is that of what lies beyond, Ω² ∫ (hub + x) dx; by shooting.
    """

    def ends(frequency: float) -> float:
        def slope(x: float, state: Array) -> Array:
            w = state.reshape(4, 2)
            tension = speed**2 * (0.5 * (1.0 - x**2) + hub * (1.0 - x))
            fall = -(speed**2) * (hub + x)
            fourth = tension * w[2] + fall * w[1] + frequency**2 * w[0]
            return np.concatenate([w[1], w[2], w[3], fourth])

        start = np.zeros((4, 2))
        start[2, 0] = start[3, 1] = 1.0
        shot = solve_ivp(
            slope, (0.0, 1.0), start.ravel(), "DOP853", rtol=1e-11, atol=1e-12
        )
        return float(np.linalg.det(shot.y[:, -1].reshape(4, 2)[2:]))

    grid = np.linspace(1.0, 40.0, 40)
    values = np.array([ends(frequency) for frequency in grid])
    left = np.flatnonzero(values[:-1] * values[1:] < 0.0)[mode]
    return float(brentq(ends, grid[left], grid[left + 1], xtol=1e-10))


@pytest.mark.parametrize("speed", sorted(WRIGHT))
def test_frequencies_of_a_rotating_blade_are_the_published_ones(speed: float) -> None:
    rate = unit_rate(SECTION.inertia_y)
    turning = RotatingFrame(blade(32), Rotation(speed * rate, UP, np.zeros(3)))

    found = bending(turning, FLAP)[:3] / rate

    # the table has four decimals; 32 elements leave 3e-6 of the third mode
    np.testing.assert_allclose(found, WRIGHT[speed], rtol=4e-6, atol=6e-5)


@pytest.mark.parametrize("hub", [0.0, 1.0])
@pytest.mark.parametrize("mode", [0, 1])
def test_frequencies_converge_to_the_continuous_beam_with_fourth_order(
    hub: float, mode: int
) -> None:
    rate = unit_rate(SECTION.inertia_y)
    spin = Rotation(5.0 * rate, UP, -hub * LENGTH * ALONG)
    counts = np.array([4, 6, 8, 12])

    wanted = exact(5.0, hub, mode)
    errors = [
        bending(RotatingFrame(blade(int(count)), spin), FLAP)[mode] / rate / wanted - 1
        for count in counts
    ]

    assert abs(errors[-1]) < 3e-5
    order = observed_order(list(1.0 / counts), list(np.abs(errors)))
    assert order == pytest.approx(4.0, abs=0.3)


def test_in_the_plane_of_rotation_squares_fall_by_that_of_the_speed() -> None:
    turning = RotatingFrame(blade(6, SQUARE), Rotation(200.0, UP, -0.3 * ALONG))

    out, within = (bending(turning, motions) for motions in (FLAP, LAG))

    np.testing.assert_allclose(within**2, out**2 - 200.0**2, rtol=1e-9)


def test_a_shaft_seen_from_axes_that_turn_with_it_whirls_at_both_sums() -> None:
    at_rest = RotatingFrame(blade(6, SQUARE), Rotation(0.0, ALONG, np.zeros(3)))
    turning = RotatingFrame(blade(6, SQUARE), Rotation(40.0, ALONG, np.zeros(3)))

    still, found = bending(at_rest, FLAP)[:3], gyroscopic(turning)

    for wanted in (*(still - 40.0), *(still + 40.0)):
        assert np.abs(found - wanted).min() < 1e-7 * wanted


def test_softening_and_mass_of_an_element_have_the_same_shapes() -> None:
    parts = [
        rotating_beam(SECTION, 0.3, cross(axis), np.zeros(3)) for axis in np.eye(3)
    ]

    moved = [motion for motion in range(12) if motion % 6 != 3]
    place = np.ix_(moved, moved)
    mass = beam_matrices(SECTION, 0.3)[1][place]
    total = np.sum([part.softening for part in parts], axis=0)[place]
    np.testing.assert_allclose(total, -2.0 * mass, atol=1e-14 * np.abs(mass).max())


def test_a_blade_in_flat_position_is_held_by_the_propeller_moment() -> None:
    speed, length = 30.0, 0.3

    part = rotating_beam(SECTION, length, speed * cross(UP), np.zeros(3))

    # width in the plane of rotation: ρ Ω² (I_z − I_y) by length, a rigid twist
    inertia = SECTION.inertia_z - SECTION.inertia_y
    found = part.softening[np.ix_([3, 9], [3, 9])].sum()
    assert found == pytest.approx(SECTION.density * speed**2 * inertia * length)


@pytest.mark.parametrize("twist", [0.3, -0.9])
def test_the_moment_on_a_twisted_section_is_that_of_a_body_of_its_shape(
    twist: float,
) -> None:
    turn = Turn.from_rotvec(twist * ALONG).as_matrix()
    spin, length = cross(50.0 * turn.T @ UP), 0.002

    part = rotating_beam(SECTION, length, spin, np.zeros(3))

    volume = SECTION.density * length * np.array([SECTION.inertia_y, SECTION.inertia_z])
    inertia = np.diag([volume.sum(), volume[0], volume[1]])
    body = rotating_body(1.0, inertia, np.zeros(3), spin, np.zeros(3))
    assert part.load[[3, 9]].sum() == pytest.approx(body.load[3], rel=1e-9)
    found = part.softening[np.ix_([3, 9], [3, 9])].sum()
    assert found == pytest.approx(body.softening[3, 3], rel=1e-9)


def test_tension_stiffens_a_string_and_a_twisted_strip() -> None:
    found = tension_stiffness(SECTION, 0.5, np.zeros((3, 3)), np.zeros(3), 40.0)

    turned = np.zeros(12)
    turned[[7, 5, 11]] = 0.5, 1.0, 1.0
    assert turned @ found @ turned == pytest.approx(40.0 * 0.5)
    polar = (SECTION.inertia_y + SECTION.inertia_z) / SECTION.area
    assert found[9, 9] == pytest.approx(40.0 * polar / 0.5)
    assert found[9, 3] == pytest.approx(-found[9, 9])


def cloud(inertia: Array, mass: float) -> tuple[Array, Array]:
    """Return six points and their masses that make a body about its centre."""
    spread = np.trace(inertia) / 2.0 * np.eye(3) - inertia
    sizes, directions = np.linalg.eigh(spread)
    arms = (np.sqrt(3.0 * sizes / mass) * directions).T
    return np.vstack([arms, -arms]), np.full(6, mass / 6.0)


MASS, OFFSET = 0.7, np.array([0.02, -0.03, 0.05])
CENTRE, SPEED = np.array([0.4, 0.2, -0.1]), np.array([30.0, -50.0, 80.0])
TURN = Turn.from_rotvec([0.3, -0.8, 0.5]).as_matrix()
INERTIA = TURN @ np.diag([3e-4, 5e-4, 6e-4]) @ TURN.T


def potential(motion: Array) -> float:
    """Return −½ Σ m |Ω × p|² of a body that moved by any displacement and rotation."""
    arms, masses = cloud(INERTIA, MASS)
    turn = Turn.from_rotvec(motion[3:]).as_matrix()
    places = CENTRE - OFFSET + motion[:3] + (OFFSET + arms) @ turn.T
    return float(-0.5 * masses @ (np.cross(SPEED, places) ** 2).sum(axis=1))


def test_load_and_softening_of_a_body_are_slopes_of_its_potential() -> None:
    part = rotating_body(MASS, INERTIA, OFFSET, cross(SPEED), CENTRE)
    steps = 1e-3 * np.eye(6)

    load = [(potential(-step) - potential(step)) / 2e-3 for step in steps]
    change = np.array(
        [
            potential(one + other)
            - potential(one - other)
            - potential(other - one)
            + potential(-one - other)
            for one in steps
            for other in steps
        ]
    )

    np.testing.assert_allclose(part.load, load, rtol=1e-5, atol=1e-5)
    size = np.abs(part.softening).max()
    np.testing.assert_allclose(
        part.softening, change.reshape(6, 6) / 4e-6, rtol=0, atol=2e-6 * size
    )


def test_coriolis_matrix_of_a_body_is_that_of_its_points() -> None:
    part = rotating_body(MASS, INERTIA, OFFSET, cross(SPEED), CENTRE)
    arms, masses = cloud(INERTIA, MASS)

    wanted = np.zeros((6, 6))
    for arm, mass in zip(arms, masses, strict=True):
        motion = np.hstack([np.eye(3), -cross(OFFSET + arm)])
        wanted += 2.0 * mass * motion.T @ cross(SPEED) @ motion

    np.testing.assert_allclose(part.coriolis, wanted, atol=1e-12)
    np.testing.assert_allclose(part.coriolis, -part.coriolis.T, atol=1e-12)


def leaning(turn: Array) -> RotatingFrame:
    """Return a bent frame with a body, all of it turned in space."""
    places = np.array([[0.0, 0, 0], [0.2, 0.1, 0.0], [0.3, 0.1, 0.2]])
    nodes = tuple(
        Node(name, turn @ place, MOTIONS if name != "a" else ())
        for name, place in zip("abc", places, strict=True)
    )
    beams = (
        Beam("a", "b", SECTION, turn @ np.array([-0.1, 0.2, 0.0])),
        Beam("b", "c", SECTION, turn @ np.array([0.2, 0.0, -0.1])),
    )
    inertia = turn @ INERTIA @ turn.T
    body = RigidBody("c", 0.3, inertia, turn @ np.array([0.32, 0.1, 0.25]))
    spin = Rotation(150.0, turn @ [0.2, 0.3, 1.0], turn @ [-0.4, 0.1, 0.0])
    return RotatingFrame(Frame(nodes, beams, (body,)), spin)


def test_frequencies_do_not_depend_on_the_axes_of_the_description() -> None:
    found, wanted = gyroscopic(leaning(TURN)), gyroscopic(leaning(np.eye(3)))

    np.testing.assert_allclose(found, wanted, rtol=1e-7)


def test_centrifugal_load_is_mass_by_radius_by_the_square_of_the_speed() -> None:
    frame = leaning(np.eye(3)).frame
    spin = Rotation(20.0, UP, np.array([-0.4, 0.1, 0.0]))
    loose = Frame(
        tuple(Node(node.name, node.position) for node in frame.nodes),
        frame.beams,
        frame.bodies,
    )

    load = RotatingFrame(loose, spin).load().reshape(-1, 6)[:, :3].sum(axis=0)

    wanted = 0.3 * (np.array([0.32, 0.1, 0.25]) - spin.centre)
    for beam in frame.beams:
        start, end = (
            frame.nodes[frame.index(name)].position for name in (beam.start, beam.end)
        )
        mass = SECTION.density * SECTION.area * np.linalg.norm(end - start)
        wanted += mass * ((start + end) / 2.0 - spin.centre)
    np.testing.assert_allclose(load, 20.0**2 * wanted * [1.0, 1.0, 0.0], atol=1e-9)


def test_coriolis_forces_hardly_change_the_modes_of_the_rigs_blades() -> None:
    frame = layout.frame(rig(model="B"))
    blades = Frame(
        tuple(node for node in frame.nodes if node.name != layout.ELEMENT),
        frame.beams,
        tuple(body for body in frame.bodies if body.node != layout.ELEMENT),
    )
    spin = Rotation(50.0 * 2.0 * np.pi, UP, np.array([-0.3, 0.0, 0.0]))
    turning = RotatingFrame(blades, spin)

    found, wanted = gyroscopic(turning), gyroscopic(turning, coriolis=False)

    change = np.abs(found[:8] / wanted[:8] - 1.0)
    # two of each: bending along the axis of rotation, then in the plane of rotation
    assert change[:2].max() < 1e-6
    assert 1e-5 < change[2:].max() < 1e-3


@pytest.mark.parametrize(
    ("speed", "axis", "message"),
    [
        (np.nan, UP, "speed nan rad/s: give a finite one"),
        (1.0, np.zeros(3), "axis is zero: give a direction"),
        (1.0, np.ones(2), "axis .*: give three finite numbers"),
    ],
)
def test_an_impossible_rotation_is_refused(
    speed: float, axis: Array, message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{message}$"):
        Rotation(speed, axis, np.zeros(3))
