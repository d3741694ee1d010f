"""The study of orbits: honest curves agree, wrong ones fail, and where they lie."""

import dataclasses
import functools

import numpy as np
import pytest

from contact_tables import contact_points
from microslip.studies.curve import Traced
from microslip.studies.verify.orbits import (
    Verdict,
    beyond,
    spread,
    too_many,
    verdicts,
    whereabouts,
)
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from small_problems import TANGENT, cubic_oscillator, mass_on_contact, sliding_block
from timedomain.shooting.comparison import Comparison, compared
from traced_curves import traced

LOOSE = 1.0
"""a tolerance that decides nothing"""


@functools.cache
def block(dynamic: float = 0.3) -> tuple[Problem, Traced]:
    """Return a block that rubs, and its curve."""
    problem = sliding_block(
        stiffness=300.0,
        damping=0.5,
        drive=1.5,
        load=1.0,
        dynamic=dynamic,
        threshold=1e-3,
    )
    return problem, traced(problem, 6.0, 20.0)


@functools.cache
def folded() -> tuple[Problem, Traced]:
    """Return Duffing's oscillator, and its curve with two folds."""
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    return problem, traced(problem, 0.8, 2.4)


def judged(
    problem: Problem, curve: Traced, count: int = 8, tolerance: float = LOOSE
) -> list[Verdict]:
    places = spread(curve, count)
    return list(verdicts(problem, curve, places, tolerance=tolerance))


def changed(curve: Traced, responses: list[PeriodicResponse]) -> Traced:
    return dataclasses.replace(curve, responses=tuple(responses))


@pytest.mark.parametrize("make", [block, folded])
def test_an_honest_curve_agrees_within_both_estimates(make: type) -> None:
    problem, curve = make()

    found = judged(problem, curve)

    assert [each.cause for each in found] == [""] * len(found)
    for each in found:
        assert each.comparison is not None
        # the estimates admit something, and no more than was asked for
        assert 0.0 < each.comparison.admitted < 4e-3
        assert each.comparison.harmonics[0] < 1e-3
    assert not too_many(found)
    assert not any(each.doubted for each in found)


@pytest.mark.parametrize(
    ("count", "wrong", "many"),
    [(4, 1, False), (4, 2, True), (12, 3, False), (12, 4, True)],
)
def test_a_quarter_may_be_beyond_both_estimates(
    count: int, wrong: int, many: bool
) -> None:
    found = judged(*block())
    within = next(each for each in found if each not in beyond(found))
    lost = dataclasses.replace(within, comparison=None, cause="no orbit")

    assert too_many([within] * (count - wrong) + [lost] * wrong) is many


def test_a_curve_scaled_by_one_per_cent_fails_at_every_point() -> None:
    problem, curve = block()
    scaled = [
        dataclasses.replace(each, coefficients=1.01 * each.coefficients)
        for each in curve.responses
    ]

    found = judged(problem, changed(curve, scaled))

    assert too_many(found)
    for each in found:
        assert "amplitudes differ by" in each.cause
        assert "more than 3 x the estimate" in each.cause
        assert "harmonics that differ most: 1 (1e-02)" in each.cause
        assert each.comparison is not None
        assert each.comparison.difference == pytest.approx(0.01 / 1.0, rel=0.15)


def test_a_curve_of_another_friction_coefficient_fails_where_it_slides() -> None:
    problem, curve = block()
    _, other = block(dynamic=0.306)

    found = judged(problem, other)

    wrong = [each for each in found if each.cause]
    assert len(wrong) >= len(found) // 2
    assert all("more than 3 x the estimate" in each.cause for each in wrong)
    assert not any(each.cause for each in judged(problem, curve))


def test_a_curve_wrong_by_little_fails_by_its_number_of_points() -> None:
    problem, curve = block()
    scaled = [
        dataclasses.replace(
            each, coefficients=1.0015 * each.coefficients, error=max(each.error, 6e-4)
        )
        for each in curve.responses
    ]

    found = judged(problem, changed(curve, scaled))

    assert not all(each.cause for each in found)
    assert too_many(found)


def test_a_wrong_third_harmonic_is_named() -> None:
    problem, curve = block()
    wrong = []
    for each in curve.responses:
        coefficients = each.coefficients.copy()
        coefficients[:3] *= 1.01
        coefficients[5] += 0.1 * np.abs(coefficients[1:3]).max()
        wrong.append(dataclasses.replace(each, coefficients=coefficients))

    (first, *_) = judged(problem, changed(curve, wrong), 2)

    assert "harmonics that differ most: 3 (" in first.cause


def test_a_tolerance_below_the_difference_fails_and_says_so() -> None:
    problem, curve = block()

    found = judged(problem, curve, 3, tolerance=1e-12)

    assert len(found) >= 3
    assert all("more than the tolerance 1e-12" in each.cause for each in found)


def test_where_there_is_no_orbit_the_cause_is_that_of_shooting() -> None:
    _, curve = block()
    points = contact_points(
        stiffness=0.0, damping=0.0, constant_load=True, load=1.0, threshold=0.02
    )
    dragged = mass_on_contact(points, direction=TANGENT, preload=0.1, drive=1.0)

    (found,) = verdicts(dragged, curve, [0], tolerance=LOOSE)

    assert found.comparison is None
    assert "that nothing holds" in found.cause


def test_a_stability_that_shooting_denies_is_doubted() -> None:
    problem, curve = folded()
    (place,) = [p for p, each in enumerate(curve.responses) if each.unstable > 0][:1]
    others = list(curve.responses)
    others[place] = dataclasses.replace(
        others[place], multipliers=np.array([0.5, 0.1], complex)
    )

    (found,) = verdicts(problem, changed(curve, others), [place + 1], tolerance=LOOSE)
    (wrong,) = verdicts(problem, changed(curve, others), [place], tolerance=LOOSE)

    assert not found.doubted
    assert wrong.comparison is not None
    assert wrong.doubted or wrong.comparison.found_multiplier < 1.003


@pytest.mark.parametrize(
    ("multiplier", "said"),
    [
        (0.7, "stable by shooting"),
        (1.3, "unstable by shooting"),
        (1.0005, "of unknown stability"),
    ],
)
def test_a_stability_that_harmonic_balance_does_not_know_is_that_of_shooting(
    monkeypatch: pytest.MonkeyPatch, multiplier: float, said: str
) -> None:
    problem, curve = block()
    unknown = dataclasses.replace(curve.responses[0], multipliers=np.array([]))

    def shot(problem: Problem, response: PeriodicResponse) -> Comparison:
        made = compared(problem, response)
        return dataclasses.replace(
            made, found_multiplier=multiplier, multiplier_error=1e-3
        )

    monkeypatch.setattr("microslip.studies.verify.orbits.compared", shot)
    (verdict,) = verdicts(problem, changed(curve, [unknown]), [0], tolerance=LOOSE)

    assert verdict.whereabouts == said


def test_points_say_before_or_after_which_fold_they_lie() -> None:
    _, curve = folded()
    names = whereabouts(curve.responses)
    events = [each.event for each in curve.responses]
    first, second = (place for place, name in enumerate(events) if name == "fold")

    assert set(names[:first]) == {"stable, before the first fold"}
    assert set(names[first + 1 : second]) == {"unstable, after fold 1"}
    assert set(names[second + 1 :]) == {"stable, after fold 2"}


def test_branches_and_detached_curves_are_named_and_count_their_own_folds() -> None:
    _, curve = folded()
    plain = dataclasses.replace(curve.responses[0], event="")
    made = [
        dataclasses.replace(plain, event=event)
        for event in ("", "fold", "branch", "", "branch", "detached", "fold", "")
    ]

    assert [name.removeprefix("stable") for name in whereabouts(made)] == [
        ", before the first fold",
        ", after fold 1",
        ", branch 1",
        ", branch 1",
        ", branch 2",
        ", detached curve 1, before the first fold",
        ", detached curve 1, after fold 1",
        ", detached curve 1, after fold 1",
    ]


@pytest.mark.parametrize("count", [1, 2, 5, 12])
def test_spread_holds_both_ends_the_peak_and_every_part(count: int) -> None:
    _, curve = folded()

    places = spread(curve, count)

    names = [curve.responses[place].event for place in places]
    assert places == sorted(set(places))
    assert places[0] == 0
    assert places[-1] == len(curve.responses) - 1
    assert set(names) <= {"", "peak"}
    highest = int(curve.curve.amplitude.max(axis=1).argmax())
    assert highest in places
    assert count <= len(places) <= count + 3
    if count == 12:
        assert any(curve.responses[place].unstable > 0 for place in places)


def test_what_may_be_beyond_a_fold_is_not_looked_at() -> None:
    _, traced = folded()
    curve = traced.curve
    fold = curve.event.index("fold")
    errors = curve.parameter_error.copy()
    errors[fold] = 1.5 * abs(curve.parameter[fold + 2] - curve.parameter[fold])
    doubted = np.abs(curve.parameter - curve.parameter[fold]) <= errors[fold]
    wide = dataclasses.replace(curve, parameter_error=errors)

    places = spread(dataclasses.replace(traced, curve=wide), len(curve.event))

    near = {fold - 1, fold + 1, fold + 2} & set(np.flatnonzero(doubted))
    assert {fold + 1, fold + 2} <= near
    assert not near & set(places)
    # another part of the curve at these frequencies is
    assert len(set(places) & set(np.flatnonzero(doubted))) > 0
