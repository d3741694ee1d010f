"""What a symmetry keeps at zero, and what is solved for instead."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from contact_tables import contact_points
from hbm.balance.active import extended, moving, symmetric
from hbm.balance.relative import RelativeProblem
from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.continuation.corrected import correct_at
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import NORMAL, TANGENT, mass_on_contact, oscillator, sliding_block

HARMONICS, FREQUENCY = 4, 2.0 * np.pi * 134.0
FOURIER = FourierBasis(HARMONICS, 256)


def relative(problem: Problem) -> RelativeProblem:
    return relative_problem(problem, static_equilibrium(problem))


def rig(**overrides: object) -> tuple[RelativeProblem, NDArray[np.bool_]]:
    """Return a rig and what moves of it up to :data:`HARMONICS`."""
    problem = relative(rig_problem(**overrides))
    return problem, extended(moving(problem, FREQUENCY), HARMONICS)


def solved(balance: HarmonicBalance) -> Array:
    """Return a point on the curve of a rig."""
    guess = balance.point(balance.problem.rest[None], FREQUENCY)
    return correct_at(balance, guess, StepControl()).point


def axial(problem: RelativeProblem) -> NDArray[np.bool_]:
    """Return which relative coordinates move along z."""
    names = rig_problem().structure.names
    along = np.array([".uz" in n or ".rx" in n or ".ry" in n for n in names])
    share = np.abs(problem.selection[:, along]).sum(axis=1)
    moves: NDArray[np.bool_] = share > 1e-9
    return moves


def test_on_the_rig_axial_motion_is_odd_and_all_other_motion_even() -> None:
    problem, active = rig()

    along = axial(problem)
    assert 0 < along.sum() < problem.rank
    for order in range(1, HARMONICS + 1):
        expected = along if order % 2 else ~along
        np.testing.assert_array_equal(active[2 * order - 1], expected)
        np.testing.assert_array_equal(active[2 * order], expected)
    np.testing.assert_array_equal(active[0], ~along)


@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_rounding_next_to_a_resonance_moves_nothing(model: str) -> None:
    problem = relative(rig_problem(model=model))

    # alone, the blades resonate at 135 Hz
    found = [moving(problem, 2.0 * np.pi * hertz) for hertz in (125.0, 135.0, 135.05)]

    np.testing.assert_array_equal(found[1], found[0])
    np.testing.assert_array_equal(found[2], found[0])


@pytest.mark.parametrize("law", ["coulomb", "gkf"])
@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_what_is_left_out_is_zero_in_the_solution(model: str, law: str) -> None:
    problem, active = rig(model=model, friction__law=law)
    balance = HarmonicBalance(problem, FOURIER)

    coefficients, _ = balance.split(solved(balance))

    coefficients[0] -= problem.rest
    assert not active.all()
    # Rounding, measured 1e-16; means within the corrector's tolerance, measured 4e-7.
    size = np.abs(coefficients[1:]).max()
    assert np.abs(coefficients[1:][~active[1:]]).max() < 1e-11 * size
    assert np.abs(coefficients[0, ~active[0]]).max() < 1e-5 * size


@pytest.mark.parametrize("model", ["A", "full"])
def test_a_restricted_point_solves_the_whole_system_too(model: str) -> None:
    problem, active = rig(model=model)
    balance = HarmonicBalance(problem, FOURIER, active)

    point = solved(balance)

    whole = HarmonicBalance(problem, FOURIER)
    residual, _ = whole(whole.point(*balance.split(point)))
    assert np.abs(residual).max() <= 1.01 * StepControl().tolerance


def test_a_problem_of_what_moves_has_the_solution_of_the_whole() -> None:
    problem, active = rig()
    kept, odd = symmetric(moving(problem, FREQUENCY))
    part = problem.restricted(kept, odd)

    few = HarmonicBalance(part, FOURIER, active[:, kept])
    whole = HarmonicBalance(problem, FOURIER)
    found, expected = few.motion(solved(few)), whole.motion(solved(whole))

    assert part.rank < problem.rank or odd is not None
    size = np.abs(expected[1:]).max()
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6 * size)


def test_restricted_residual_and_jacobian_are_parts_of_the_whole_ones() -> None:
    problem, active = rig(model="B")
    whole = HarmonicBalance(problem, FOURIER)
    part = HarmonicBalance(problem, FOURIER, active)
    point = solved(whole) * 1.001
    point[:-1] = part.split(point)[0].ravel()
    chosen = np.flatnonzero(active)

    residual, linearised = part(point)

    whole_residual, whole_linearised = whole(point)
    np.testing.assert_array_equal(residual[chosen], whole_residual[chosen])
    assert not residual[~active.ravel()].any()
    np.testing.assert_array_equal(
        linearised.jacobian, whole_linearised.jacobian[np.ix_(chosen, chosen)]
    )
    np.testing.assert_array_equal(linearised.slope, whole_linearised.slope[chosen])


def test_sliding_friction_has_odd_harmonics_only() -> None:
    active = moving(relative(sliding_block(drive=1.0)), 3.0)

    assert active[:, 0].tolist() == [False, *([True] * 2 + [False] * 2) * 2, True, True]
    kept, odd = symmetric(active)
    assert kept.tolist() == [0]
    assert odd is not None
    assert odd.tolist() == [True]


def test_a_mean_that_does_not_change_is_that_at_rest() -> None:
    # The block is pushed to one side; its friction does not depend on where it is.
    points = contact_points(constant_load=True, stiffness=0.0, damping=0.0)
    problem = relative(
        mass_on_contact(
            points, direction=TANGENT, stiffness=300.0, preload=1.5, drive=1.0
        )
    )
    active = extended(moving(problem, 3.0), HARMONICS)
    balance = HarmonicBalance(problem, FOURIER, active)

    motion = balance.motion(solved(balance))

    assert not active[0].any()
    assert motion[0, 0] == pytest.approx(1.5 / 300.0, rel=1e-12)


def test_a_contact_that_may_open_has_all_harmonics() -> None:
    problem = mass_on_contact(
        contact_points(friction=0), direction=NORMAL, preload=1.0, drive=0.1
    )

    active = moving(relative(problem), 3.0)

    assert active.all()
    assert symmetric(active)[1] is None


def test_nothing_moves_without_a_drive() -> None:
    active = moving(relative(rig_problem(excitation__force=0.0)), FREQUENCY)

    assert not active[1:].any()


def test_without_contact_there_is_nothing_to_solve_for() -> None:
    kept, odd = symmetric(moving(relative(oscillator()), 3.0))

    assert kept.size == 0
    assert odd is None or odd.size == 0


def test_more_harmonics_go_on_as_the_first_ones() -> None:
    active = np.zeros((11, 3), dtype=bool)
    active[1::4, 0] = active[2::4, 0] = True
    active[0, 1] = active[3::4, 1] = active[4::4, 1] = True
    active[:, 2] = True

    more = extended(active, 7)

    odd_rows = [False, *[True, True, False, False] * 3, True, True]
    assert more.shape == (15, 3)
    assert more[:, 0].tolist() == odd_rows
    assert more[:, 1].tolist() == [not each for each in odd_rows]
    assert more[:, 2].all()


@pytest.mark.parametrize("model", ["A", "full"])
def test_tangents_that_are_zero_change_nothing(model: str) -> None:
    problem, _ = rig(model=model)
    some = HarmonicBalance(problem, FOURIER)
    every = HarmonicBalance(replace(problem, pruned=False), FOURIER)
    point = solved(some) * 1.001

    residual, linearised = some(point)
    other, whole = every(point)

    few, many = (len(each.contact.tangents.samples) for each in (some, every))
    assert few < many == 18 * len(problem.points.load)
    np.testing.assert_array_equal(residual, other)
    size = np.abs(linearised.jacobian).max()
    np.testing.assert_allclose(
        whole.jacobian, linearised.jacobian, rtol=0.0, atol=1e-13 * size
    )


def test_a_path_that_is_not_pruned_has_all_coordinates_and_orders() -> None:
    problem = rig_problem(model="A")
    rest = static_equilibrium(problem)

    some, every = (
        along_frequency(problem, rest, FREQUENCY, 1.1 * FREQUENCY, pruned=pruned)
        for pruned in (True, False)
    )

    assert every.mask(HARMONICS).all()
    assert every.rank == relative(problem).rank > some.rank
    assert every.problem.odd is None
