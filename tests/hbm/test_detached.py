"""Detached curves of a block that sticks unless it already slides fast."""

import functools
from collections.abc import Iterator

import numpy as np
import pytest

from hbm.curves.drive_search import FAR, MOST, Sought
from hbm.errors import PLACE, ContinuationError
from hbm.options import CurveOptions
from hbm.solve import detached, frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from small_problems import dwelled, last_harmonic, oscillator, sliding_block
from timedomain.record.start import Start

MASS, STIFFNESS, DAMPING, DRIVE, DYNAMIC = 2.0, 300.0, 2.0, 1.5, 0.3
BLOCK = sliding_block(
    mass=MASS,
    stiffness=STIFFNESS,
    damping=DAMPING,
    drive=DRIVE,
    load=1.0,
    dynamic=DYNAMIC,
    static=2.0,
    stribeck=0.05,
    threshold=1e-3,
    friction=2,
)
"""friction at rest holds against the drive, friction at speed does not"""
OPTIONS = CurveOptions(8.0, 18.0)
PERIODS, STEPS = 60, 2000
ASIDE = 1.02
"""times the motion with which a march begins"""


def sought(
    problem: Problem, curve: list[PeriodicResponse], effort: float = 1.0
) -> tuple[list[PeriodicResponse], list[Sought]]:
    """Return what is detached from a curve, and how it was sought."""
    found = list(
        detached(
            problem,
            static_equilibrium(problem),
            OPTIONS,
            curve,
            frequencies=3,
            effort=effort,
        )
    )
    responses = [each for each in found if not isinstance(each, Sought)]
    return responses, [each for each in found if isinstance(each, Sought)]


@functools.cache
def known() -> list[PeriodicResponse]:
    return list(frequency_response(BLOCK, static_equilibrium(BLOCK), OPTIONS))


@functools.cache
def curves() -> tuple[list[PeriodicResponse], list[PeriodicResponse]]:
    """Return the curve of the sticking block, and what is detached from it."""
    return known(), sought(BLOCK, known())[0]


def amplitude(response: PeriodicResponse) -> float:
    return float(np.hypot(*response.coefficients[1:3, 0]))


def kept(response: PeriodicResponse) -> float:
    """Return the amplitude after many periods from beside a response, over its own."""
    displacement, velocity = (ASIDE * part[0] for part in response.at(np.zeros(1)))
    history = dwelled(
        BLOCK,
        response.frequency,
        periods=PERIODS,
        steps=STEPS,
        start=Start(displacement, velocity),
    )
    return float(np.abs(last_harmonic(history)[0])) / amplitude(response)


def test_the_sticking_block_has_one_detached_curve() -> None:
    curve, other = curves()

    assert max(map(amplitude, curve)) < 1e-3
    # It leaves the range at its lowest frequency, to both sides.
    events = [each.event for each in other]
    assert events.count("detached") == 2
    assert events.count("fold") == events.count("peak") == 1
    assert [each.frequency for each in other].count(OPTIONS.start) == 2


def test_its_peak_balances_drive_against_friction_and_damping() -> None:
    _, other = curves()
    peak = max((each for each in other if each.event == "peak"), key=amplitude)

    # One harmonic at the frequency of the free block: F = c ω a + 4 µd N / π, friction
    # being a little more than µd N on the way through rest.
    natural = np.sqrt(STIFFNESS / MASS)
    highest = (DRIVE - 4.0 * DYNAMIC / np.pi) / (DAMPING * natural)
    assert 0.93 * highest < amplitude(peak) < highest
    assert peak.frequency == pytest.approx(natural, rel=5e-3)


@pytest.mark.long
def test_stable_points_of_it_are_kept_by_a_march_and_unstable_ones_left() -> None:
    _, other = curves()
    plain = [each for each in other if not each.event]
    # Close to the fold a motion leaves and comes back slowly.
    stable = [each for each in plain if abs(each.multipliers[0]) < 0.9][::6]
    growing = [each for each in plain if abs(each.multipliers[0]) > 1.1][::6]

    assert len(stable) >= 3
    assert len(growing) >= 2
    for response in stable:
        assert kept(response) == pytest.approx(1.0, abs=5e-3)
    for response in growing:
        assert abs(kept(response) - 1.0) > 0.2


def test_a_linear_block_has_no_detached_curve() -> None:
    problem = oscillator()
    curve = list(frequency_response(problem, static_equilibrium(problem), OPTIONS))

    found, places = sought(problem, curve)

    assert found == []
    assert [each.share for each in places] == [FAR] * 3
    assert {each.cause + each.lost for each in places} == {""}


def test_a_search_without_the_effort_for_it_says_how_far_it_came() -> None:
    found, places = sought(BLOCK, known(), effort=0.02)

    assert found == []
    assert [each.frequency for each in places] == pytest.approx([29 / 3, 13, 49 / 3])
    assert all(0.0 < each.share < MOST for each in places)
    assert all("40 evaluations, is spent" in each.cause for each in places)


@pytest.mark.long
def test_a_curve_that_takes_more_than_the_effort_is_followed_in_part(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    whole = curves()[1]
    monkeypatch.setattr("hbm.curves.detached.FOLLOWING", 5000.0)

    found, places = sought(BLOCK, known())

    assert found[0].event == "detached"
    assert "5000 evaluations, is spent" in places[0].lost
    assert 1 < len(found) < len(whole)
    together = zip(found[:2], whole, strict=False)
    assert all(one.frequency == other.frequency for one, other in together)


def test_what_ends_early_says_at_which_drive_and_a_curve_at_which_frequency(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def stuck(*_: object) -> Iterator[PeriodicResponse]:
        raise ContinuationError(f"stuck at {PLACE}", 3.0)
        yield

    whole = known()
    with monkeypatch.context() as patch:
        patch.setattr("hbm.curves.detached.Tracer.from_response", stuck)
        _, curves_lost = sought(BLOCK, whole)
    monkeypatch.setattr("hbm.curves.drive_search.Tracer.responses", stuck)
    _, drives_stopped = sought(BLOCK, whole)

    lost = {each.lost for each in curves_lost if each.lost}
    assert lost == {"stuck at 0.477464829 Hz"}
    assert {each.cause for each in drives_stopped} == {"stuck at 3 times the drive"}


def test_an_effort_is_positive() -> None:
    rest = static_equilibrium(BLOCK)
    with pytest.raises(ValueError, match="effort 0: give a positive number"):
        next(detached(BLOCK, rest, OPTIONS, [], effort=0.0))
