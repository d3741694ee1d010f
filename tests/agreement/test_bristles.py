"""Bristles in both domains: order of the error, and one orbit."""

from collections.abc import Callable

import numpy as np
import pytest

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.bristles import Dahl, LuGre
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import marched
from timedomain.integrate import MarchOptions
from timedomain.record.start import Start, on_orbit
from timedomain.shooting.shooting import periodic_orbit

HERTZ = 1.7


def lugre() -> Problem:
    law = LuGre(
        load=2.0,
        stiffness=150.0,
        mu_dynamic=0.2,
        mu_static=0.35,
        stribeck_velocity=0.1,
        viscous=0.1,
    )
    return system(
        mass=[1.0],
        stiffness=[100.0],
        damping=[0.2],
        elements=[Element(law, tangents=[("x1", "ground")])],
        drive={"x1": 0.7},
    )


def pressed_dahl() -> Problem:
    """Return a mass that rubs on what presses it, more or less, without lifting off."""
    law = Dahl(normal_stiffness=60.0, preload=1.5, stiffness=50.0, mu=0.4)
    return system(
        names=["n", "t"],
        mass=[1.0, 0.5],
        stiffness=[[150.0, -20.0], [-20.0, 80.0]],
        damping_ratio=0.03,
        elements=[
            Element(law, normal=("n", "ground"), tangents=[("t", "ground")]),
        ],
        drive={"n": (0.5, 0.4), "t": 0.3},
    )


def bent_spring() -> Problem:
    """Return a mass on a spring that bends, with a bristle that forgets slowly."""
    law = Dahl(load=2000.0, stiffness=5e3, mu=0.5)
    bends = PolynomialSpring(coefficients={2: 1.25e6})
    return system(
        names=["x"],
        mass=[1.0],
        stiffness=[1e4],
        damping_ratio=0.005,
        elements=[
            Element(law, tangents=[("x", "ground")]),
            Element(bends, between=("x", "ground")),
        ],
        drive={"x": 1.0},
    )


def carried() -> Problem:
    """Return a mass on a spring that bends, and one that bristles alone carry along."""
    return system(
        names=["x", "free"],
        mass=[1.0, 0.5],
        stiffness=[[1e4, 0.0], [0.0, 0.0]],
        damping=[[1.0, 0.0], [0.0, 0.0]],
        elements=[
            Element(Dahl(load=10.0, stiffness=5e3, mu=0.5), tangents=[("free", "x")]),
            Element(PolynomialSpring(coefficients={2: 1e6}), between=("x", "ground")),
        ],
        drive={"x": 1.0},
    )


def first_harmonic(problem: Problem, harmonics: int, samples: int) -> Array:
    turn = 2.0 * np.pi * HERTZ
    options = CurveOptions(turn, 1.001 * turn, harmonics=harmonics, samples=samples)
    curve = frequency_response(problem, static_equilibrium(problem), options)
    found: Array = next(curve).coefficients[1:3]
    return found


@pytest.mark.parametrize(
    "make", [pytest.param(lugre, marks=pytest.mark.long), pressed_dahl]
)
def test_the_error_by_samples_falls_with_their_square(
    make: Callable[[], Problem],
) -> None:
    found = [first_harmonic(make(), 15, samples) for samples in (512, 1024, 2048, 4096)]

    changes = [np.linalg.norm(np.diff(found, axis=0)[i]) for i in range(3)]
    # with velocity and load of the end it was halved
    assert changes[0] > 10.0 * changes[2]
    size = np.linalg.norm(found[-1])
    assert changes[0] < 2e-5 * size


@pytest.mark.parametrize("make", [lugre, pressed_dahl])
def test_the_march_is_of_second_order(
    make: Callable[[], Problem],
) -> None:
    problem = make()
    rest = static_equilibrium(problem).displacement
    start = Start(rest, np.zeros_like(rest))

    def end(steps: int) -> Array:
        options = MarchOptions(1.0 / HERTZ / steps, steps // 64)
        dwell = Dwell(2.0 * np.pi * HERTZ, 2.25 / HERTZ)
        last: Array = marched(problem, dwell, options, start=start).displacement[-1]
        return last

    found = [end(steps) for steps in (512, 1024, 2048, 4096)]

    changes = [float(np.abs(each).max()) for each in np.diff(found, axis=0)]
    # of first order they were halved; places of turns in a step make them uneven
    assert changes[0] > 7.0 * changes[2]


def test_both_domains_have_one_orbit() -> None:
    problem = lugre()
    turn = 2.0 * np.pi * HERTZ
    options = CurveOptions(turn, 1.001 * turn, error=1e-4)
    curve = frequency_response(problem, static_equilibrium(problem), options)
    response = next(curve)

    orbit = periodic_orbit(problem, turn, start=on_orbit(problem, response))

    amplitude = np.linalg.norm(response.coefficients[1:3], axis=0)
    assert orbit.amplitude == pytest.approx(amplitude, rel=1e-4)
    assert abs(response.multipliers[0]) == pytest.approx(
        abs(orbit.multipliers).max(), abs=1e-3
    )


def test_a_bristle_that_forgets_slowly_has_the_mean_that_a_march_ends_with() -> None:
    problem, rest = bent_spring(), static_equilibrium(bent_spring())
    options = CurveOptions(120.0, 114.0, stability=False, events=False)

    curve = list(frequency_response(problem, rest, options))

    loud = max(curve, key=lambda each: each.amplitudes(problem.probes.rows)[0])
    start = on_orbit(problem, loud)
    orbit = periodic_orbit(problem, loud.frequency, start=start, near=loud)
    # of the mean with which a march begins a period leaves nine tenths
    found = loud.amplitudes(problem.probes.rows)
    assert loud.error < 1e-3
    assert found == pytest.approx(orbit.amplitude, rel=loud.error + orbit.error)


def test_bristles_alone_hold_no_mean_position() -> None:
    problem, rest = carried(), static_equilibrium(carried())
    turn, periods = 2.0 * np.pi * 9.0, 160

    with pytest.raises(ContinuationError, match="drifts at 9 Hz"):
        next(frequency_response(problem, rest, CurveOptions(turn, 1.1 * turn)))

    dwell = Dwell(turn, periods / 9.0)
    history = marched(problem, dwell, MarchOptions(1.0 / 9.0 / 128, 128 * 20))
    away = np.diff(history.displacement[-3:, 1])
    assert away[1] == pytest.approx(away[0], rel=1e-2)
    assert np.abs(away[1]) > 0.1 * np.abs(history.displacement[:, 0]).max()
