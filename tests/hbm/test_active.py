"""What a symmetry keeps at zero, and what is solved for instead."""

import numpy as np
import pytest
from numpy.typing import NDArray

from hbm.active import ActiveUnknowns, moving
from hbm.continuation import StepControl, correct_at
from hbm.fourier import FourierBasis
from hbm.residual import HarmonicBalance
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

HARMONICS, FREQUENCY = 4, 2.0 * np.pi * 134.0


def solved(**overrides: object) -> tuple[HarmonicBalance, Array]:
    """Return a rig's balance and a point on its curve."""
    problem = rig_problem(**overrides)
    rest = static_equilibrium(problem)
    balance = HarmonicBalance(problem, rest, FourierBasis(HARMONICS, 256))
    still = np.zeros((2 * HARMONICS + 1, problem.structure.dofs))
    still[0] = rest.displacement
    guess = balance.point(still, FREQUENCY)
    return balance, correct_at(balance, guess, StepControl()).point


def axial(balance: HarmonicBalance) -> NDArray[np.bool_]:
    """Return which relative coordinates move along z."""
    problem = rig_problem()
    along = np.array(
        [".uz" in n or ".rx" in n or ".ry" in n for n in problem.structure.names]
    )
    share = np.abs(balance.selection[:, along]).sum(axis=1)
    moves: NDArray[np.bool_] = share > 1e-9
    return moves


def test_on_the_rig_axial_motion_is_odd_and_all_other_motion_even() -> None:
    balance, point = solved()

    active = moving(balance, point)

    along = axial(balance)
    assert 0 < along.sum() < balance.rank
    for order in range(1, HARMONICS + 1):
        expected = along if order % 2 else ~along
        np.testing.assert_array_equal(active[2 * order - 1], expected)
        np.testing.assert_array_equal(active[2 * order], expected)
    assert active[0].all()


@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_what_is_left_out_is_zero_in_the_solution(model: str) -> None:
    balance, point = solved(model=model)

    active = moving(balance, point)

    coefficients, _ = balance.split(point)
    assert not active.all()
    # Rounding; measured 1e-12.
    assert np.abs(coefficients[~active]).max() < 1e-11 * np.abs(coefficients).max()


def test_a_restricted_point_solves_the_whole_system_too() -> None:
    balance, point = solved()
    unknowns = ActiveUnknowns(balance, moving(balance, point))

    restricted = correct_at(unknowns, unknowns.restricted(point), StepControl())

    whole = unknowns.expanded(restricted.point)
    assert np.abs(balance(whole)[0]).max() <= StepControl().tolerance
    assert unknowns.excluded <= StepControl().tolerance


def test_restricted_residual_and_jacobian_are_parts_of_the_whole_ones() -> None:
    balance, point = solved(model="B")
    active = moving(balance, point)
    unknowns = ActiveUnknowns(balance, active)
    moved = unknowns.expanded(unknowns.restricted(point) * 1.001)

    residual, jacobian = unknowns(unknowns.restricted(moved))

    whole_residual, whole_jacobian = balance(moved)
    chosen = np.flatnonzero(active)
    np.testing.assert_array_equal(residual, whole_residual[chosen])
    columns = np.append(chosen, active.size)
    np.testing.assert_array_equal(jacobian, whole_jacobian[np.ix_(chosen, columns)])


def test_equations_left_out_that_do_not_hold_are_reported() -> None:
    balance, point = solved(model="B")
    few = np.zeros((2 * HARMONICS + 1, balance.rank), dtype=bool)
    few[0:3] = True
    unknowns = ActiveUnknowns(balance, few)

    unknowns(unknowns.restricted(point))

    # Without higher harmonics friction's third one is out of balance.
    whole = unknowns.expanded(unknowns.restricted(point))
    missed = np.abs(balance(whole)[0].reshape(few.shape)[~few]).max()
    assert unknowns.excluded == pytest.approx(missed)
    assert unknowns.excluded > 1e-3
