"""Solutions by GMRES against those by factors of all orders."""

from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from hbm import iterated, linearisation
from hbm.bordered import Bordered
from hbm.fourier import FourierBasis, to_complex, to_real
from hbm.linearisation import Linearisation
from hbm.path import along_frequency
from hbm.residual import HarmonicBalance
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

FREQUENCY = 2.0 * np.pi * 134.0
FOURIER = FourierBasis(127, 1024)
SPEED = 2e-3
"""of sliding [m/s]: twice the rig's threshold velocity"""


class Case(NamedTuple):
    """The full rig, and a motion in which faces stick, slide and part."""

    balance: HarmonicBalance
    point: Array
    unknowns: NDArray[np.int64]
    """where they are in the point"""


def case(*, symmetry: bool) -> Case:
    """Return the rig with what a symmetry keeps still left out, or with all of it."""
    problem = rig_problem(model="full")
    rest = static_equilibrium(problem)
    path = along_frequency(
        problem, rest, FREQUENCY, 1.01 * FREQUENCY, symmetry=symmetry
    )
    balance = path.balance(FOURIER)
    assert isinstance(balance, HarmonicBalance)
    rng = np.random.default_rng(3)
    shape = (FOURIER.coefficients, balance.rank)
    orders = (np.arange(FOURIER.coefficients)[:, None] + 1) // 2
    depth = np.abs(path.problem.rest).max()
    motion = rng.standard_normal(shape) / np.maximum(orders, 1) ** 2.0
    motion *= np.where(np.abs(path.problem.rest) > 0.0, depth, SPEED / FREQUENCY)
    motion[0] = path.problem.rest
    unknowns = np.flatnonzero(path.mask(FOURIER.harmonics))
    return Case(balance, balance.point(motion, FREQUENCY), unknowns)


def sides(size: int) -> tuple[Array, Array]:
    """Return a border across the curve, and a right side as Newton's iteration has."""
    rng = np.random.default_rng(4)
    along = np.zeros(size)
    along[: FOURIER.coefficients] = rng.standard_normal(FOURIER.coefficients)
    along[-1] = 1.0
    return along, np.append(rng.standard_normal(size - 1), 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("symmetry", [True, False])
def test_solutions_by_iteration_are_those_by_factors(symmetry: bool) -> None:
    balance, point, unknowns = case(symmetry=symmetry)
    _, iterating = balance(point)
    normal, right = sides(point.size)
    unit = np.zeros(point.size)
    unit[-1] = 1.0
    dense = Linearisation(
        lambda: (iterating.jacobian, iterating.slope),
        unknowns,
        point.size,
    )

    for border, wanted in ((unit, right), (normal, right), (normal, unit)):
        found, expected = iterating.solve(border, wanted), dense.solve(border, wanted)

        away = np.linalg.norm((found - expected)[:-1])
        assert away <= 1e-6 * np.linalg.norm(expected[:-1])
        assert found[-1] == pytest.approx(expected[-1], rel=1e-6, abs=1e-12)


@pytest.mark.parametrize("symmetry", [True, False])
def test_products_by_samples_are_those_by_the_assembled_jacobian(
    symmetry: bool,
) -> None:
    balance, point, unknowns = case(symmetry=symmetry)
    _, linearised = balance(point)
    moved = np.zeros((FOURIER.coefficients, balance.rank))
    moved.ravel()[unknowns] = np.random.default_rng(5).standard_normal(unknowns.size)

    found = balance.contact.product()(moved, FREQUENCY).ravel()[unknowns]

    orders = 1j * FREQUENCY * np.arange(FOURIER.harmonics + 1)
    held = balance.problem.condensed.dynamic_stiffness(orders)
    held[0] += balance.problem.gauge
    structure = to_real((held @ to_complex(moved)[..., None])[..., 0])
    whole = linearised.jacobian @ moved.ravel()[unknowns]
    expected = whole - structure.ravel()[unknowns]
    assert np.abs(found - expected).max() <= 1e-11 * np.abs(whole).max()
    assert np.abs(expected).max() > 1e-6 * np.abs(whole).max()


def test_what_takes_too_many_products_is_solved_by_factors(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    balance, point, unknowns = case(symmetry=True)
    monkeypatch.setattr(iterated, "SHARE", unknowns.size // 2)
    made: list[int] = []

    def factored(jacobian: Array, slope: Array, border: Array) -> Bordered:
        made.append(slope.size)
        return Bordered(jacobian, slope, border)

    monkeypatch.setattr(linearisation, "Bordered", factored)
    _, linearised = balance(point)
    normal, right = sides(point.size)

    found = linearised.solve(normal, right)

    assert made == [unknowns.size]
    missing = linearised.jacobian @ found[unknowns] + found[-1] * linearised.slope
    size = np.abs(linearised.jacobian) @ np.abs(found[unknowns])
    assert np.abs(missing - right[unknowns]).max() <= 1e-10 * size.max()


def test_few_unknowns_are_factored_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = rig_problem(model="A")
    path = along_frequency(
        problem, static_equilibrium(problem), FREQUENCY, 1.01 * FREQUENCY
    )
    balance = path.balance(FOURIER)
    point = np.zeros(FOURIER.coefficients * path.rank + 1)
    point[-1] = FREQUENCY

    monkeypatch.delattr(linearisation, "Iterated")
    _, linearised = balance(point)
    unit = np.zeros(point.size)
    unit[-1] = 1.0

    found = linearised.solve(unit, unit)

    assert found[-1] == 1.0
