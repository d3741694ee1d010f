"""Stiff and extreme cases: what the matrix covers, and how each ends."""

import csv
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import pytest

from hbm.errors import ContinuationError
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.clock import LATE, Clock, OutOfTimeError, limited
from microslip.studies.curve import curve_options, trace_curve
from microslip.studies.stress import curve as stress_curve
from microslip.studies.stress import stress
from microslip.studies.stress.bad_values import BAD, bad_values
from microslip.studies.stress.budget import Budget
from microslip.studies.stress.case import Case
from microslip.studies.stress.cases import cases
from microslip.studies.stress.finding import Finding, Outcome, Tried
from microslip.studies.stress.stress import tried
from microslip.studies.worker import Ended
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.shooting.closed_march import ShootingError

Run: TypeAlias = Callable[..., tuple[int, str, str]]
ENDS = {
    "sigma": ("3e-06", "3e-11"),
    "V_lim [m/s]": ("0.01", "1e-08"),
    "mu": ("0", "1e+06"),
    "preload [N]": ("0", "1000"),
    "drive [N]": ("1e-06", "1000"),
    "contact damping": ("0", "1"),
    "rope [N/m]": ("0", "1e+06"),
    "element mass x": ("0.001", "1000"),
    "exponent": ("1", "3"),
    "GKF V_str [m/s]": ("0.5", "0.001"),
    "GKF µs/µd": ("1", "5"),
    "damping ratio": ("0", "0.2"),
    "harmonics": ("1", "63"),
}
"""first and last value of rows"""


def test_rows_go_from_one_extreme_to_the_other() -> None:
    rows: dict[str, list[str]] = {}
    for case in cases(load_scene("two-blades")):
        rows.setdefault(case.parameter, []).append(case.value)

    assert {name: (rows[name][0], rows[name][-1]) for name in ENDS} == ENDS


def test_every_case_is_a_scene_of_its_own() -> None:
    chosen = [case for case in cases(load_scene("two-blades")) if not case.refusals]
    rigs = {
        (case.scene, repr((loaded.rig, loaded.curve)))
        for case in chosen
        for loaded in [load_scene(case.scene or "two-blades", case.overrides)]
    }

    assert len(rigs) == len(chosen)


def test_a_quick_look_has_each_row_and_each_bad_value() -> None:
    scene = load_scene("two-blades")

    short, whole = cases(scene, quick=True), cases(scene)

    assert {case.parameter for case in short} == {case.parameter for case in whole}
    assert sum(not case.refusals for case in short) < 20


def test_bad_values_are_given_to_each_number() -> None:
    given = {
        each[0] for case in cases(load_scene("two-blades")) for each in case.refusals
    }

    for name in ("contact.sigma", "rope.stiffness", "sweep.levels", "curve.harmonics"):
        assert given >= {f"{name}={bad}" for bad in BAD}


def test_a_system_is_not_put_under_stress() -> None:
    with pytest.raises(SceneError, match="two blades"):
        cases(load_scene("duffing"))


def test_a_rig_that_nothing_drives_is_not_put_under_stress(run: Run) -> None:
    status, output, error = run("stress", "two-blades", "--set", "excitation.force=0")

    assert (status, output) == (2, "")
    assert "nothing vibrates" in error
    assert error.count("\n") == 1


def test_what_a_scene_does_not_allow_does_not_end_the_process_before_a_case() -> None:
    still = ("model=A", "excitation.force=0")

    stress._prepare("two-blades", still)

    with pytest.raises(ShootingError):
        stress._warmed("two-blades", still)


@pytest.mark.parametrize(
    ("overrides", "ends", "told"),
    [
        # damped enough to be steady in a second: a busy machine has time for it
        (
            ("model=B", "blade.mass_damping=60"),
            ContinuationError("the curve does not go on"),
            "steady there",
        ),
        (("excitation.force=100",), OutOfTimeError(LATE), "not steady there"),
    ],
)
def test_where_no_curve_begins_a_march_from_rest_says_whether_it_settles(
    overrides: tuple[str, ...],
    ends: BaseException,
    told: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def unbegun(*_: object, **__: object) -> None:
        raise ends

    monkeypatch.setattr(stress_curve, "trace_curve", unbegun)
    case = Case("parameter", "value", overrides)

    *_, found = stress._studied("two-blades", (), case, 6.0)

    assert found.outcome is Outcome.HONEST
    assert f"harmonic balance: {ends}; a march" in found.cause
    assert f" is {told} " in found.cause


def test_a_curve_out_of_time_keeps_its_points(compiled: None) -> None:  # noqa: ARG001
    def endless(points: Iterable[PeriodicResponse]) -> Iterator[PeriodicResponse]:
        yield next(iter(points))
        while True:
            pass

    scene = load_scene("two-blades", ("model=A", "curve.harmonics=1"))

    with limited(1.0):
        traced = trace_curve(problem_of(scene), scene.curve, endless)

    assert len(traced.responses) == 1
    assert traced.curve.ending == "out of time"


def late(*_: object, **__: object) -> None:
    raise OutOfTimeError("out of time")


def test_a_curve_of_few_harmonics_stands_in_for_one_that_is_out_of_time(
    compiled: None,  # noqa: ARG001
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = load_scene("two-blades", ("model=A",))
    monkeypatch.setattr(stress_curve, "trace_curve", late)

    made = stress_curve.drawn(problem_of(scene), scene.curve, Clock(60.0))
    traced, said, options = made

    assert options is None
    assert said == "out of time; with 7 harmonics instead"
    assert traced.curve.ending == "complete"
    assert {each.harmonics for each in traced.responses} == {7}
    assert all(math.isinf(each.error) for each in traced.responses)


@pytest.mark.parametrize("override", ["curve.tolerance=1e-3", "curve.harmonics=7"])
def test_without_time_or_with_harmonics_that_are_given_nothing_stands_in(
    override: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load_scene("two-blades", ("model=A", override))
    monkeypatch.setattr(stress_curve, "trace_curve", late)
    seconds = 60.0 if "harmonics" in override else 0.0

    with pytest.raises(OutOfTimeError):
        stress_curve.drawn(problem_of(scene), scene.curve, Clock(seconds))


def test_nothing_stands_in_for_a_curve_that_does_not_go_on(
    compiled: None,  # noqa: ARG001
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = load_scene("two-blades", ("model=A",))
    coarse = replace(scene.curve, harmonics=3)

    def stopped(points: Iterable[PeriodicResponse]) -> Iterator[PeriodicResponse]:
        yield next(iter(points))
        raise ContinuationError("the curve does not go on")

    problem = problem_of(scene)
    known = trace_curve(problem, coarse, stopped)
    monkeypatch.setattr(stress_curve, "trace_curve", lambda *_, **__: known)

    made = stress_curve.drawn(problem, scene.curve, Clock(60.0))

    assert made.traced is known
    assert made.said == ""
    assert made.options == curve_options(scene.curve)


def test_a_defect_is_no_honest_outcome(monkeypatch: pytest.MonkeyPatch) -> None:
    def ended(*_: object, **__: object) -> Iterator[object]:
        for cause in ("", "out of time after 3 s", "TypeError: none"):
            yield Ended(Case("mu", cause, ()), Finding(Outcome.AGREES), cause, 1)

    monkeypatch.setattr(stress, "bounded", ended)

    found = [each.finding for each in tried("gap", (), [], Budget.each(3.0, 1))]

    assert [each.outcome for each in found] == [
        Outcome.AGREES,
        Outcome.HONEST,
        Outcome.DISAGREES,
    ]
    assert found[2].cause == "TypeError: none"


CHOSEN = [
    Case("rope [N/m]", "10", ("rope.stiffness=10",)),
    Case("harmonics", "1", ("curve.harmonics=1",)),
    Case("sigma", "-1", ("contact.sigma=-1",)),
    Case("nan", "rope", (), refusals=(("rope.stiffness=nan",),)),
    Case("nan", "no number", (), refusals=(("preload.force=1",),)),
]


def test_cases_are_solved_compared_and_refused(compiled: None) -> None:  # noqa: ARG001
    found = {
        each.case: each.finding
        for each in tried("two-blades", ("model=A",), CHOSEN, Budget.each(60.0, 1))
    }

    own, one, wrong, refused, taken = (found[case] for case in CHOSEN)
    assert own.outcome is Outcome.AGREES
    assert own.compared == 2
    assert own.difference < 0.01
    assert 1.0 < own.condition < 1e12
    assert one.outcome in (Outcome.HONEST, Outcome.DISAGREES)
    assert one.difference > 0.01
    assert wrong.outcome is Outcome.HONEST
    assert "[contact] sigma = -1" in wrong.cause
    assert refused.outcome is Outcome.REFUSED
    assert taken.outcome is Outcome.DISAGREES
    assert "preload.force=1: taken as it is" in taken.cause


@pytest.mark.slow(seconds=3)  # machine code is there by then
def test_a_quick_look_runs_from_the_command_line(
    run: Run,
    tmp_path: Path,
    compiled: None,  # noqa: ARG001
) -> None:
    near = ("model=A", "curve.lowest=134 Hz", "curve.highest=136 Hz")
    settings = [each for key in near for each in ("--set", key)]
    chosen = ("--quick", "--seconds", "2", "--processes", "1")

    status, output, _ = run("stress", "two-blades", *settings, *chosen)

    with (tmp_path / "two-blades-stress.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    outcomes = [row["outcome"] for row in rows]
    good = sum(outcomes.count(each.value) for each in (Outcome.AGREES, Outcome.WITHIN))
    assert status == 0
    assert len(rows) == len(cases(load_scene("two-blades"), quick=True))
    assert outcomes.count(Outcome.REFUSED.value) == len(bad_values())
    assert good >= 1  # 6 and more on a machine that is fast and does nothing else
    assert f"{good} of {len(rows) - len(bad_values())} cases" in output
    assert (tmp_path / "two-blades-stress.png").stat().st_size > 10_000


def test_an_interrupted_matrix_keeps_table_and_picture(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(
        _: str, __: Sequence[str], chosen: Sequence[Case], ___: Budget
    ) -> Iterator[Tried]:
        (case,) = (each for each in chosen if each.parameter == "sigma")
        yield Tried(case, Finding(Outcome.AGREES, difference=1e-4), 1.5)
        raise KeyboardInterrupt

    monkeypatch.setattr(stress, "tried", interrupted)

    status, output, error = run("stress", "two-blades", "--quick")

    assert status == 130
    assert "what was computed is kept" in error
    assert "sigma" in output
    with (tmp_path / "two-blades-stress.csv").open(encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert row["outcome"] == "agrees"
    assert math.isclose(float(row["difference"]), 1e-4)
    assert (tmp_path / "two-blades-stress.png").stat().st_size > 10_000


def test_a_matrix_interrupted_before_a_case_ended_writes_nothing(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> Iterator[Tried]:
        raise KeyboardInterrupt

    monkeypatch.setattr(stress, "tried", interrupted)

    status, _, error = run("stress", "two-blades", "--quick")

    assert status == 130
    assert error == "microslip: interrupted; no file is written\n"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("outcome", "status"), [(Outcome.HONEST, 0), (Outcome.DISAGREES, 1)]
)
@pytest.mark.usefixtures("no_picture")
def test_a_quick_look_fails_if_a_value_disagrees(
    outcome: Outcome, status: int, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = [Tried(Case("mu", "1", ()), Finding(outcome, "a cause"), 1.0)]
    monkeypatch.setattr(stress, "tried", lambda *_, **__: iter(made))

    ended, output, _ = run("stress", "two-blades", "--quick")

    assert ended == status
    assert "mu = 1: a cause" in output
