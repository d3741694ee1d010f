"""The command that compares jumps with folds: verdict, picture, refusals."""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

import traced_curves
from microslip.commands.verify_sweeps import HELD
from microslip.figures.jumps import JumpLine, jumps_figure
from microslip.studies.curve import Traced
from microslip.studies.jumps.folds import Fold, folds_of
from microslip.studies.jumps.jumps import LEAST, Jump
from microslip.studies.jumps.sweeps import Sweep
from microslip.studies.verify.verify import StudyError
from microslip_mechanics.problem import Probes
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve, response_curve
from small_problems import cubic_oscillator

Run: TypeAlias = Callable[..., tuple[int, str, str]]
RATES = np.array([8.0, 4.0, 2.0, 1.0])


@pytest.fixture(scope="module")
def traced() -> Traced:
    """Return the curve of Duffing's oscillator, with two folds."""
    return traced_curves.traced(cubic_oscillator(drive=0.3, damping=0.1), 0.8, 2.4)


def made(
    traced: Traced,
    away: float,
    fit: float = 1e-6,
    step: float = 0.0,
    known: float = math.nan,
) -> list[Jump]:
    """Return jumps that lie so far behind their folds once extrapolated [Hz].

    Their folds are ``known`` to that [Hz].
    """
    problem, found = cubic_oscillator(drive=0.3, damping=0.1), []
    for fold in folds_of(problem, traced, lead=0.1):
        sign = 1.0 if fold.upward else -1.0
        late = away + 1e-3 * RATES ** (2.0 / 3.0)
        places, slow = fold.hertz + sign * late, fold.hertz + sign * away
        envelopes = tuple((places, 0.1 * places) for _ in RATES)
        told = replace(fold.response, parameter_error=2.0 * np.pi * known)
        found.append(
            Jump(
                replace(fold, response=told), RATES, places, slow, fit, step, envelopes
            )
        )
    return found


def beside(
    traced: Traced, factor: float, *, count: int | None = None, stable: bool = True
) -> Traced:
    """Return a curve with a second piece, of so many times its first stable points."""
    others = [
        replace(
            each,
            coefficients=factor * each.coefficients,
            multipliers=np.array([0.5 if stable else 2.0 + 0j]),
            event="",
        )
        for each in traced.responses
        if each.unstable == 0
    ][:count]
    others[0] = replace(others[0], event="restart")
    every = (*traced.responses, *others)
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    return Traced(response_curve(problem, every, "complete"), every, traced.rest)


def test_a_jump_lands_on_the_nearest_stable_motion_behind_the_fold(
    traced: Traced,
) -> None:
    problem = cubic_oscillator(drive=0.3, damping=0.1)

    up, down = folds_of(problem, traced, lead=0.1)

    # Duffing's backbone bends to the right: up it falls, down it rises
    assert (up.upward, up.falls) == (True, True)
    assert (down.upward, down.falls) == (False, False)
    curve, stable = traced.curve, traced.curve.unstable == 0
    for fold, branch in ((up, slice(None, None, -1)), (down, slice(None))):
        # the branch on which it lands is traced last, or first
        place = fold.response.frequency
        last = np.flatnonzero(stable)[branch]
        end = next(n for n, each in enumerate(np.diff(last)) if abs(each) > 1)
        landing = np.sort(last[: end + 1])
        there = np.interp(place, curve.frequency[landing], curve.amplitude[landing, 0])
        here = np.hypot(*fold.response.coefficients[1:3, 0])
        assert fold.height == pytest.approx(0.5 * (here + there), rel=1e-3)

    # what lies farther away, or is not stable, changes nothing, nor does the way from
    # one piece to another: that to two points at 0.8 Hz would pass 1.78 Hz at 1.05
    for other in (
        beside(traced, 50.0),
        beside(traced, 1.01, stable=False),
        beside(traced, 5.0, count=2),
    ):
        found = folds_of(problem, other, lead=0.1)
        assert [each.height for each in found] == [up.height, down.height]


def test_a_jump_is_seen_where_the_motion_jumps(traced: Traced) -> None:
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    rows = problem.probes.rows
    still = np.concatenate([1e-9 * rows, rows])
    watched = replace(problem, probes=Probes(("still", "mass"), still))
    curve = response_curve(watched, traced.responses, "complete")

    seen = folds_of(watched, replace(traced, curve=curve), lead=0.1)

    for fold, alone in zip(seen, folds_of(problem, traced, lead=0.1), strict=True):
        assert (alone.probe, fold.probe) == (0, 1)
        assert (fold.height, fold.falls) == (alone.height, alone.falls)


def upper_fold(traced: Traced) -> int:
    """Return the place of the fold that ends sweeps upwards."""
    return next(n for n, each in enumerate(traced.responses) if each.event == "fold")


@pytest.mark.parametrize("behind", [1, 2])
def test_sweeps_begin_on_the_piece_of_their_fold(behind: int, traced: Traced) -> None:
    place = upper_fold(traced)
    first = place - behind
    mark = replace(traced.responses[first], event="restart")
    piece = [mark, *traced.responses[first + 1 :]]

    # what is traced before the piece is stable, and as near to the fold
    for count in (0, first - 1):
        response, begin = begun(traced, [*traced.responses[:count], *piece])

        assert response is traced.responses[place]
        assert begin is mark


def test_no_sweep_begins_on_the_piece_behind_the_fold(traced: Traced) -> None:
    place = upper_fold(traced)
    before, fold = traced.responses[place - 1 : place + 1]
    unstable = replace(before, multipliers=np.array([2.0 + 0j]))
    behind = replace(before, event="restart")

    assert begun(traced, [before, fold, behind])[1] is before
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    cut = replace(traced, responses=(unstable, fold, behind))
    assert folds_of(problem, cut, lead=0.5) == []


def begun(
    traced: Traced, responses: list[PeriodicResponse]
) -> tuple[PeriodicResponse, PeriodicResponse]:
    """Return the first fold of such a curve, and where sweeps to it begin."""
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    made = replace(traced, responses=tuple(responses))
    first = folds_of(problem, made, lead=0.5)[0]
    return first.response, first.begin


@pytest.mark.parametrize(
    ("away", "fit", "step", "known", "status"),
    [
        (1e-6, 1e-6, 0.0, math.nan, 0),
        (-2e-5, 1e-6, 0.0, 1e-6, 0),
        (1e-3, 1e-6, 0.0, math.nan, 1),
        (1e-3, 1e-6, 1e-3, 1e-6, 0),
        (1e-3, 3.3e-4, 0.0, math.nan, 0),
        (1e-3, 1e-6, 3.3e-4, 1e-6, 1),
        (1e-3, 1e-6, 0.0, 5e-4, 1),
        (1e-3, 1e-6, 0.0, 1.2e-3, 0),
    ],
)
def test_jumps_far_from_their_folds_decide_the_status(
    away: float,
    fit: float,
    step: float,
    known: float,
    status: int,
    traced: Traced,
    run: Run,
    quick_scene: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    jumps = made(traced, away, fit, step, known)

    def marched(*_: object) -> Iterator[Jump]:
        yield from jumps

    monkeypatch.setattr("microslip.studies.curve.trace_curve", lambda *_: traced)
    monkeypatch.setattr(
        "microslip.studies.jumps.folds.folds_of", lambda *_, **__: [1, 2]
    )
    monkeypatch.setattr("microslip.studies.jumps.jumps.jumps", marched)

    ended, output, error = run("jumps", str(quick_scene))

    assert (ended, error) == (status, "")
    assert output.count(f"the fold is known to {known:.1e}\n") == 2 * (known > 1e-4)
    output = re.sub(", the fold is known to .*", "", output)
    rows = re.findall(r"(up|down) +(\S+) +(\S+) +(\S+)(?: ± (\S+)  (\w+))?\n", output)
    assert [row[0] for row in rows] == ["up"] * 5 + ["down"] * 5
    assert [float(row[1]) for row in rows[:5]] == [8.0, 4.0, 2.0, 1.0, 0.0]
    behind = [float(row[3]) for row in rows[5:]]
    assert behind == pytest.approx([*(away + 1e-3 * RATES ** (2 / 3)), away], abs=6e-5)
    assert [float(row[4]) for row in rows[4::5]] == pytest.approx(
        [fit + step] * 2, rel=0.1
    )
    assert rows[4][5] == rows[9][5] == ("DISAGREE" if status else "agree")
    assert (quick_scene.parent / "quick-jumps.png").is_file()


@pytest.mark.parametrize(
    ("scene", "away", "told"),
    [("jenkins", 1e-3, True), ("jenkins", 1e-6, False), ("duffing", 1e-3, False)],
)
def test_jumps_beside_folds_of_contacts_that_hold_a_force_are_explained(
    scene: str,
    away: float,
    *,
    told: bool,
    traced: Traced,
    run: Run,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    jumps = made(traced, away)
    monkeypatch.setattr("microslip.studies.curve.trace_curve", lambda *_: traced)
    monkeypatch.setattr(
        "microslip.studies.jumps.folds.folds_of", lambda *_, **__: [1, 2]
    )
    monkeypatch.setattr("microslip.studies.jumps.jumps.jumps", lambda *_: iter(jumps))

    _, output, error = run("jumps", scene)

    assert error == ""
    assert (HELD in output) == told


@pytest.mark.parametrize(
    ("stops", "status", "said"),
    [(KeyboardInterrupt(), 130, "interrupted"), (StudyError("no jump"), 1, "no jump")],
)
def test_jumps_found_before_one_fails_are_drawn(
    stops: BaseException,
    status: int,
    said: str,
    traced: Traced,
    run: Run,
    quick_scene: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first, _ = made(traced, 1e-6)

    def marched(*_: object) -> Iterator[Jump]:
        yield first
        raise stops

    monkeypatch.setattr("microslip.studies.curve.trace_curve", lambda *_: traced)
    monkeypatch.setattr("microslip.studies.jumps.jumps.jumps", marched)
    monkeypatch.setattr(
        "microslip.studies.jumps.folds.folds_of", lambda *_, **__: [1, 2]
    )

    ended, output, error = run("jumps", str(quick_scene))

    assert ended == status
    assert error == f"microslip: {said}; what was computed is kept\n"
    assert "agree" in output
    assert (quick_scene.parent / "quick-jumps.png").is_file()


def test_a_curve_without_folds_has_no_jumps(run: Run, quick_scene: Path) -> None:
    ended, output, _ = run("jumps", str(quick_scene), "--set=curve.highest=130.5")

    assert ended == 0
    assert output == "no stable motion ends at a fold: sweeps do not jump\n"


@pytest.mark.parametrize(
    "arguments", [("--rates", "0"), ("--rates", "1", "nan"), ("--lead", "-1")]
)
def test_rates_and_lead_must_be_positive(
    arguments: tuple[str, ...], run: Run, quick_scene: Path
) -> None:
    status, _, error = run("jumps", str(quick_scene), *arguments)

    assert status == 2
    assert "give a positive finite number" in error


def test_less_rates_than_an_extrapolation_needs_are_refused(
    run: Run, quick_scene: Path
) -> None:
    given = ("--rates", *["0.1"] * LEAST)

    status, output, error = run("jumps", str(quick_scene), *given)

    assert (status, output) == (2, "")
    assert error == f"microslip: --rates: give at least {LEAST} different ones\n"


def test_the_picture_shows_curve_envelopes_and_delays(
    small_curve: ResponseCurve,
) -> None:
    hertz = np.linspace(131.0, 133.0, 5)
    late = 1e-2 * RATES ** (2.0 / 3.0)
    line = JumpLine("up", 132.0, RATES, late, 2e-3, 1e-3, [(hertz, 1e-5 * hertz)] * 4)
    plain = replace(small_curve, event=("",) * 4)

    figure = jumps_figure(plain, [line], "title")

    figure.draw_without_rendering()
    left, right = figure.axes
    stable, unstable, *envelopes, fold = left.lines
    assert left.get_xlim() == pytest.approx((130.6, 133.4))
    shown = np.array([each.get_ydata() for each in (stable, unstable)], dtype=float)
    peak = 1e3 * small_curve.peak[:, 0]
    np.testing.assert_allclose(shown[0], [*peak[:2], np.nan, np.nan])
    np.testing.assert_allclose(shown[1], [np.nan, *peak[1:]])
    assert stable.get_linestyle() != unstable.get_linestyle()
    assert stable.get_label() == "curve"  # of the first point it is not known
    for each in envelopes:
        np.testing.assert_allclose(np.asarray(each.get_ydata()), 1e-2 * hertz)
    assert len(envelopes) == 4
    assert np.asarray(fold.get_xdata())[0] == 132.0
    dots = np.asarray(right.lines[0].get_xydata())
    np.testing.assert_allclose(dots, np.stack([RATES ** (2 / 3), late], axis=1))
    assert right.get_ylabel().endswith("[Hz]")


def test_the_picture_is_as_high_as_what_it_shows(small_curve: ResponseCurve) -> None:
    hertz = np.linspace(130.0, 130.5, 5)
    line = JumpLine("up", 130.2, RATES, RATES, 0.0, 1e-3, [(hertz, 1e-6 * hertz)])
    size = np.array([1e-4, 5e-2, 5e-2, 5e-2])[:, None]
    high = replace(small_curve, peak=np.broadcast_to(size, small_curve.peak.shape))

    left, _ = jumps_figure(high, [line], "title").axes

    assert left.get_ylim() == pytest.approx((0.0, 1.08 * 1e3 * 1e-6 * 130.5))


@pytest.mark.parametrize("stops", [KeyboardInterrupt(), StudyError("no jump")])
def test_sweeps_before_one_fails_are_kept(
    stops: BaseException,
    traced: Traced,
    run: Run,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hertz = np.linspace(0.2, 0.3, 5)

    def swept(_: object, fold: Fold, rate: float, *__: object) -> Sweep:
        if rate < 2.0:
            raise stops
        return fold.hertz + rate, fold.hertz + rate, (hertz, 1e-3 * hertz)

    folds = folds_of(cubic_oscillator(drive=0.3, damping=0.1), traced, lead=0.1)
    monkeypatch.setattr("microslip.studies.curve.trace_curve", lambda *_: traced)
    monkeypatch.setattr(
        "microslip.studies.jumps.folds.folds_of", lambda *_, **__: folds
    )
    monkeypatch.setattr("microslip.studies.jumps.jumps.swept_through", swept)

    rates = ("--rates", *(f"{rate:g}" for rate in RATES))
    ended, output, error = run("jumps", "jenkins", *rates)

    assert ended == (130 if isinstance(stops, KeyboardInterrupt) else 1)
    assert error.endswith("; what was computed is kept\n")
    rows = re.findall(r"(up|down) +(\S+) +\S+ +\S+\n", output)
    assert [float(row[1]) for row in rows] == [8.0, 4.0, 2.0]
    assert "agree" not in output.lower()
    assert HELD not in output
    assert (tmp_path / "jenkins-jumps.png").is_file()


@pytest.mark.parametrize(("ending", "code"), [("interrupted", 130), ("lost", 1)])
def test_a_curve_that_is_not_whole_leaves_no_file_and_says_so(
    ending: str, code: int, traced: Traced, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    curve = replace(traced.curve, ending=ending)
    half = replace(traced, curve=curve)
    monkeypatch.setattr("microslip.studies.curve.trace_curve", lambda *_: half)

    status, output, error = run("jumps", "duffing")

    assert (status, output) == (code, "")
    assert error == f"microslip: {ending}; no file is written\n"
