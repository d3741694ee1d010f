"""Coriolis forces: harmonic balance, time, direct solutions and poles agree."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from hbm.forces.fourier import to_complex
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.structure.condensation import condense
from hbm.structure.poles import poles
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import TWO_SIDED, PointLaw, contact_table
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import MOTIONS, Beam, Frame, Node
from microslip_mechanics.structures.rotating_frame import RotatingFrame
from microslip_mechanics.structures.rotation import Rotation
from microslip_mechanics.system import system
from small_motions.multipliers import floquet_multipliers
from small_problems import dwelled, last_harmonic
from timedomain.record.start import Start

SPEED = 60.0
"""of the shaft [rad/s]: three tenths of its first frequency at rest"""
STILL, TURNING = 0.0, SPEED


def shaft(speed: float, *, cubic: float, sprung: tuple[int, ...] = (1, 2)) -> Problem:
    """Return a square shaft in axes that turn with it, with springs at its tip.

    It is clamped, driven along y, and sprung along y and z or one of them; without
    rotation nothing would move along z.
    """
    section = RectangularSection(0.01, 0.01, 2.1e11, 0.3, 7800.0)
    nodes = tuple(
        Node(name, np.array([place, 0.0, 0.0]), free)
        for name, place, free in (
            ("a", 0.0, ()),
            ("b", 0.25, MOTIONS),
            ("c", 0.5, MOTIONS),
        )
    )
    beams = tuple(
        Beam(start, end, section, np.array([0.0, 0.0, 1.0]), 6.0, 2e-5)
        for start, end in ("ab", "bc")
    )
    frame = Frame(nodes, beams)
    spin = Rotation(speed, np.array([1.0, 0.0, 0.0]), np.zeros(3))
    structure = RotatingFrame(frame, spin).structure()
    tip = frame.motion("c", nodes[2].position)
    seen = np.zeros((3 * len(sprung), structure.dofs))
    seen[::3] = tip[list(sprung)]
    law = PointLaw(normal=TWO_SIDED, stiffness=cubic, exponent=3.0)
    return Problem(
        structure,
        Interface(contact_table([law for _ in sprung]), seen, tuple(map(str, sprung))),
        np.zeros(structure.dofs),
        3.0 * tip[1],
        Probes(("y", "z"), tip[1:]),
    )


def curve(problem: Problem, lowest: float, highest: float) -> list[PeriodicResponse]:
    options = CurveOptions(lowest, highest, harmonics=7, samples=128)
    rest = static_equilibrium(problem)
    return list(frequency_response(problem, rest, options))


def test_condensed_stiffness_and_motion_are_those_of_a_direct_solution() -> None:
    problem = shaft(SPEED, cubic=1e6)
    structure = problem.structure
    _, selection = problem.interface.relative_motion()
    condensed = condense(problem, selection)
    variable = 1j * np.array([90.0, 200.0, 2300.0])

    stiffness = condensed.dynamic_stiffness(variable)

    force = np.tile(problem.drive.astype(complex), (variable.size, 1))
    load, _ = condensed.loading(force)(variable)
    for place, s in enumerate(variable):
        dynamic = structure.stiffness + s * structure.damping + s**2 * structure.mass
        compliance = selection @ np.linalg.solve(dynamic, selection.T.astype(complex))
        exact = np.linalg.inv(compliance)
        size = np.abs(exact).max()
        np.testing.assert_allclose(stiffness[place], exact, atol=1e-8 * size)
        assert np.abs(exact - exact.T).max() > 1e-3 * size
        moved = np.linalg.solve(dynamic, problem.drive)
        np.testing.assert_allclose(
            np.linalg.solve(stiffness[place], load[place]),
            selection @ moved,
            atol=1e-8 * np.abs(selection @ moved).max(),
        )
    nudge = 1e-3j
    ahead = condensed.dynamic_stiffness(variable + nudge)
    behind = condensed.dynamic_stiffness(variable - nudge)
    slope = (ahead - behind) / (2.0 * nudge)
    for direction in np.eye(len(selection), dtype=complex):
        change = condensed.slope(variable, np.tile(direction, (variable.size, 1)))
        expected = slope @ direction
        np.testing.assert_allclose(change, expected, atol=1e-5 * np.abs(slope).max())


def test_poles_of_the_shaft_are_its_frequencies_at_rest_plus_and_minus_the_speed() -> (
    None
):
    still = poles(shaft(STILL, cubic=0.0).structure).values
    turning = poles(shaft(TURNING, cubic=0.0).structure).values

    first = np.sort(still.imag[still.imag > 0.0])[0]
    for wanted in (first - SPEED, first + SPEED):
        # damping by mass and stiffness shifts a frequency by its square
        assert np.abs(turning.imag - wanted).min() < 1e-3 * wanted


@pytest.mark.parametrize("target", [140.0, 150.0, 272.0])
def test_a_march_stays_on_the_orbit_of_harmonic_balance(target: float) -> None:
    problem = shaft(SPEED, cubic=4e8)
    points = curve(problem, target, target + 4.0)
    point = points[len(points) // 2]
    predicted = np.abs(problem.probes.rows @ to_complex(point.coefficients)[1])
    displacement, velocity = point.at(np.zeros(1))

    history = dwelled(
        problem,
        point.frequency,
        periods=40,
        steps=400,
        start=Start(displacement[0], velocity[0]),
    )

    marched = np.abs(last_harmonic(history))
    # the Coriolis force brings z into motion that nothing else drives
    assert predicted[1] > 0.3 * predicted[0]
    np.testing.assert_allclose(marched, predicted, rtol=5e-3)


@pytest.mark.parametrize("sprung", [(1, 2), (1,)])
def test_multipliers_are_those_of_the_time_domain(sprung: tuple[int, ...]) -> None:
    problem = shaft(SPEED, cubic=4e8, sprung=sprung)

    for point in curve(problem, 120.0, 160.0)[::12]:
        other = floquet_multipliers(problem, point, steps=512)
        np.testing.assert_allclose(
            np.abs(point.multipliers[:4]), np.abs(other.values[:4]), atol=1e-3
        )


def blade(lag: str) -> Problem:
    """Return a turning blade, whose axial modes reach 1 MHz, at a stop it never meets.

    ``lag`` is the motion along which the stop is.
    """
    section = RectangularSection(0.02, 0.005, 2.1e11, 0.3, 7800.0)
    places = np.linspace(0.0, 0.2, 7)
    names = ["foot", *(f"node{number}" for number in range(1, 6)), "tip"]
    nodes = tuple(
        Node(name, np.array([place, 0.0, 0.0]), MOTIONS if place else ())
        for name, place in zip(names, places, strict=True)
    )
    across = np.array([0.0, 0.0, 1.0])
    beams = tuple(
        Beam(start, end, section, across) for start, end in itertools.pairwise(names)
    )
    spin = Rotation(628.3, np.array([0.0, 0.0, 1.0]), np.array([-0.1, 0.0, 0.0]))
    turned = RotatingFrame(Frame(nodes, beams), spin)
    shape = turned.structure()
    stop = UnilateralSpring(stiffness=5e3, gap=1.0)
    made = system(
        names=shape.names,
        mass=shape.mass,
        stiffness=shape.stiffness,
        damping_ratio=0.01,
        elements=[Element(stop, between=(lag, "ground"), name="stop")] if lag else [],
        drive={"tip.uy": 1.0},
        probes=["tip.uy"],
    )
    damping = made.structure.damping + turned.coriolis()
    structure = replace(made.structure, damping=damping, gyroscopic=True)
    return replace(made, structure=structure)


@pytest.mark.parametrize("lag", ["", "tip.uy", "tip.uz"])
def test_multipliers_of_a_linear_blade_are_those_of_its_poles(lag: str) -> None:
    """What is too fast for the steps of a period does not stand for what is slow."""
    problem = blade(lag)
    slowest = poles(problem.structure).values.real.max()

    for point in curve(problem, 300.0, 600.0)[::8]:
        exact = np.exp(2.0 * np.pi * slowest / point.frequency)
        assert abs(point.multipliers[0]) == pytest.approx(exact, rel=1e-5)
