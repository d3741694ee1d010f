"""Half a period with its symmetry against the whole one."""

import dataclasses

import numpy as np
import pytest
from numpy.typing import NDArray

from hbm.balance.active import extended, moving, symmetric
from hbm.balance.relative import RelativeProblem
from hbm.balance.relative_problem import relative_problem
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.forces.touch_factors import touch_factors
from microslip_mechanics.element import Element
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from sliding import (
    FREQUENCY,
    HARMONICS,
    SAMPLES,
    SPEED,
    TURN,
    motion,
    sliding_point,
)
from small_problems import cubic_oscillator


def rig(
    **overrides: object,
) -> tuple[RelativeProblem, RelativeProblem, NDArray[np.bool_]]:
    """Return a rig by half periods and by whole ones, and what of it moves."""
    problem = rig_problem(**overrides)
    whole = relative_problem(problem, static_equilibrium(problem))
    active = moving(whole, FREQUENCY)
    kept, odd = symmetric(active)
    assert odd is not None
    half = whole.restricted(kept, odd)
    return half, dataclasses.replace(half, odd=None), active[:, kept]


@pytest.mark.parametrize("samples", [64, 65, 66, 256])
@pytest.mark.parametrize("law", ["coulomb", "gkf"])
@pytest.mark.parametrize(
    "model", [pytest.param("A", marks=pytest.mark.kernels), "B", "full"]
)
def test_half_a_period_says_all_of_the_rig(model: str, law: str, samples: int) -> None:
    half, whole, active = rig(model=model, friction__law=law)
    fourier, draw = FourierBasis(HARMONICS, samples), np.random.default_rng(7)
    one, other = half.contact(fourier), whole.contact(fourier)
    moves = extended(active, HARMONICS)

    for size in np.geomspace(1e-7, 1e-3, 20):
        moved = size * draw.standard_normal(moves.shape) * moves
        moved[0] = half.rest * draw.uniform(0.5, 1.5)
        pairs = [[each(moved, FREQUENCY) for each in (one, other)]]
        pairs += [[each.by_frequency() for each in (one, other)]]

        for found, exact in pairs:
            unit = np.abs(exact).max()
            np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-11 * unit)
        for found, exact in zip(
            one.tangents.spectra(HARMONICS),
            other.tangents.spectra(HARMONICS),
            strict=True,
        ):
            unit = np.abs(exact).max()
            np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-10 * unit)
        seen, cycle = (each.cycle(moved, FREQUENCY) for each in (one, other))
        assert seen.friction == pytest.approx(cycle.friction, rel=1e-9)
        for name in ("normal_smallest", "normal_largest"):
            found, exact = getattr(seen, name), getattr(cycle, name)
            unit = np.abs(cycle.normal_largest).max()
            np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-9 * unit)


@pytest.mark.kernels
@pytest.mark.parametrize("share", [-0.9, -0.5, -0.1, 0.1, 0.5])
def test_a_turn_in_the_last_cell_of_half_a_period_is_shared_with_its_first(
    share: float,
) -> None:
    points, basis = sliding_point(1e-3 * SPEED), np.eye(3)[:, 1:2]
    phase = share * TURN / SAMPLES
    moved, fourier = motion(phase)[:, 1:2], FourierBasis(HARMONICS, SAMPLES)

    force, tangents = [], []
    for odd in (np.array([True]), None):
        contact = AlternatingFrequencyTime(points, basis, fourier, odd=odd)
        force.append(contact(moved, FREQUENCY))
        tangents.append(contact.tangents.spectra(2 * HARMONICS)[1])

    np.testing.assert_allclose(force[0], force[1], rtol=0.0, atol=1e-14)
    unit = np.abs(tangents[1]).max()
    np.testing.assert_allclose(tangents[0], tangents[1], rtol=0.0, atol=1e-13 * unit)


@pytest.mark.kernels
def test_a_normal_force_is_never_the_mirror_image_of_its_own() -> None:
    problem = cubic_oscillator()
    whole = relative_problem(problem, static_equilibrium(problem))
    moved = np.array([[0.0], [0.8], [-0.3], [0.0], [0.0], [0.2], [0.1]])

    forces = [
        dataclasses.replace(whole, odd=odd).contact(FourierBasis(3, 64))(moved, 1.0)
        for odd in (np.array([True]), None)
    ]

    np.testing.assert_allclose(forces[0], forces[1], rtol=0.0, atol=1e-14)


def test_faces_that_part_in_half_a_period_part_in_the_other_too() -> None:
    stop = UnilateralSpring(stiffness=1e5, gap=0.3)
    pairs = ("x", "ground"), ("ground", "x")
    made = system(
        mass=[1.0],
        stiffness=[1e3],
        names=("x",),
        elements=[Element(stop, between=pair) for pair in pairs],
        drive={"x": 1.0},
    )
    whole = relative_problem(made, static_equilibrium(made))
    moved = np.array([0.0, 0.8, -0.3, 0.0, 0.0, 0.2, 0.1])[:, None]
    odd, places = np.array([True]), np.array([-1, 0, 0, -1, -1, 0, 0])[:, None]

    touched = []
    for each in (dataclasses.replace(whole, odd=odd), whole):
        contact = each.contact(FourierBasis(3, 64))
        contact(moved, 1.0)
        touched.append(touch_factors(contact, places))

    assert touched[0] is not None
    assert touched[1] is not None
    exact = touched[1].matrix
    atol = 1e-12 * np.abs(exact).max()
    np.testing.assert_allclose(touched[0].matrix, exact, rtol=0.0, atol=atol)
    assert touched[0].left.shape[1] == touched[1].left.shape[1] // 2


def sliders(*friction: float) -> RelativeProblem:
    """Return 1 kg on 1 kN/m, driven, on so many rough planes under 1 N each."""
    laws = [
        RegularisedCoulomb(mu=mu, load=1.0, threshold_velocity=1e-3) for mu in friction
    ]
    made = system(
        mass=[1.0],
        stiffness=[1e3],
        names=("x",),
        elements=[Element(law, tangents=[("x", "ground")]) for law in laws],
        drive={"x": (1.0, 0.0)},
    )
    whole = relative_problem(made, static_equilibrium(made))
    kept, odd = symmetric(moving(whole, FREQUENCY))
    assert odd is not None
    return whole.restricted(kept, odd)


@pytest.mark.kernels
@pytest.mark.parametrize("friction", [(0.1, 0.4), (0.4, 0.1)])
def test_a_point_of_another_law_is_no_mirror_image(
    friction: tuple[float, float],
) -> None:
    half = sliders(*friction)
    fourier = FourierBasis(3, 64)
    moved = np.array([[0.0], [1e-3], [-2e-3], [0.0], [0.0], [0.0], [0.0]])

    contacts = [
        half.contact(fourier),
        sliders(0.3, 0.3).contact(fourier).with_points(half.points, half.offset),
        dataclasses.replace(half, odd=None).contact(fourier),
    ]
    forces = [each(moved, FREQUENCY) for each in contacts]

    unit = np.abs(forces[-1]).max()
    for force in forces[:-1]:
        np.testing.assert_allclose(force, forces[-1], rtol=0.0, atol=1e-12 * unit)


@pytest.mark.kernels
def test_a_mirror_image_that_becomes_another_is_one_no_more() -> None:
    half, _, active = rig(model="full")
    fourier, draw = FourierBasis(HARMONICS, 64), np.random.default_rng(3)
    moves = extended(active, HARMONICS)
    moved = 1e-4 * draw.standard_normal(moves.shape) * moves
    dynamic = half.points.dynamic * np.linspace(1.0, 2.0, half.points.dynamic.size)
    other = dataclasses.replace(half, points=half.points._replace(dynamic=dynamic))

    found = half.contact(fourier).with_points(other.points, other.offset)
    whole = dataclasses.replace(other, odd=None).contact(fourier)

    expected = whole(moved, FREQUENCY)
    unit = np.abs(expected).max()
    np.testing.assert_allclose(
        found(moved, FREQUENCY), expected, rtol=0.0, atol=1e-11 * unit
    )
