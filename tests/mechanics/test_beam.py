"""Beam elements, assembled by Frame, against closed forms of the continuous beam."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq
from scipy.special import zeta

from convergence import observed_order
from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection, beam_matrices
from microslip_mechanics.structures.frame import MOTIONS, Beam, Frame, Node, RigidBody

SECTION = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
LENGTH = 0.2075
TIP_MASS = 0.076
TIP_INERTIA = (1.3991e-5, 4.5917e-6, 1.0666e-5)
OFFSET = 0.005
"""the tip body's centre of mass beyond the tip [m]"""
UPRIGHT = np.eye(3)

ALONG_Z, ALONG_Y, TORSION, AXIAL = ("uz", "ry"), ("uy", "rz"), ("rx",), ("ux",)


def clamped_frame(elements: int, axes: Array = UPRIGHT) -> Frame:
    """Return a clamped beam with a tip body; rows of ``axes`` are its local axes."""
    places = np.outer(np.linspace(0.0, LENGTH, elements + 1), axes[0])
    nodes = tuple(
        Node(f"{k}", place, MOTIONS if k else ()) for k, place in enumerate(places)
    )
    beams = tuple(Beam(f"{k}", f"{k + 1}", SECTION, axes[2]) for k in range(elements))
    inertia = axes.T @ np.diag(TIP_INERTIA) @ axes
    centre = (LENGTH + OFFSET) * axes[0]
    return Frame(nodes, beams, (RigidBody(f"{elements}", TIP_MASS, inertia, centre),))


def frequencies(frame: Frame, motions: tuple[str, ...] = MOTIONS) -> Array:
    """Return the angular frequencies [rad/s] with all motions but these locked."""
    structure = frame.structure()
    kept = [name.split(".")[1] in motions for name in structure.names]
    place = np.ix_(kept, kept)
    squares = eigh(structure.stiffness[place], structure.mass[place], eigvals_only=True)
    return np.sqrt(squares)


def bending(inertia: float, tip_inertia: float) -> Callable[[float], float]:
    """Return the frequency equation of w = A (cosh − cos) + B (sinh − sin)."""
    rigidity = SECTION.young_modulus * inertia
    line_mass = SECTION.density * SECTION.area

    def equation(frequency: float) -> float:
        number = (line_mass * frequency**2 / rigidity) ** 0.25
        x = number * LENGTH
        even, odd = (np.cosh(x), np.cos(x)), (np.sinh(x), np.sin(x))
        shape = np.array([even[0] - even[1], odd[0] - odd[1]])
        slope = number * np.array([odd[0] + odd[1], even[0] - even[1]])
        moment = rigidity * number**2 * np.array([sum(even), sum(odd)])
        shear = rigidity * number**3 * np.array([odd[0] - odd[1], sum(even)])
        push = TIP_MASS * frequency**2 * (shape + OFFSET * slope)
        turn = tip_inertia * frequency**2 * slope + OFFSET * push
        ends = np.array([moment - turn, shear + push])
        return float(np.linalg.det(ends / np.cosh(x)))

    return equation


def rod(rigidity: float, line_inertia: float, tip: float) -> Callable[[float], float]:
    """Return the frequency equation of sin(kx), clamped, with an inertia at the tip."""

    def equation(frequency: float) -> float:
        number = frequency * np.sqrt(line_inertia / rigidity)
        x = number * LENGTH
        return float(rigidity * number * np.cos(x) - frequency**2 * tip * np.sin(x))

    return equation


EQUATIONS = {
    ALONG_Z: bending(SECTION.inertia_y, TIP_INERTIA[1]),
    ALONG_Y: bending(SECTION.inertia_z, TIP_INERTIA[2]),
    TORSION: rod(
        SECTION.shear_modulus * SECTION.torsion_constant,
        SECTION.density * (SECTION.inertia_y + SECTION.inertia_z),
        TIP_INERTIA[0],
    ),
    AXIAL: rod(
        SECTION.young_modulus * SECTION.area, SECTION.density * SECTION.area, TIP_MASS
    ),
}


def exact_frequency(motions: tuple[str, ...], mode: int) -> float:
    """Return a root of the frequency equation [rad/s]."""
    equation = EQUATIONS[motions]
    grid = np.linspace(100.0, 1.5e5, 1500)
    values = np.array([equation(frequency) for frequency in grid])
    left = np.flatnonzero(values[:-1] * values[1:] < 0.0)[mode]
    return float(brentq(equation, grid[left], grid[left + 1], rtol=1e-14))


@pytest.mark.parametrize(
    ("motions", "mode", "order", "smallest"),
    [
        (ALONG_Z, 0, 4.0, 5e-8),
        (ALONG_Z, 1, 4.0, 5e-6),
        (ALONG_Y, 0, 4.0, 5e-8),
        (ALONG_Y, 1, 4.0, 5e-6),
        (TORSION, 0, 2.0, 5e-5),
        (TORSION, 1, 2.0, 3e-3),
        (AXIAL, 0, 2.0, 3e-4),
        (AXIAL, 1, 2.0, 3e-3),
    ],
)
def test_frequencies_of_a_blade_converge_to_the_continuous_beam_with_their_order(
    motions: tuple[str, ...], mode: int, order: float, smallest: float
) -> None:
    exact = exact_frequency(motions, mode)
    counts = (4, 8, 16)

    errors = [
        frequencies(clamped_frame(count), motions)[mode] / exact - 1.0
        for count in counts
    ]

    # consistent masses bound the frequencies from above
    assert min(errors) > 0.0
    assert observed_order([LENGTH / count for count in counts], errors) == (
        pytest.approx(order, abs=0.05)
    )
    assert errors[-1] < smallest


@pytest.mark.parametrize("motions", [ALONG_Z, ALONG_Y])
def test_four_elements_suffice_for_the_first_bending_mode(
    motions: tuple[str, ...],
) -> None:
    exact = exact_frequency(motions, 0)

    error = frequencies(clamped_frame(4), motions)[0] / exact - 1.0

    assert abs(error) < 1e-5


def test_a_straight_blade_bends_twists_and_stretches_independently() -> None:
    frame = clamped_frame(3)

    together = frequencies(frame)

    alone = [frequencies(frame, motions) for motions in EQUATIONS]
    np.testing.assert_allclose(together, np.sort(np.concatenate(alone)), rtol=1e-10)


@pytest.mark.parametrize("seed", range(3))
def test_inclined_blade_has_the_frequencies_of_the_upright_one(seed: int) -> None:
    axes, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    axes *= np.linalg.det(axes)

    inclined = frequencies(clamped_frame(4, axes))

    np.testing.assert_allclose(inclined, frequencies(clamped_frame(4)), rtol=1e-10)


@pytest.mark.parametrize("size", [0.1, 7.0])
def test_only_the_direction_of_the_thickness_matters(size: float) -> None:
    frame = clamped_frame(2)
    beams = tuple(
        replace(beam, thickness_direction=size * beam.thickness_direction)
        for beam in frame.beams
    )

    scaled = replace(frame, beams=beams).structure()

    original = frame.structure()
    np.testing.assert_allclose(scaled.stiffness, original.stiffness, rtol=1e-14)
    np.testing.assert_allclose(scaled.mass, original.mass, rtol=1e-14)


def test_static_tip_deflection_is_exact_with_any_number_of_elements() -> None:
    frame = clamped_frame(3)
    structure = frame.structure()
    tip = [structure.names.index(f"3.{motion}") for motion in MOTIONS]

    compliance = np.linalg.inv(structure.stiffness)[np.ix_(tip, tip)]

    bend_z = SECTION.young_modulus * SECTION.inertia_y
    bend_y = SECTION.young_modulus * SECTION.inertia_z
    expected = np.diag(
        [
            LENGTH / (SECTION.young_modulus * SECTION.area),
            LENGTH**3 / (3.0 * bend_y),
            LENGTH**3 / (3.0 * bend_z),
            LENGTH / (SECTION.shear_modulus * SECTION.torsion_constant),
            LENGTH / bend_z,
            LENGTH / bend_y,
        ]
    )
    expected[1, 5] = expected[5, 1] = LENGTH**2 / (2.0 * bend_y)
    expected[2, 4] = expected[4, 2] = -(LENGTH**2) / (2.0 * bend_z)
    np.testing.assert_allclose(compliance, expected, rtol=1e-12, atol=1e-18)


def test_element_leaves_rigid_motions_without_force_and_with_its_mass() -> None:
    stiffness, mass = beam_matrices(SECTION, LENGTH)
    rigid = np.zeros((12, 6))
    rigid[:6], rigid[6:] = np.eye(6), np.eye(6)
    rigid[7, 5], rigid[8, 4] = LENGTH, -LENGTH  # the end follows a turn of the start

    force, inertia = stiffness @ rigid, rigid.T @ mass @ rigid

    total = SECTION.density * SECTION.area * LENGTH
    np.testing.assert_allclose(force / np.abs(stiffness).max(), 0.0, atol=1e-15)
    np.testing.assert_allclose(np.diag(inertia)[:3], total, rtol=1e-14)
    np.testing.assert_allclose(
        np.diag(inertia)[4:], total * LENGTH**2 / 3.0, rtol=1e-14
    )
    assert inertia[1, 5] == pytest.approx(total * LENGTH / 2.0, rel=1e-14, abs=0.0)
    assert inertia[2, 4] == pytest.approx(-total * LENGTH / 2.0, rel=1e-14, abs=0.0)


def test_section_has_the_properties_of_a_steel_rectangle() -> None:
    properties = (
        SECTION.area,
        SECTION.inertia_y,
        SECTION.inertia_z,
        SECTION.shear_modulus,
    )

    # 20 mm along y, 10 mm along z; G = E/2.6
    expected = (2e-4, 2e-8 / 12.0, 8e-8 / 12.0, 8.076923076923077e10)
    assert properties == pytest.approx(expected, rel=1e-14, abs=0.0)


@pytest.mark.parametrize(
    ("ratio", "factor"),
    [(1.0, 0.1406), (1.2, 0.166), (1.5, 0.196), (2.0, 0.229), (3.0, 0.263),
     (4.0, 0.281), (5.0, 0.291)],
)  # fmt: skip
def test_torsion_constant_is_that_of_timoshenko_and_goodiers_table(
    ratio: float, factor: float
) -> None:
    section = replace(SECTION, width=ratio * 0.01, thickness=0.01)

    constant = section.torsion_constant

    digit = 1e-4 if ratio == 1.0 else 1e-3  # half of the last printed one
    assert constant / (ratio * 0.01**4) == pytest.approx(factor, abs=digit / 2.0)


@pytest.mark.parametrize("ratio", [10.0, 100.0, 1e4])
def test_torsion_constant_of_a_strip_is_that_of_a_thin_one_less_its_two_ends(
    ratio: float,
) -> None:
    section = replace(SECTION, width=ratio * 0.001, thickness=0.001)

    constant = section.torsion_constant

    # b t³/3, and at the ends 0.63 t of the width is lost
    ends = 192.0 / np.pi**5 * 31.0 / 32.0 * zeta(5.0) / ratio
    assert constant == pytest.approx(
        ratio * 0.001**4 / 3.0 * (1.0 - ends), rel=1e-7 / ratio, abs=0.0
    )


def test_torsion_constant_does_not_ask_which_side_is_the_long_one() -> None:
    turned = replace(SECTION, width=SECTION.thickness, thickness=SECTION.width)

    assert turned.torsion_constant == SECTION.torsion_constant
