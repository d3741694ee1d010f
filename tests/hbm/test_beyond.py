"""Orders beyond those that are solved for: how they answer, and what that tells."""

import numpy as np
import pytest

from hbm.balance.answers import answers
from hbm.balance.beyond import AGAIN, REACH, stepped, wider
from hbm.balance.refined import refined
from hbm.balance.residual import HarmonicBalance
from hbm.curves.periodic_response import periodic_response
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.solve import frequency_response
from honesty import amplitudes
from lap_joint import lap_joint
from microslip_mechanics.static import static_equilibrium


def test_each_order_answers_as_an_oscillator_does() -> None:
    mass, damping, stiffness, spring, dashpot = 2.0, 0.3, 50.0, 4.0, 0.1
    variable = 1j * np.array([3.0, 5.0, 7.0])
    own = mass * variable**2 + damping * variable + stiffness
    force = np.array([1.0, 0.2j, -0.5])

    moved = answers(
        own[:, None, None],
        (np.array([[spring]]), np.array([[dashpot]])),
        variable,
        np.array([[True], [False], [True]]),
        force[:, None],
    )

    expected = -force / (own + spring + dashpot * variable)
    expected[1] = 0.0  # symmetry keeps it at rest
    assert moved[:, 0] == pytest.approx(expected)


def test_an_undamped_mode_that_an_order_meets_is_no_error() -> None:
    none = np.zeros((1, 1))

    moved = answers(
        np.zeros((1, 1, 1), complex),
        (none, none),
        np.ones(1, complex),
        np.ones((1, 1), dtype=bool),
        np.ones((1, 1), complex),
    )

    assert np.isfinite(moved).all()


@pytest.mark.parametrize("harmonics", [3, 15, 31])
def test_an_octave_and_no_less_than_so_many_orders_are_looked_at(
    harmonics: int,
) -> None:
    wide = wider(FourierBasis(harmonics, 4 * harmonics + 2))

    assert wide.harmonics == max(2 * harmonics + 1, REACH)
    assert wide.samples >= 4 * wide.harmonics + 2


def test_orders_beyond_move_a_joint_as_newton_steps_by_factors_do() -> None:
    problem = lap_joint(pairs=3, bolts=2e4, drive=2.0)
    rest, frequency, fourier = static_equilibrium(problem), 167.0, FourierBasis(63, 512)
    path = along_frequency(problem, rest, frequency, 1.01 * frequency)
    options = CurveOptions(
        frequency, 1.01 * frequency, harmonics=31, events=False, stability=False
    )
    known = next(iter(frequency_response(problem, rest, options)))
    finer, wide = path.balance(fourier), path.balance(wider(fourier))
    assert isinstance(finer, HarmonicBalance)
    seen = known.seen(finer.problem.selection)
    normal = np.zeros(finer.point(seen, frequency).size)
    normal[-1] = 1.0
    made = refined(finer, finer.point(seen, frequency), fourier.harmonics, normal)

    found = stepped(wide, made, fourier, path.rank, normal)

    assert found is not None
    low = made.corrected.size - 1
    point = np.zeros(wider(fourier).coefficients * path.rank + 1)
    point[:low], point[-1] = made.corrected[:-1], frequency
    residual, linearised = wide(point)
    expected = -np.linalg.solve(linearised.jacobian, residual)[:low]
    away = (found - made.corrected)[:-1] - AGAIN * expected
    assert np.linalg.norm(away) <= 1e-3 * np.linalg.norm(AGAIN * expected)
    assert found[-1] == made.corrected[-1]


@pytest.mark.parametrize(
    ("drive", "places"),
    [(2.0, (26.36, 26.45, 26.55, 26.69, 26.87)), (1.0, (26.546, 26.633, 26.7))],
    ids=["order 38 meets the fourth mode", "contacts slip elsewhere after one step"],
)
def test_errors_cover_what_orders_do_that_meet_modes_of_a_joint(
    drive: float, places: tuple[float, ...]
) -> None:
    """That mode at 1010 Hz changes 0.5 % of the amplitude under 2 N at 26.55 Hz."""
    problem = lap_joint(pairs=5, bolts=2e4, drive=drive)
    rest = static_equilibrium(problem)
    covered = []
    for hertz in places:
        lowest = 2.0 * np.pi * hertz
        options = CurveOptions(lowest, 1.02 * lowest, error=1e-3, stability=False)
        point = next(iter(frequency_response(problem, rest, options)))
        better = periodic_response(
            problem, rest, point, harmonics=127, samples=2048, tolerance=1e-8
        )
        exact, found = amplitudes(problem, better), amplitudes(problem, point)
        covered.append(np.abs(exact / found - 1.0).max() <= point.error)
    assert all(covered)
