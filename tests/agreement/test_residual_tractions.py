"""Amplitudes that depend on what stuck contacts carry: against loads, and a march.

A mass rubs on another one, which a slider holds that never slips. The mean traction of
that slider is a part of the force that presses both together: it does what so much less
preload does.
"""

from dataclasses import replace

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import dwelled, last_harmonic
from timedomain.record.start import on_orbit

FREQUENCY = 13.0
"""[rad/s]"""
PRESS = 20.0
"""preload [N]"""
SPRING, FACE, STICKS = 100.0, 300.0, 400.0
"""of the mass that is pressed, of the face between both, of the slider [N/m]"""


def pressed(limit: float, preload: float = PRESS) -> Problem:
    """Return the masses; ``limit`` [N] is that of the slider, which never slips."""
    rubs = ElasticFriction(normal_stiffness=FACE, stiffness=200.0, mu=0.3)
    elements = [
        Element(rubs, normal=("z", "ground"), tangents=[("x", "ground")]),
        Element(Jenkins(stiffness=STICKS, limit=limit), between=("z", "ground")),
    ]
    return system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=[100.0, SPRING],
        damping=[0.5, 5.0],
        elements=elements,
        preload={"z": preload},
        drive={"x": 8.0, "z": 1e-3},
        probes={"x": "x"},
    )


def leaning(limit: float) -> Problem:
    """Return the same, pressed along a slanted direction; the slider has two tangents.

    What it carries along that direction presses, what it carries across does nothing.
    """
    rubs = ElasticFriction(normal_stiffness=FACE, stiffness=200.0, mu=0.3)
    holds = ElasticFriction(load=limit / 0.5, mu=0.5, stiffness=STICKS)
    slanted = {"y": 0.6, "z": 0.8}
    elements = [
        Element(rubs, normal=(slanted, "ground"), tangents=[("x", "ground")]),
        Element(holds, tangents=[("y", "ground"), ("z", "ground")]),
    ]
    return system(
        names=["x", "y", "z"],
        mass=[1.0, 1.0, 1.0],
        stiffness=[100.0, SPRING, SPRING],
        damping=[0.5, 5.0, 5.0],
        elements=elements,
        preload={"y": 0.6 * PRESS, "z": 0.8 * PRESS},
        drive={"x": 8.0, "y": 6e-4, "z": 8e-4},
        probes={"x": "x"},
    )


def response(problem: Problem) -> PeriodicResponse:
    """Return the response at one frequency.

    At a fixed resolution: how slips lie between samples changes slopes by percents.
    """
    options = CurveOptions(
        FREQUENCY, 1.01 * FREQUENCY, harmonics=15, samples=256, events=False
    )
    return next(iter(frequency_response(problem, static_equilibrium(problem), options)))


def amplitude(problem: Problem) -> float:
    """Return that of x at one frequency [m]."""
    return float(response(problem).amplitudes(problem.probes.rows)[0])


def test_a_residual_traction_does_what_less_preload_does() -> None:
    limit = 0.1
    problem = pressed(limit)
    found = response(problem)
    wobble = STICKS * float(found.amplitudes(np.array([[0.0, 1.0]]))[0])
    room = limit - wobble

    lower, higher = found.amplitude_range[:, 0]

    ends = [amplitude(pressed(limit, PRESS + change)) for change in (room, -room)]
    assert 0.0 < wobble < 0.1 * limit
    assert abs(ends[1] - ends[0]) > 1e-4 * amplitude(problem)
    assert (higher, -lower) == pytest.approx(
        [abs(ends[1] - ends[0]) / 2.0] * 2, rel=3e-3
    )


def test_two_tangents_share_one_limit() -> None:
    one, two = (response(made(0.1)) for made in (pressed, leaning))

    np.testing.assert_allclose(two.amplitude_range, one.amplitude_range, rtol=0.02)


def test_no_traction_is_left_open_where_all_slip() -> None:
    slips = response(pressed(limit=0.0))

    assert slips.amplitude_range.shape == (2, 1)
    assert not slips.amplitude_range.any()


def test_a_march_keeps_the_traction_with_which_it_begins() -> None:
    problem = pressed(limit=0.4)
    found = response(problem)
    begun = on_orbit(problem, found)
    assert begun.traction is not None
    reached = []
    for carried in (-0.3, 0.3):
        traction = begun.traction + np.array([[0.0, 0.0], [carried, 0.0]])
        moved = begun.displacement - np.array([0.0, carried / (SPRING + FACE)])
        start = replace(begun, displacement=moved, traction=traction)
        history = dwelled(problem, FREQUENCY, periods=60, steps=1024, start=start)
        reached.append(float(np.abs(last_harmonic(history)[0])))

    change = abs(reached[1] - reached[0])

    lower, higher = found.amplitude_range[:, 0]
    assert change > 1e-3 * amplitude(problem)
    assert change == pytest.approx(0.3 / 0.4 * (higher - lower), rel=0.05)
