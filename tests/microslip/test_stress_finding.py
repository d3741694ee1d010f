"""How both solvers' answers to a case under stress are judged."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from hbm.options import CurveOptions
from microslip.studies.clock import Clock
from microslip.studies.curve import Traced
from microslip.studies.stress import witness as stress_witness
from microslip.studies.stress.case import Case
from microslip.studies.stress.curve import Drawn
from microslip.studies.stress.finding import Finding, Outcome, Tried, judged, rate
from microslip_mechanics.results.response import PeriodicResponse
from small_problems import prescribed
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.comparison import Comparison


def comparison(difference: float, estimated: float, multiplier: float) -> Comparison:
    """Return one with amplitudes that differ, as harmonic balance estimates or not."""
    return Comparison(
        prescribed(1.0),
        np.array([1.0 - difference]),
        np.array([1.0]),
        estimated / 3.0,
        0.0,
        np.zeros(2),
        0.9,
        multiplier,
        0.0,
        1024,
    )


@pytest.mark.parametrize(
    ("difference", "estimated", "multiplier", "outcome"),
    [
        (1e-4, 1e-3, 0.9, Outcome.AGREES),
        (5e-3, 1e-3, 0.9, Outcome.WITHIN),
        (1e-4, 1e-3, 1.5, Outcome.WITHIN),
        (0.05, 0.1, 0.9, Outcome.HONEST),
        (0.05, 1e-3, 0.9, Outcome.DISAGREES),
    ],
)
def test_a_comparison_is_judged(
    difference: float, estimated: float, multiplier: float, outcome: Outcome
) -> None:
    found, cause = judged(comparison(difference, estimated, multiplier))

    assert found is outcome
    assert bool(cause) is (outcome is not Outcome.AGREES)


@pytest.mark.parametrize(
    ("difference", "outcome"), [(0.05, Outcome.HONEST), (0.2, Outcome.DISAGREES)]
)
def test_a_witness_that_errs_by_more_than_one_per_cent_does_not_decide_little(
    difference: float, outcome: Outcome
) -> None:
    sure = comparison(difference, 1e-3, 0.9)

    found, cause = judged(replace(sure, found_error=0.02))

    assert judged(sure)[0] is Outcome.DISAGREES
    assert found is outcome
    doubt = "shooting is no better than 2.0e-02"
    assert cause.endswith(doubt) is (outcome is Outcome.HONEST)


NOBODY: Any = None


def drawn_of(response: PeriodicResponse, said: str = "") -> Drawn:
    """Return a whole curve of one point."""
    curve: Any = SimpleNamespace(
        amplitude=np.ones((1, 1)),
        event=[""],
        ending="complete",
        frequency=np.ones(1),
        harmonics=np.ones(1),
        iterations=np.ones(1),
    )
    return Drawn(Traced(curve, (response,), NOBODY), said)


@pytest.mark.parametrize(
    ("apart", "multiplier", "outcome"),
    [
        (0.003, 0.9, Outcome.WITHIN),
        (0.005, 0.9, Outcome.HONEST),
        (0.05, 0.9, Outcome.HONEST),
        (0.5, 0.9, Outcome.DISAGREES),
        (0.5, 1.5, Outcome.HONEST),
    ],
)
def test_a_march_judges_where_shooting_finds_nothing(
    apart: float, multiplier: float, outcome: Outcome, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nothing(*_: object) -> Comparison:
        raise ShootingError("no orbit")

    def left(*_: object) -> SimpleNamespace:
        marched = np.array([1.0 + apart])
        return SimpleNamespace(
            predicted=np.ones(1), marched=marched, last_distance=apart
        )

    for name, stand_in in (
        ("compared", nothing),
        ("march_periods", lambda *_, **__: []),
        ("agreement", left),
        ("condition", lambda *_: 1.0),
    ):
        monkeypatch.setattr(stress_witness, name, stand_in)
    multipliers = np.array([multiplier + 0.0j])
    response = replace(prescribed(1.0), error=1e-3, multipliers=multipliers)

    *_, found = stress_witness.witnessed(NOBODY, drawn_of(response), Clock(60.0))

    assert found.outcome is outcome
    assert "no orbit by shooting" in found.cause


@pytest.mark.parametrize(
    ("difference", "outcome"), [(1e-3, Outcome.WITHIN), (0.02, Outcome.HONEST)]
)
def test_a_curve_that_stands_in_for_another_agrees_within_one_per_cent_at_best(
    difference: float, outcome: Outcome, monkeypatch: pytest.MonkeyPatch
) -> None:
    unsure = replace(comparison(difference, 1e-3, 0.9), predicted_error=math.inf)
    monkeypatch.setattr(stress_witness, "compared", lambda *_: unsure)
    monkeypatch.setattr(stress_witness, "condition", lambda *_: 1.0)
    coarse = drawn_of(prescribed(1.0), "out of time; instead")

    *_, found = stress_witness.witnessed(NOBODY, coarse, Clock(60.0))

    assert found.outcome is outcome
    assert found.cause.startswith("harmonic balance: out of time; instead")
    assert "confirm" not in found.cause


def test_orbits_that_are_compared_have_multipliers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = comparison(1e-3, 1e-2, 0.9)
    bare = prescribed(1.0)
    known = replace(bare, multipliers=np.array([1.5 + 0.0j]))
    seen: list[PeriodicResponse] = []

    def compared(_: object, response: PeriodicResponse) -> Comparison:
        seen.append(response)
        return told

    monkeypatch.setattr(stress_witness, "with_multipliers", lambda *_: known)
    monkeypatch.setattr(stress_witness, "compared", compared)
    monkeypatch.setattr(stress_witness, "condition", lambda *_: 1.0)
    drawn = drawn_of(bare)._replace(options=CurveOptions(1.0, 2.0))

    *_, found = stress_witness.witnessed(NOBODY, drawn, Clock(60.0))

    assert seen == [known]
    assert found.outcome is Outcome.AGREES


def test_the_rate_leaves_out_what_is_refused() -> None:
    solved, refused = Case("mu", "1", ()), Case("nan", "rope", (), refusals=(("a",),))
    found = [
        Tried(solved, Finding(Outcome.AGREES), 1.0),
        Tried(solved, Finding(Outcome.WITHIN), 1.0),
        Tried(solved, Finding(Outcome.HONEST), 1.0),
        Tried(refused, Finding(Outcome.REFUSED), 1.0),
    ]

    assert rate(found) == (2, 3)
