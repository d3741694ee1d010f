"""Multipliers of contacts that remember: closed forms, springs, what is not known."""

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.stability.recalled import recalled_multipliers
from memory_problems import JENKINS, LIMIT, STIFFNESS
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import COULOMB, PointLaw, contact_table
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure

TURN = 2.0 * np.pi
SPRING, DAMPING = 45.0, 0.4


def mass(*laws: PointLaw, spring: float = SPRING, drive: float = 0.5) -> Problem:
    """Return a mass of 1 kg on a spring that rubs on contacts along one tangent."""
    seen = np.tile(np.eye(3)[:, 1:2], (len(laws), 1))
    one = np.eye(1)
    return Problem(
        Structure(one, DAMPING * one, spring * one, ("x",)),
        Interface(contact_table(laws), seen, tuple(map(str, range(len(laws))))),
        np.zeros(1),
        np.array([drive]),
        Probes(("x",), one),
    )


def at(problem: Problem, frequency: float) -> PeriodicResponse:
    """Return the response at a frequency."""
    options = CurveOptions(
        0.6 * frequency, frequency, harmonics=31, samples=2048, errors=False
    )
    *_, last = frequency_response(problem, static_equilibrium(problem), options)
    return last


def by_pieces(response: PeriodicResponse, spring: float) -> ComplexArray:
    """Return the multipliers of one mass, as a product of exact pieces.

    From a turn of the motion on the slider is a spring that begins there, δf =
    k_t (δx − δx_turn); once it slips its force does not change. Half a period does.
    """
    coefficients, frequency = response.coefficients[:, 0], response.frequency
    orders = np.arange(1, len(coefficients) // 2 + 1)

    def moved(phase: float) -> float:
        wave = np.exp(1j * orders * phase)
        made = wave.real @ coefficients[1::2] + wave.imag @ coefficients[2::2]
        return float(coefficients[0] + made)

    def moving(phase: float) -> float:
        wave = np.exp(1j * orders * phase) * orders
        made = -wave.imag @ coefficients[1::2] + wave.real @ coefficients[2::2]
        return float(made)

    phase = np.linspace(0.0, TURN, 721)
    speeds = np.array([moving(each) for each in phase])
    first = int(np.flatnonzero((speeds[:-1] > 0.0) & (speeds[1:] <= 0.0))[0])
    turn = scipy.optimize.brentq(moving, phase[first], phase[first + 1], xtol=1e-13)
    slides = scipy.optimize.brentq(
        lambda each: moved(turn) - moved(each) - 2.0 * LIMIT / STIFFNESS,
        turn,
        turn + np.pi,
        xtol=1e-13,
    )
    stuck, slipping = (slides - turn) / frequency, (turn + np.pi - slides) / frequency
    held = np.array(
        [
            [0.0, 1.0, 0.0],
            [-spring - STIFFNESS, -DAMPING, STIFFNESS],
            [0.0, 0.0, 0.0],
        ]
    )
    free = np.array([[0.0, 1.0], [-spring, -DAMPING]])
    begun = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 0.0]])
    half = (
        scipy.linalg.expm(slipping * free)
        @ (scipy.linalg.expm(stuck * held) @ begun)[:2]
    )
    values: ComplexArray = np.linalg.eigvals(half).astype(complex) ** 2
    return values


def apart(found: ComplexArray, exact: ComplexArray) -> float:
    """Return the distance of each exact multiplier to the nearest one found."""
    return float(np.abs(found[:, None] - exact).min(axis=0).max())


@pytest.mark.parametrize(
    ("spring", "frequency"), [(SPRING, 7.0), (SPRING, 7.6), (SPRING, 8.4), (0.0, 3.0)]
)
def test_one_slider_has_the_multipliers_of_exact_pieces(
    spring: float, frequency: float
) -> None:
    response = at(mass(JENKINS, spring=spring), frequency)
    assert response.friction_energy > 0.01

    found = response.multipliers

    assert found.size == 3
    assert np.abs(found).min() < 1e-6  # a slider that slips forgets
    assert apart(found, by_pieces(response, spring)) < 2e-4


def test_a_slider_that_never_slips_is_a_spring() -> None:
    response = at(mass(JENKINS, drive=0.02), 7.0)
    assert abs(response.friction_energy) < 1e-9

    roots = np.roots([1.0, DAMPING, SPRING + STIFFNESS])
    assert response.multipliers.size == 2
    assert apart(response.multipliers, np.exp(roots * TURN / 7.0)) < 1e-6


def test_regularised_friction_beside_it_leaves_stability_open() -> None:
    rubbing = PointLaw(
        friction=COULOMB, dynamic=0.1, threshold=1e-3, constant_load=True, load=1.0
    )
    response = at(mass(JENKINS, rubbing), 7.0)
    assert response.multipliers.size == 0
    assert response.unstable == -1


def test_a_body_that_nothing_holds_leaves_stability_open() -> None:
    # a second mass that no spring and no contact holds, beside the first one
    problem = mass(JENKINS)
    free = Structure(
        np.eye(2), np.diag([DAMPING, 0.0]), np.diag([SPRING, 0.0]), ("x", "free")
    )
    basis, _ = problem.interface.relative_motion()
    contact = AlternatingFrequencyTime(
        problem.interface.points, basis, FourierBasis(1, 64)
    )
    contact(np.array([[0.0], [0.0], [0.02]]), 7.0)

    matrices = free.mass, free.damping, free.stiffness
    rest = basis, np.ones(3), contact, 7.0
    assert recalled_multipliers(matrices, *rest).size == 0
    alone = problem.structure.mass, problem.structure.damping, free.stiffness[:1, :1]
    assert recalled_multipliers(alone, *rest).size == 3
