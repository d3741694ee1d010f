"""What residual tractions change, to first order, against responses with others."""

from dataclasses import replace

import numpy as np
from scipy.optimize import linprog

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import upright
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.curves.leeway import Leeway
from hbm.curves.tracer import Tracer
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from microslip import scene
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.static import static_equilibrium

LOW = FourierBasis(7, 256)
FREQUENCY = 2.0 * np.pi * 291.0
"""at which the wedge sticks to the blade's platform, and carries a mean traction"""


def damper() -> tuple[HarmonicBalance, Array, Array, float]:
    """Return a balance, its solution, probes and the tolerance of a residual [N]."""
    problem = scene("platform-damper", ["element.blade.mu=0.6"])
    rest = static_equilibrium(problem)
    options = CurveOptions(
        FREQUENCY, 1.001 * FREQUENCY, harmonics=7, samples=256, errors=False
    )
    path = along_frequency(problem, rest, options.start, options.end)
    tracer = Tracer(problem, path, options)
    point = next(iter(tracer.pieces)).point
    balance, place = tracer.curve.resolution.at(LOW).at_frequency(point)
    tolerance = 1e-4 * tracer.control.tolerance
    made = correct(balance, place, upright(place), tolerance=tolerance)
    return balance, made.point, problem.probes.rows, tolerance


def test_small_changes_of_tractions_do_what_is_told() -> None:
    balance, point, rows, tolerance = damper()
    here = Leeway.of(balance, point, rows)
    count = len(here.stuck.places)
    assert count > 0
    assert np.abs(here.stuck.own).max() > 1.0
    change = 1e-3 * np.sign(here.stuck.slipped(None))  # away from the limit
    bent = here.stuck.bent(change)
    other = balance.with_problem(replace(balance.problem, bent=bent))
    guess = point + here.changes @ change

    made = correct(other, guess, upright(guess), tolerance=tolerance)

    assert made.outcome is Outcome.CONVERGED
    there = Leeway.of(other, made.point, rows)
    np.testing.assert_array_equal(there.stuck.places, here.stuck.places)
    amplitude = here.amplitude + here.slopes @ change
    np.testing.assert_allclose(there.amplitude, amplitude, rtol=1e-7)
    assert np.abs(there.amplitude / here.amplitude - 1.0).max() > 1e-6
    (matrix, room), (_, left) = here.bounds, there.bounds
    moved = np.abs(left - room)
    assert moved.max() > 0.5e-3
    np.testing.assert_allclose(left, room - matrix @ change, atol=0.05 * moved.max())


def test_the_farthest_tractions_reach_a_limit() -> None:
    balance, point, rows, _ = damper()
    leeway = Leeway.of(balance, point, rows)
    matrix, room = leeway.bounds

    for sign in (-1.0, 1.0):
        change = leeway.farthest(0, sign)
        assert sign * (leeway.slopes[0] @ change) >= 0.0
        left = room - matrix @ change
        assert left.min() > -1e-9 * room.max()
        largest = leeway.stuck.limit.max(axis=0)
        ends = np.isclose(np.abs(change), largest).any()
        assert ends or left.min() < 1e-9 * room.max()


def test_few_conditions_lead_where_all_do() -> None:
    damped = Leeway.of(*damper()[:3])
    matrix, room = damped.bounds
    slope, ends = damped.slopes[0], damped.stuck.limit.max(axis=0)
    bounds = list(zip(-ends, ends, strict=True))
    for sign in (-1.0, 1.0):
        whole = linprog(-sign * slope / largest(slope), matrix, room, bounds=bounds)

        reached = slope @ damped.farthest(0, sign)

        rounding = 1e-9 * (np.abs(slope) @ ends)
        np.testing.assert_allclose(reached, slope @ whole.x, rtol=0.0, atol=rounding)
