"""Errors that a few harmonics tell, of points and of peaks, bound the true ones."""

import contextlib
import itertools
from collections.abc import Iterator

import numpy as np

from bending_mass import bending_mass
from hbm.curves.across_curve import responses_across
from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

SPAN = (4.0, 5.1)
"""about half of the natural frequency, where the second harmonic is in resonance"""
MANY = 31


def traced(
    problem: Problem, error: float, highest: float = SPAN[1]
) -> list[PeriodicResponse]:
    """Return the responses of a curve by tolerance, as long as it is in the span."""
    options = CurveOptions(SPAN[0], highest, error=error, stability=False)
    points = frequency_response(problem, static_equilibrium(problem), options)
    return list(itertools.takewhile(lambda each: each.frequency <= SPAN[1], points))


def solved(problem: Problem, known: PeriodicResponse) -> Iterator[PeriodicResponse]:
    """Yield a response with many harmonics, at its frequency and across its curve."""
    rest = static_equilibrium(problem)
    with contextlib.suppress(ContinuationError):
        yield periodic_response(problem, rest, known, harmonics=MANY, samples=512)
    yield from responses_across(problem, rest, known, SPAN, [MANY])


def amplitude(response: PeriodicResponse) -> float:
    """Return the first harmonic of the only mass [m]."""
    return float(np.hypot(*response.coefficients[1:3, 0]))


def test_points_that_steps_have_moved_far_err_by_no_more_than_is_told() -> None:
    # the fold of a resonance of the second harmonic: steps from three harmonics change
    # amplitudes by some per cent and leave 5 % of the residual, but more of the way
    problem = bending_mass(452.25, 849.74, 0.00714, 1.39)
    points = [each for each in traced(problem, 3e-2, 20.0) if not each.event]

    told = np.array([each.error for each in points])
    true = np.array(
        [
            min(
                abs(amplitude(each) / amplitude(other) - 1.0)
                for other in solved(problem, each)
            )
            for each in points
        ]
    )

    assert len(points) > 20
    assert true.max() > 1e-4
    assert np.mean(told + 1e-9 >= true) >= 0.95


def test_a_peak_of_few_harmonics_is_no_farther_aside_than_is_told() -> None:
    # it is located with three harmonics and reported with seven, by which it moves
    problem = bending_mass(784.81, 7700.3, 0.04774, 0.9517)

    (rough,), (fine,) = (
        [each for each in traced(problem, error) if each.event == "peak"]
        for error in (5e-2, 1e-5)
    )

    true = abs(rough.frequency - fine.frequency)
    assert rough.harmonics < fine.harmonics
    assert 10.0 * fine.parameter_error < true <= rough.parameter_error < 10.0 * true
