"""The study of a curve: its upward branch, its energy, its resolution."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from hbm.errors import ContinuationError
from microslip.commands.frc_events import barren
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies import curve, detached
from microslip.studies.curve import Wanted, shown_points, trace_curve
from microslip.studies.detached import Searched
from microslip.studies.verify.quasi_static import followed_by, quasi_static_energy
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve


@pytest.fixture
def scene(quick_scene: Path) -> Scene:
    """Return model A on a curve narrow enough to be traced at once."""
    return load_scene(str(quick_scene), ["curve.harmonics=5", "curve.samples=256"])


def curve_with(
    template: ResponseCurve, hertz: ArrayLike, energy: ArrayLike
) -> ResponseCurve:
    """Return a curve of given frequencies [Hz] and energies per period [J]."""
    return dataclasses.replace(
        template,
        frequency=2.0 * np.pi * np.asarray(hertz),
        friction_energy=np.asarray(energy),
    )


def passed(curve: ResponseCurve) -> NDArray[np.int64]:
    """Return the points that a slow upward sweep passes, without any choice."""
    points = curve.frequency.size
    unknown = dataclasses.replace(
        curve, unstable=np.full(points, -1.0), peak=np.ones((points, 2))
    )
    followed, chosen = followed_by(unknown, np.array([1.0, 1e3]), np.ones((2, 2)))
    assert not chosen
    return followed


def test_upward_sweep_follows_all_of_a_curve_without_folds(
    small_curve: ResponseCurve,
) -> None:
    followed = passed(small_curve)

    assert followed.tolist() == [0, 1, 2, 3]


def test_upward_sweep_jumps_from_the_first_fold_over_the_curve_between(
    small_curve: ResponseCurve,
) -> None:
    hertz = [1.0, 2.0, 4.0, 3.0, 2.5, 3.5, 5.0, 6.0]
    folded = curve_with(small_curve, hertz, np.zeros(8))

    followed = passed(folded)

    assert followed.tolist() == [0, 1, 2, 6, 7]


def test_upward_sweep_jumps_over_a_second_fold_too(small_curve: ResponseCurve) -> None:
    hertz = [1.0, 3.0, 2.0, 2.9, 5.0, 4.0, 4.5, 6.0]
    folded = curve_with(small_curve, hertz, np.zeros(8))

    followed = passed(folded)

    assert followed.tolist() == [0, 1, 4, 7]


def test_upward_sweep_jumps_to_a_piece_that_was_traced_from_the_other_end(
    small_curve: ResponseCurve,
) -> None:
    # from 6 Hz to the fold at 8 Hz and back; from 9 Hz to 6 Hz
    beyond = np.nextafter(8.0, 9.0)
    hertz = [6.0, 7.0, 8.0, 7.0, 6.0, 9.0, 8.5, beyond, 7.0, 6.0]
    events = tuple("restart" if place == 5 else "" for place in range(10))
    folded = curve_with(small_curve, hertz, [5.0] * 5 + [1.0] * 5)
    pieces = dataclasses.replace(folded, event=events)

    followed = passed(pieces)
    energy = quasi_static_energy(pieces, 0.5, (6.0, 9.0), passed(pieces))

    assert followed.tolist() == [0, 1, 2, 7, 6, 5]
    assert energy == pytest.approx((5.0 * 2.0 + 1.0 * 1.0) / 0.5, rel=1e-12)


def test_upward_sweep_passes_a_curve_that_was_traced_downwards_in_two_pieces(
    small_curve: ResponseCurve,
) -> None:
    hertz = [9.0, 8.0, 8.5, 7.5, 7.4, 6.0]
    down = curve_with(small_curve, hertz, np.zeros(6))
    pieces = dataclasses.replace(down, event=("", "", "", "", "restart", ""))

    assert passed(pieces).tolist() == [5, 4, 3, 2, 0]


@pytest.mark.parametrize("landing", [1.0, 3.0])
def test_a_sweep_shows_on_which_of_two_stable_branches_it_lands(
    landing: float, small_curve: ResponseCurve
) -> None:
    # up to a fold at 4 Hz, back (unstable), up on a branch of 3 mm to 6 Hz, back, up
    # on one of 1 mm
    hertz = [1.0, 2.0, 4.0, 3.5, 3.0, 3.2, 5.0, 6.0, 5.5, 3.5, 3.0, 3.1, 5.0, 8.0]
    size = [2.0, 2.0, 2.0, 2.5, 3.0, 3.0, 3.0, 3.0, 2.0, 1.5, 1.0, 1.0, 1.0, 1.0]
    unstable = [0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0]
    folded = dataclasses.replace(
        curve_with(small_curve, hertz, np.zeros(14)),
        peak=np.repeat(np.array(size)[:, None], 2, axis=1),
        unstable=np.array(unstable, dtype=float),
    )
    cycles = np.linspace(1.0, 8.0, 300)
    swing = np.where(cycles < 4.1, 2.0, np.where(cycles < 6.0, landing, 1.0))

    followed, chosen = followed_by(folded, cycles, np.stack([swing, swing], axis=1))

    assert chosen == [pytest.approx(4.0)]
    beyond = [12, 13] if landing == 1.0 else [6, 7, 13]
    assert followed.tolist() == [0, 1, 2, *beyond]


def test_a_sweep_without_a_choice_follows_what_any_slow_one_does(
    small_curve: ResponseCurve,
) -> None:
    hertz = [1.0, 2.0, 4.0, 3.0, 2.5, 3.5, 5.0, 6.0]
    folded = dataclasses.replace(
        curve_with(small_curve, hertz, np.zeros(8)),
        peak=np.ones((8, 2)),
        unstable=np.array([0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
    )
    unknown = dataclasses.replace(folded, unstable=np.full(8, -1.0))
    cycles = np.linspace(1.0, 6.0, 50)

    for made in (folded, unknown):
        followed, chosen = followed_by(made, cycles, np.ones((50, 2)))
        assert followed.tolist() == [0, 1, 2, 6, 7]
        assert not chosen


def test_energy_of_a_slow_sweep_is_the_integral_along_the_upward_branch(
    small_curve: ResponseCurve,
) -> None:
    # 2 J up to the fold at 4 Hz, 9 J on the branch between, 1 J after the jump
    beyond = np.nextafter(4.0, 5.0)
    hertz = [1.0, 2.0, 4.0, 3.0, 2.5, beyond, 6.0]
    folded = curve_with(small_curve, hertz, [2.0, 2.0, 2.0, 9.0, 9.0, 1.0, 1.0])

    energy = quasi_static_energy(folded, 0.5, (1.0, 6.0), passed(folded))

    # ∫ E df = 2 (4 − 1) + 1 (6 − 4), over the rate
    assert energy == pytest.approx((6.0 + 2.0) / 0.5, rel=1e-12)


def test_energy_of_a_slow_sweep_is_that_between_its_ends_alone(
    small_curve: ResponseCurve,
) -> None:
    hertz, joule = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [90.0, 7.0, 2.0, 2.0, 8.0, 50.0]
    wider = curve_with(small_curve, hertz, joule)

    energy = quasi_static_energy(wider, 0.5, (2.5, 4.5), passed(wider))

    # trapezoids from 4.5 J at 2.5 Hz over 2 J at 3 and at 4 Hz to 5 J at 4.5 Hz
    area = 0.5 * (4.5 + 2.0) / 2.0 + 2.0 + 0.5 * (2.0 + 5.0) / 2.0
    assert energy == pytest.approx(area / 0.5, rel=1e-12)


@pytest.mark.parametrize("outside", [0.0, 3.0])
def test_energy_of_a_slow_sweep_is_exact_for_a_linear_course(
    outside: float, small_curve: ResponseCurve
) -> None:
    hertz = np.array([125.0 - outside, 125.5, 130.0, 144.0, 145.0 + outside])
    linear = curve_with(small_curve, hertz, 1e-3 * (hertz - 125.0))

    rate = np.log(145.0 / 125.0) / 6.0
    energy = quasi_static_energy(linear, rate, (125.0, 145.0), passed(linear))

    exact = 1e-3 * 20.0**2 / 2.0 * 6.0 / np.log(145.0 / 125.0)
    assert energy == pytest.approx(exact, rel=1e-12)


def test_energy_of_a_slow_sweep_is_what_its_periods_dissipate(
    small_curve: ResponseCurve,
) -> None:
    start, end, duration, joule = 125.0, 145.0, 60.0, 1e-4
    hertz = np.linspace(start, end, 50)
    constant = curve_with(small_curve, hertz, np.full(50, joule))
    rate = np.log(end / start) / duration

    energy = quasi_static_energy(constant, rate, (125.0, 145.0), passed(constant))

    # an exponential sweep passes (end − start) / rate periods
    time = np.linspace(0.0, duration, 100_001)
    periods = np.trapezoid(start * np.exp(rate * time), time)
    assert energy == pytest.approx(joule * periods, rel=1e-6)


def test_shown_points_hold_both_ends_and_the_largest(
    small_curve: ResponseCurve,
) -> None:
    hertz = np.linspace(125.0, 145.0, 500)
    curve = curve_with(small_curve, hertz, np.zeros(500))

    places = shown_points(curve, largest=123)

    assert {0, 123, 499} <= set(places)
    assert places == sorted(places)
    assert len(places) == 12


def test_a_curve_that_comes_back_is_shown_as_far_as_it_went(
    small_curve: ResponseCurve,
) -> None:
    there = np.linspace(125.0, 145.0, 250)
    hertz = np.concatenate([there, there[::-1]])
    curve = curve_with(small_curve, hertz, np.zeros(500))

    shown = hertz[shown_points(curve, largest=123)]

    assert (shown.min(), shown.max()) == (125.0, 145.0)
    assert len(shown) == 12


def test_curve_of_few_points_is_shown_whole(small_curve: ResponseCurve) -> None:
    assert shown_points(small_curve, largest=2) == [0, 1, 2, 3]


def test_traced_curve_runs_from_end_to_end_of_the_scene(scene: Scene) -> None:
    problem = problem_of(scene)

    traced = trace_curve(problem, scene.curve)

    hertz = traced.curve.frequency / (2.0 * np.pi)
    assert hertz[[0, -1]] == pytest.approx([130.0, 130.2], rel=1e-12)
    assert traced.curve.ending == "complete"
    assert len(traced.responses) == len(hertz)
    assert traced.curve.probes == problem.probes.names
    np.testing.assert_allclose(traced.rest.normal_force, [2.924, 2.747], rtol=2e-4)


def test_watch_sees_every_point_of_a_curve(scene: Scene) -> None:
    seen: list[float] = []

    def watch(responses):  # type: ignore[no-untyped-def]
        for response in responses:
            seen.append(response.frequency)
            yield response

    traced = trace_curve(problem_of(scene), scene.curve, watch)

    assert seen == traced.curve.frequency.tolist()


def test_scene_without_harmonics_is_traced_to_its_tolerance(quick_scene: Path) -> None:
    text = quick_scene.read_text().replace("harmonics = 1\nsamples = 16\n", "")
    quick_scene.write_text(text)
    band = ["curve.lowest=134.6", "curve.highest=134.9", "curve.tolerance=5e-3"]
    scene = load_scene(str(quick_scene), band)

    curve = trace_curve(problem_of(scene), scene.curve).curve

    assert curve.ending == "complete"
    assert (curve.error > 0.0).all()
    assert curve.error.max() <= 5e-3
    assert curve.harmonics.max() > curve.harmonics.min()
    assert (curve.samples >= 4 * curve.harmonics + 2).all()


def test_scene_with_harmonics_keeps_them_and_reports_the_error(scene: Scene) -> None:
    curve = trace_curve(problem_of(scene), scene.curve).curve

    assert set(curve.harmonics) == {5.0}
    assert set(curve.samples) == {256.0}
    assert np.isfinite(curve.error).all()


def test_branches_of_detached_curves_are_followed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    loud = ("drive.x=26.8 N", "structure.damping_ratio=0.1", "curve.highest=8 Hz")
    scene = load_scene("duffing", loud)
    problem = problem_of(scene)
    whole = trace_curve(problem, scene.curve).responses
    places = [each.frequency for each in whole if each.event == "branch point"]
    assert len(places) == 2
    # as if all but the first points were found by the search for what is detached
    monkeypatch.setattr(curve, "frequency_response", lambda *_: iter(whole[:2]))
    found = Searched(whole[2:], (), 0, interrupted=False)
    monkeypatch.setattr(detached, "search", lambda *_, **__: found)

    traced = trace_curve(problem, scene.curve, wanted=Wanted(True, True))

    begun = [each.frequency for each in traced.responses if each.event == "branch"]
    assert traced.curve.ending == "complete"
    assert begun
    assert set(begun) <= set(places)
    assert len(traced.responses) > len(whole) + 10


@pytest.mark.parametrize("before", [0, 1])
@pytest.mark.parametrize(
    ("cause", "ending"),
    [
        (ContinuationError("too far"), "a branch was lost: too far"),
        (KeyboardInterrupt(), "interrupted"),
    ],
)
def test_a_branch_of_a_detached_curve_that_is_lost_leaves_what_there_is(
    cause: BaseException,
    ending: str,
    before: int,
    scene: Scene,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def lost(*given: Any) -> Iterator[PeriodicResponse]:
        yield from given[-1][:before]
        raise cause

    problem = problem_of(scene)
    whole = trace_curve(problem, scene.curve).responses
    found = Searched(whole[:1], (), 0, interrupted=False)
    monkeypatch.setattr(detached, "search", lambda *_, **__: found)
    monkeypatch.setattr(curve, "_all", lambda *_: iter(whole))
    monkeypatch.setattr(curve, "branches", lost)

    traced = trace_curve(problem, scene.curve, wanted=Wanted(True, True))

    assert traced.curve.ending == ending
    assert len(traced.responses) == len(whole) + 1 + before


def test_what_branches_off_branches_is_not_missed(small_curve: ResponseCurve) -> None:
    hertz = np.array([1.0, 1.0, 2.0, 3.0])
    events = ("branch point", "branch", "branch point", "")
    of_branches = dataclasses.replace(
        small_curve, frequency=2.0 * np.pi * hertz, event=events
    )
    of_detached = dataclasses.replace(
        of_branches, event=("branch point", "branch", "detached", "branch point")
    )

    assert barren(of_branches) == []
    assert barren(of_detached) == pytest.approx([3.0])
