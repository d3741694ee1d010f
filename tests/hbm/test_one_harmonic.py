"""Responses in one harmonic, and their error: marches, more harmonics, refusals."""

from collections.abc import Iterator

import numpy as np
import pytest

from hbm.errors import ContinuationError
from hbm.one_harmonic import one_harmonic_error, one_harmonic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from honesty import falling
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import dwelled, last_harmonic, sliding_block, swinging

TURN = 2.0 * np.pi
RANGE = (TURN * 125.0, TURN * 145.0)
DUFFING = (TURN * 5.9, TURN * 9.5)
"""frequencies of which the curve is traced downwards only"""


@pytest.mark.parametrize("kind", ["coulomb", "falling"])
@pytest.mark.parametrize("frequency", [8.0, 11.0, 15.0])
def test_the_error_is_the_distance_from_a_march(kind: str, frequency: float) -> None:
    problem = falling()
    if kind == "coulomb":
        problem = sliding_block(
            stiffness=300.0,
            damping=2.0,
            drive=1.5,
            load=1.0,
            dynamic=0.5,
            threshold=1e-2,
        )
    rest, limits = static_equilibrium(problem), (6.0, 20.0)
    response = one_harmonic_response(problem, rest, limits, frequency)
    error = one_harmonic_error(problem, rest, response, limits, 1e-6)

    history = dwelled(problem, frequency, periods=40, steps=2000)

    true = np.abs(last_harmonic(history))
    found = np.abs(response.amplitudes(problem.probes.rows) - true).max() / true.max()
    assert response.frequency == frequency
    assert error.amplitude == pytest.approx(found, rel=0.05, abs=2e-5)
    assert error.frequency == 0.0


def test_the_response_is_that_of_largest_amplitude() -> None:
    problem = rig_problem(model="A")
    rest = static_equilibrium(problem)

    best = one_harmonic_response(problem, rest, RANGE)

    def size(response: PeriodicResponse) -> float:
        seen: Array = response.amplitudes(problem.probes.rows)
        return float(seen.max())

    for share in (0.999, 1.001):
        beside = one_harmonic_response(problem, rest, RANGE, best.frequency * share)
        assert beside.frequency == best.frequency * share
        assert size(beside) < size(best)
    assert best.harmonics == 1
    assert best.event == "peak"


def test_the_response_lies_where_it_is_wanted_if_the_curve_ends_elsewhere() -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))

    found = one_harmonic_response(
        problem, static_equilibrium(problem), DUFFING, TURN * 9.0
    )

    assert found.frequency == TURN * 9.0


def test_the_error_is_told_at_the_frequency_of_the_response(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    rest = static_equilibrium(problem)
    limits = (TURN * 5.8, TURN * 9.0)
    found = one_harmonic_response(problem, rest, DUFFING, TURN * 9.0)
    expected = one_harmonic_error(problem, rest, found, limits, 1e-3).amplitude

    def lost(*_: object, **__: object) -> PeriodicResponse:
        raise ContinuationError("no response is found")

    monkeypatch.setattr("hbm.one_harmonic.periodic_response", lost)
    error = one_harmonic_error(problem, rest, found, limits, 1e-3).amplitude

    assert expected < 1e-3
    assert error == pytest.approx(expected, rel=1e-2, abs=1e-6)


def test_the_error_at_a_bent_peak_is_that_of_the_peak_with_more_harmonics() -> None:
    settings = ["drive.x=0.002", "structure.damping_ratio=0.0005"]
    problem = problem_of(load_scene("duffing", settings))
    rest, limits = static_equilibrium(problem), (TURN * 4.9, TURN * 6.0)
    options = CurveOptions(*limits, error=1e-5, stability=False)
    curve = list(frequency_response(problem, rest, options))
    (peak,) = (each for each in curve if each.event == "peak")

    found = one_harmonic_response(problem, rest, limits)
    error = one_harmonic_error(problem, rest, found, limits, 1e-6, free=True)

    size = found.amplitudes(problem.probes.rows) / peak.amplitudes(problem.probes.rows)
    shift = abs(found.frequency / peak.frequency - 1.0)
    assert error.frequency == pytest.approx(shift, abs=1e-6)
    assert error.amplitude == pytest.approx(abs(float(size[0]) - 1.0), abs=1e-5)
    assert 1e-4 < error.frequency < error.amplitude < 1e-3


def test_a_structure_without_elements_answers_in_one_harmonic() -> None:
    ratio, natural = 0.01, 100.0
    problem = system(
        mass=[1.0], stiffness=[natural**2], damping_ratio=ratio, drive={"x1": 1.0}
    )
    rest, limits = static_equilibrium(problem), (60.0, 140.0)

    found = one_harmonic_response(problem, rest, limits)
    error = one_harmonic_error(problem, rest, found, limits, 1e-6, free=True)

    resonance = natural * np.sqrt(1.0 - 2.0 * ratio**2)
    assert found.frequency == pytest.approx(resonance, rel=1e-6)
    assert (error.amplitude, error.frequency) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_the_shift_is_unknown_where_only_the_same_frequency_has_a_response(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = problem_of(load_scene("duffing", []))
    rest, limits = static_equilibrium(problem), (TURN * 4.0, TURN * 7.0)
    found = one_harmonic_response(problem, rest, limits)
    monkeypatch.setattr("hbm.one_harmonic.responses_across", lambda *_: lost())

    def lost() -> Iterator[PeriodicResponse]:
        raise ContinuationError("no response is found")
        yield

    error = one_harmonic_error(problem, rest, found, limits, 1e-3, free=True)

    assert 0.0 < error.amplitude < 0.01
    assert np.isnan(error.frequency)


def test_a_response_of_another_branch_has_no_error(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = problem_of(load_scene("duffing", []))
    rest, limits = static_equilibrium(problem), (TURN * 4.0, TURN * 7.0)
    found = one_harmonic_response(problem, rest, limits)
    monkeypatch.setattr("hbm.one_harmonic.ELSEWHERE", 1e-4)

    error = one_harmonic_error(problem, rest, found, limits, 1e-3)

    assert np.isnan(error).all()


def test_a_curve_that_does_not_pass_a_frequency_is_refused(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    elsewhere = iter([swinging(1.0, TURN * 8.0, 64)])
    monkeypatch.setattr("hbm.one_harmonic.frequency_response", lambda *_: elsewhere)

    with pytest.raises(ContinuationError, match="does not pass 9 Hz"):
        one_harmonic_response(problem, static_equilibrium(problem), DUFFING, TURN * 9.0)
