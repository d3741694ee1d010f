"""Poles against closed forms, and columns that keep their mode where modes cross."""

import numpy as np
import pytest

import microslip
from hbm.balance.relative_problem import relative_problem
from hbm.modes.linear_modes import linear_modes
from hbm.structure.poles import damping_ratios, followed, frequencies, poles
from microslip_mechanics.static import StaticState
from microslip_mechanics.structures.structure import Structure
from rigs import rig_problem
from small_problems import cantilever, oscillator


def diagonal(*modes: tuple[float, float]) -> Structure:
    """Return independent unit masses of given natural frequency [rad/s] and ratio."""
    frequency, ratio = np.array(modes).T
    names = tuple(f"{place}" for place in range(len(modes)))
    return Structure(
        np.eye(len(modes)),
        np.diag(2.0 * ratio * frequency),
        np.diag(frequency**2),
        names,
    )


def test_an_oscillator_has_the_pole_of_the_textbook() -> None:
    found = poles(oscillator(mass=2.0, damping=0.5, stiffness=300.0).structure)

    natural, ratio = np.sqrt(150.0), 0.5 / (2.0 * np.sqrt(600.0))
    expected = natural * (-ratio + 1j * np.sqrt(1.0 - ratio**2))
    np.testing.assert_allclose(found.values, [expected], rtol=1e-13)
    assert damping_ratios(found.values)[0] == pytest.approx(ratio, rel=1e-12)
    assert frequencies(found.values)[0] == pytest.approx(expected.imag / 2.0 / np.pi)


def test_a_strongly_damped_oscillator_has_two_real_poles() -> None:
    found = poles(diagonal((10.0, 1.25))).values

    np.testing.assert_allclose(found, [-20.0, -5.0], rtol=1e-12)
    np.testing.assert_allclose(damping_ratios(found), 1.0)


def test_negative_stiffness_grows() -> None:
    one = np.eye(1)

    found = poles(Structure(one, 3.0 * one, -4.0 * one, ("x",))).values

    np.testing.assert_allclose(found, [-4.0, 1.0], rtol=1e-12)


def test_dashpots_couple_a_mode_that_stiffness_pushes_away() -> None:
    problem = microslip.system(
        mass=[1.0, 1.0],
        stiffness=[[-5.0, 20.0], [20.0, 100.0]],
        damping=[[2.0, -2.0], [-2.0, 3.0]],
        elements=[
            microslip.Element(
                microslip.CubicSpring(cubic=1.0), between=("x1", "ground")
            )
        ],
        drive={"x2": 1.0},
    )

    values = poles(problem.structure).values
    hilltop = StaticState(np.zeros(2), np.zeros(1), 0.0, 0)
    relative = relative_problem(problem, hilltop)
    (mode,) = linear_modes(problem, relative, 1.0, 100.0)

    # det(s² + s C + K), by hand
    one, other, coupling = [1.0, 2.0, -5.0], [1.0, 3.0, 100.0], [-2.0, 20.0]
    determinant = np.polymul(one, other)
    expected = np.roots(np.polysub(determinant, np.polymul(coupling, coupling)))
    kept = expected[expected.imag >= 0.0]
    np.testing.assert_allclose(np.sort(values), np.sort(kept), rtol=1e-12)
    assert mode.pole == pytest.approx(kept[kept.imag > 0.0][0], rel=1e-12)


def test_proportional_damping_is_that_of_each_mode() -> None:
    structure = cantilever(mass_damping=20.0, stiffness_damping=2e-5).structure

    found = poles(structure).values

    size = np.abs(found)
    ratio = 0.5 * (20.0 / size + 2e-5 * size)
    oscillating = found.imag > 0.0
    np.testing.assert_allclose(
        damping_ratios(found)[oscillating], ratio[oscillating], rtol=1e-7
    )
    assert 30.0 < frequencies(found)[oscillating][0] < 36.0


def test_values_and_shapes_solve_the_equation_of_motion() -> None:
    structure = rig_problem().structure

    found = poles(structure)

    inertia = structure.mass @ found.shapes * found.values**2
    viscous = structure.damping @ found.shapes * found.values
    elastic = structure.stiffness @ found.shapes
    size = np.abs(inertia).max(axis=0) + np.abs(elastic).max(axis=0)
    moves = np.abs(found.values) > 1.0
    wrong = np.abs(inertia + viscous + elastic).max(axis=0) / np.maximum(size, 1e-9)
    assert wrong[moves].max() < 1e-7
    masses = np.einsum("ij,ij->j", found.shapes.conj(), structure.mass @ found.shapes)
    np.testing.assert_allclose(masses, 1.0, rtol=1e-9)


def test_columns_keep_their_mode_where_frequencies_cross() -> None:
    rising = [diagonal((10.0 + step, 0.01), (15.0, 0.02)) for step in range(0, 11, 2)]

    table = followed(rising)

    assert table.shape == (6, 2)
    np.testing.assert_allclose(np.abs(table[:, 0]), 10.0 + np.arange(0, 11, 2))
    np.testing.assert_allclose(np.abs(table[:, 1]), 15.0)


def test_shapes_decide_where_values_alone_would_mislead() -> None:
    table = followed(
        [diagonal((10.0, 0.01), (15.0, 0.01)), diagonal((21.0, 0.01), (8.0, 0.01))]
    )

    np.testing.assert_allclose(np.abs(table[1]), [21.0, 8.0])


def test_modes_that_exchange_their_shapes_do_not_jump() -> None:
    # Two coupled pendula: frequencies veer, and shapes turn by a right angle.
    def pendula(detuning: float) -> Structure:
        stiffness = np.array([[1000.0 + detuning, -40.0], [-40.0, 1000.0 - detuning]])
        return Structure(np.eye(2), 0.01 * np.eye(2), stiffness, ("one", "other"))

    table = followed([pendula(-400.0), pendula(400.0)])

    np.testing.assert_allclose(table[0], table[1], rtol=1e-9)
    assert table[0, 0].imag < table[0, 1].imag


def test_a_pair_that_stops_oscillating_goes_on_as_a_real_pole_and_comes_back() -> None:
    ratios = (0.9, 1.1, 0.9)

    table = followed([diagonal((10.0, ratio), (50.0, 0.01)) for ratio in ratios])

    assert table.shape == (3, 3)
    assert (table[:, 0].imag == 0.0).tolist() == [False, True, False]
    assert np.isnan(table[:, 2]).tolist() == [True, False, True]
    product = table[1, 0] * table[1, 2]
    assert product.real == pytest.approx(100.0)
    np.testing.assert_allclose(np.abs(table[:, 1]), 50.0)


def test_structures_of_other_size_are_matched_by_their_values() -> None:
    small = diagonal((10.0, 0.01), (20.0, 0.01))
    large = diagonal((5.0, 0.01), (10.1, 0.01), (19.9, 0.01))

    table = followed([small, large])

    np.testing.assert_allclose(np.abs(table[1]), [10.1, 19.9, 5.0])
    assert np.isnan(table[0, 2])
