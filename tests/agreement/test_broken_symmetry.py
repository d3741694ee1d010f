"""Residual tractions that break a symmetry: against loads, and marches.

A mass between two equal faces rubs on both; a slider that never slips holds it between.
The curve keeps the mass in the middle. The mean traction of the slider does what a load
does, to either side alike: amplitudes do not depend on it to first order.
"""

from dataclasses import replace

import numpy as np
import pytest

from hbm.curves.parameter_curves import parameter_response
from hbm.curves.reached import GAIN
from hbm.curves.residual_range import FOURIER, ResidualRange
from hbm.options import CurveOptions
from hbm.solve import detached, frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import response_curve
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import dwelled, last_harmonic
from timedomain.record.start import on_orbit

LIMIT = 40.0
"""of the slider [N]"""
OPTIONS = CurveOptions(
    1.0,
    2.0,
    harmonics=FOURIER.harmonics,
    samples=FOURIER.samples,
    events=False,
)


def between_faces(pull: float = 0.0) -> Problem:
    """Return the mass; ``pull`` [N] is a load across the faces."""
    rubs = ElasticFriction(
        normal_stiffness=300.0, preload=10.0, stiffness=200.0, mu=0.3
    )
    holds = Jenkins(stiffness=400.0, limit=LIMIT)
    elements = [
        Element(rubs, normal=("z", "ground"), tangents=[("x", "ground")]),
        Element(rubs, normal=({"z": -1.0}, "ground"), tangents=[("x", "ground")]),
        Element(holds, between=("z", "ground")),
    ]
    return system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=[100.0, 1.0],
        damping=[0.5, 5.0],
        elements=elements,
        preload={"z": pull},
        drive={"x": 8.0},
        probes={"x": "x"},
    )


def response(
    problem: Problem, frequency: float, *, sought: bool = False
) -> PeriodicResponse:
    """Return the response at one frequency, at the resolution of what is ``sought``."""
    end = 1.01 * frequency
    options = replace(OPTIONS, start=frequency, end=end, residual_range=sought)
    return next(iter(frequency_response(problem, static_equilibrium(problem), options)))


@pytest.mark.parametrize("frequency", [8.0, 10.0, 12.0, 16.0])
def test_no_pull_leads_farther(frequency: float) -> None:
    rows = between_faces().probes.rows

    found = response(between_faces(), frequency, sought=True)

    here = found.amplitudes(rows)[0]
    pulled = [
        response(between_faces(pull), frequency).amplitudes(rows)[0] / here - 1.0
        for pull in np.linspace(0.0, LIMIT, 41)
    ]
    assert max(pulled) - min(pulled) > 0.6
    low, high = found.residual_range[:, 0]
    near = GAIN * (1.0 + max(pulled))  # of the amplitude that is reached
    assert min(pulled) - near < low < min(pulled) + near
    assert max(pulled) - near < high < max(pulled) + near


def test_along_the_drive_the_range_is_that_along_the_frequency() -> None:
    def driven(drive: float) -> Problem:
        problem = between_faces()
        return replace(problem, drive=drive / 8.0 * problem.drive)

    options = replace(OPTIONS, start=8.0, end=8.1, residual_range=True)
    found = next(iter(parameter_response(driven, 12.0, options)))

    expected = response(between_faces(), 12.0, sought=True).residual_range
    assert expected[1, 0] > 0.2
    np.testing.assert_allclose(found.residual_range, expected, atol=GAIN)


def test_a_search_for_detached_curves_does_not_seek_the_range(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem, asked = between_faces(), list[Array]()
    rest = static_equilibrium(problem)
    options = replace(OPTIONS, start=12.0, end=13.0, harmonics=3, residual_range=True)
    known = list(
        frequency_response(problem, rest, replace(options, residual_range=False))
    )
    monkeypatch.setattr(ResidualRange, "at", lambda _, point: asked.append(point))

    found = list(detached(problem, rest, options, known, frequencies=1))

    assert len(found) == 1  # what was sought, and no curve
    assert not asked


def test_a_march_keeps_what_breaks_the_symmetry() -> None:
    frequency, pull = 16.0, 35.0
    rows = between_faces().probes.rows
    begun = on_orbit(between_faces(pull), response(between_faces(pull), frequency))
    assert begun.traction is not None
    traction = begun.traction - np.array([[0.0, 0.0], [0.0, 0.0], [pull, 0.0]])
    start = replace(begun, traction=traction)

    history = dwelled(between_faces(), frequency, periods=60, steps=1024, start=start)

    found = response(between_faces(), frequency, sought=True)
    change = np.abs(last_harmonic(history)[0]) / found.amplitudes(rows)[0] - 1.0
    assert change > 0.5
    assert found.residual_range[1, 0] > change


def test_a_probe_that_a_symmetry_keeps_still_has_a_range_too() -> None:
    problem = replace(between_faces(), probes=Probes(("x", "z"), np.eye(2)))
    rows, frequency = problem.probes.rows, 12.0

    found = response(problem, frequency, sought=True)

    curve = response_curve(problem, [found], "complete")
    along = [
        response(between_faces(pull), frequency).amplitudes(rows)[1]
        for pull in np.linspace(0.0, LIMIT, 41)
    ]
    assert curve.amplitude[0, 1] < 1e-9 * curve.amplitude[0, 0]
    assert curve.amplitude_lowest[0, 1] == pytest.approx(0.0, abs=1e-9)
    assert curve.amplitude_highest[0, 1] == pytest.approx(max(along), rel=5e-3)
