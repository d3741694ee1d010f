"""Amplitudes that depend on what stuck contacts carry: against loads, and marches.

A mass is pressed and rubs; a slider that never slips helps to hold it. The mean
traction of that slider does what so much less preload does.
"""

from dataclasses import replace

import numpy as np
import pytest

from hbm.curves.cyclic import cyclic_response
from hbm.curves.reached import GAIN
from hbm.curves.residual_range import FOURIER, ResidualRange
from hbm.curves.tracer import Tracer
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.solve import frequency_response
from microslip import scene
from microslip_mechanics.cyclic import Coupling, CyclicProblem
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import dwelled, last_harmonic, prescribed
from timedomain.record.start import on_orbit

FREQUENCY = 13.0
"""[rad/s]"""
PRESS = 20.0
"""preload [N]"""
LIMIT = 8.0
"""of the slider [N]"""
SPRING, FACE, STICKS = 100.0, 300.0, 400.0
"""of the mass that is pressed, of the face between both, of the slider [N/m]"""
OPTIONS = CurveOptions(
    FREQUENCY,
    1.01 * FREQUENCY,
    harmonics=FOURIER.harmonics,
    samples=FOURIER.samples,
    events=False,
    residual_range=True,
)


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
    """Return the response at one frequency, at the resolution of what is found."""
    return next(iter(frequency_response(problem, static_equilibrium(problem), OPTIONS)))


def amplitude(problem: Problem) -> float:
    """Return that of x at one frequency [m]."""
    return float(response(problem).amplitudes(problem.probes.rows)[0])


def test_a_residual_traction_does_what_less_preload_does() -> None:
    found = response(pressed(LIMIT))

    here = found.amplitudes(pressed(LIMIT).probes.rows)[0]
    ends = [amplitude(pressed(LIMIT, PRESS + change)) for change in (LIMIT, -LIMIT)]
    shares = sorted(end / here - 1.0 for end in ends)
    assert shares[0] < -0.02
    assert shares[1] > 5.0 * GAIN
    assert found.residual_range[:, 0] == pytest.approx(shares, abs=GAIN)


@pytest.mark.parametrize("share", [0.25, 0.3])
def test_what_sticks_slips_with_other_tractions(share: float) -> None:
    def driven(preload: float = PRESS) -> Problem:
        problem = pressed(LIMIT, preload)
        return replace(problem, drive=share * problem.drive)

    found = response(driven())

    assert found.friction_energy == pytest.approx(0.0, abs=1e-12)  # nothing slips
    here = found.amplitudes(driven().probes.rows)[0]
    most = amplitude(driven(PRESS - LIMIT)) / here - 1.0
    assert most > 0.5
    assert found.residual_range[:, 0] == pytest.approx([0.0, most], abs=GAIN)


def test_what_no_traction_lets_slip_has_one_amplitude() -> None:
    problem = pressed(LIMIT)

    assert not response(
        replace(problem, drive=0.2 * problem.drive)
    ).residual_range.any()


def test_two_tangents_share_one_limit() -> None:
    one, two = (response(made(LIMIT)) for made in (pressed, leaning))

    np.testing.assert_allclose(two.residual_range, one.residual_range, atol=2.0 * GAIN)


def test_sectors_that_do_not_touch_have_the_range_of_one() -> None:
    one, apart = pressed(LIMIT), np.zeros((2, 2))
    disk = CyclicProblem(
        6,
        1,
        one.structure,
        Coupling(apart, apart, apart),
        one.interface,
        np.zeros_like(one.interface.displacement),
        one.preload,
        one.drive.real,
        one.probes,
    )

    found = next(iter(cyclic_response(disk, OPTIONS)))

    expected = response(one).residual_range
    np.testing.assert_allclose(found.residual_range, expected, rtol=1e-6)


def test_no_traction_is_left_open_where_all_slip() -> None:
    slips = response(pressed(limit=0.0))

    assert slips.residual_range.shape == (2, 1)
    assert not slips.residual_range.any()


def test_marches_keep_the_tractions_with_which_they_begin() -> None:
    problem = pressed(LIMIT)
    found = response(problem)
    begun = on_orbit(problem, found)
    assert begun.traction is not None
    reached = []
    for carried in (-0.99 * LIMIT, 0.99 * LIMIT):
        traction = begun.traction + np.array([[0.0, 0.0], [carried, 0.0]])
        moved = begun.displacement - np.array([0.0, carried / (SPRING + FACE)])
        start = replace(begun, displacement=moved, traction=traction)
        history = dwelled(problem, FREQUENCY, periods=60, steps=1024, start=start)
        reached.append(float(np.abs(last_harmonic(history)[0])))

    shares = sorted(each / amplitude(problem) - 1.0 for each in reached)

    assert found.residual_range[:, 0] == pytest.approx(shares, abs=3.0 * GAIN)


def test_a_damper_vibrates_half_as_much_again_if_its_platform_holds_it() -> None:
    problem = scene("platform-damper", ["element.blade.mu=0.6"])
    frequency = 2.0 * np.pi * 292.0
    rest, rows = static_equilibrium(problem), problem.probes.rows
    options = CurveOptions(frequency, 1.001 * frequency, harmonics=15, samples=256)
    path = along_frequency(problem, rest, options.start, options.end)
    tracer = Tracer(problem, path, options)
    finder = ResidualRange(tracer.curve.resolution, rows, tracer.control.tolerance)
    point = next(iter(tracer.pieces)).point

    found = finder.at(point)

    farthest = finder.last[0, 1.0]
    assert found[1, 0] > 0.5
    balance, here = tracer.curve.resolution.at(FOURIER).at_frequency(point)
    amplitudes = []
    for solved, place in ((balance, here), (farthest.balance, farthest.point)):
        motion = prescribed(frequency, solved.motion(place))
        begun = on_orbit(problem, motion)
        assert begun.traction is not None
        if solved.problem.bent is not None:
            springs = problem.interface.points.tangential[:, None]
            held = begun.traction + springs * solved.problem.bent[:, 1:]
            begun = replace(begun, traction=held)
        history = dwelled(problem, frequency, periods=300, steps=512, start=begun)
        amplitudes.append(float(np.abs(last_harmonic(history)[0])))
        expected = float(motion.amplitudes(rows)[0])
        # at its limit the slider gives way a little, and rests there
        assert amplitudes[-1] == pytest.approx(expected, rel=0.03)
    assert amplitudes[1] > 1.5 * amplitudes[0]
