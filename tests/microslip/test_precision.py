"""Error against run time: orbits, costs, and the command that draws them."""

import csv
import functools
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from microslip.cli import main
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.precision import precision
from microslip.studies.precision.case import Case, case_of
from microslip.studies.precision.fronts import cost_at, front, slope
from microslip.studies.precision.methods import settings
from microslip.studies.precision.orbit import PHASES, Orbit
from microslip.studies.precision.precision import Run, runs
from microslip.studies.precision.reference import Reference, reference
from microslip_mechanics.arrays import Array

PHASE = 2.0 * np.pi * np.arange(PHASES) / PHASES


def orbit(motion: Array, energy: float = 2.0) -> Orbit:
    return Orbit(motion[:, None], energy, 1.5 * energy)


def run(seconds: float, error: float, ending: str = "complete") -> Run:
    return Run("any", "", seconds, (error,) * 3, math.nan, 0, 0.0, ending)


def test_the_peak_lies_between_the_samples() -> None:
    shifted = orbit(3.0 + 0.7 * np.sin(PHASE + 0.013) + 0.1 * np.sin(3.0 * PHASE))
    phase = np.linspace(0.0, 2.0 * np.pi, 10**6)
    fine = 0.7 * np.sin(phase + 0.013) + 0.1 * np.sin(3.0 * phase)

    assert shifted.peak == pytest.approx(np.abs(fine).max(), rel=2e-6)


def test_errors_are_relative_and_know_no_mean() -> None:
    exact, other = orbit(np.sin(PHASE)), orbit(5.0 + 1.02 * np.sin(PHASE), 1.9)

    assert other.errors(exact) == pytest.approx((0.02, 0.05, 0.02))


def test_the_peak_is_that_of_a_probe_that_moves() -> None:
    rounding = np.array([1e-17, 0.0])
    exact, other = (
        Orbit(np.outer(np.sin(PHASE), [rest, size]), 2.0, 2.0)
        for rest, size in zip(rounding, (1.0, 1.02), strict=True)
    )

    assert exact.peak == pytest.approx(1.0)
    assert other.errors(exact) == pytest.approx((0.02, 0.0, 0.02))


def test_costs_are_interpolated_along_the_best_runs() -> None:
    found = [run(1.0, 1e-2), run(4.0, 1e-4), run(2.0, 5e-2), run(9.0, 1e-6, "stopped")]

    assert [each.seconds for each in front(found, 0)] == [1.0, 4.0]
    assert cost_at(found, 0, 1e-3, 0.0) == pytest.approx(2.0)
    assert cost_at(found, 0, 0.5, 0.0) == 1.0
    assert math.isnan(cost_at(found, 0, 1e-6, 1e-9))
    assert math.isinf(cost_at(found, 0, 1e-6, 2e-7))


def test_the_slope_is_that_of_the_runs_which_the_reference_can_judge() -> None:
    found = [run(2.0**n, 4.0**-n) for n in range(1, 12)]

    assert slope(found, 0, 1e-6) == pytest.approx(2.0)
    assert math.isnan(slope(found, 0, 1e-3))
    alike = [run(1.0 + 1e-3 * n, 4.0**-n) for n in range(1, 12)]
    assert math.isnan(slope(alike, 0, 1e-6))


@functools.cache
def jenkins() -> tuple[Case, Reference]:
    case = case_of(load_scene("jenkins"))
    return case, reference(case, 0.5)


def test_the_reference_has_the_energy_of_the_closed_loop() -> None:
    _, exact = jenkins()
    shown = exact.orbit.vibration[:, 0]
    largest = 0.5 * (shown.max() - shown.min())

    # the parallelogram of a slider of 1 N behind 5 kN/m
    assert exact.orbit.energy == pytest.approx(4.0 * (largest - 1.0 / 5e3), rel=1e-3)
    assert max(exact.spread) < 1e-5


def test_where_a_contact_sticks_the_energy_is_that_of_all_damping() -> None:
    scene = load_scene("jenkins")
    damper = problem_of(scene).structure.damping[0, 0]  # N s/m
    speed = math.tau * 15.0

    exact = reference(case_of(scene, 15.0), 0.5)

    assert not exact.orbit.rubs
    taken = math.pi * damper * speed * exact.orbit.peak**2
    assert exact.orbit.energy == pytest.approx(taken, rel=1e-6)
    assert max(exact.spread) < 1e-6


def test_an_error_of_the_energy_is_that_of_what_the_reference_counts() -> None:
    motion = np.sin(PHASE)[:, None]
    rounding, stuck = Orbit(motion, 3e-18, 1.1), Orbit(motion, 1e-18, 1.0)
    slides, loose = Orbit(motion, 0.5, 1.0), Orbit(motion, 0.4, 1.0)

    assert rounding.errors(stuck)[1] == pytest.approx(0.1)
    assert loose.errors(slides)[1] == pytest.approx(0.2)
    assert (stuck.energy, slides.energy) == (1.0, 0.5)


def chosen(case: Case, exact: Reference, method: str) -> Iterator[Run]:
    picked = [s for s in settings(case, quick=True) if s.method == method]
    return runs(case, exact, picked[-2:], quick=True)


@pytest.mark.parametrize(
    "method",
    [
        "harmonic balance",
        "reference march",
        pytest.param("scipy Radau", marks=pytest.mark.long),
    ],
)
def test_every_method_comes_to_the_same_orbit(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precision, "QUICK", 20.0)  # a busy machine takes its time

    _, fine = chosen(*jenkins(), method)

    assert fine.ending == "complete"
    assert max(fine.errors) < 1e-4


def test_lsoda_comes_close_before_it_chatters_at_kinks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(precision, "QUICK", 30.0)  # however busy the machine is

    rough = next(chosen(*jenkins(), "scipy LSODA"))

    assert rough.ending == "complete"
    assert max(rough.errors) < 2e-3


def test_what_takes_too_long_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "QUICK", 1e-9)

    first, second = chosen(*jenkins(), "scipy Radau")

    assert math.isnan(first.seconds)
    assert "left out: two periods take over" in first.ending
    assert "left out: a looser setting" in second.ending


@pytest.mark.slow
def test_the_command_writes_a_table_and_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status = main(["precision", "duffing", "--quick", "-o", str(tmp_path / "work")])

    assert status == 0
    told = capsys.readouterr().out
    assert "CPU time for an error in peak amplitude" in told
    assert (tmp_path / "work.png").stat().st_size > 10_000
    with (tmp_path / "work.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    best: dict[str, float] = {}
    for row in rows:
        # what the loosest of the tightest settings promises: 1e-3 of both
        error = max(float(row["amplitude_error"]), float(row["energy_error"]))
        best[row["method"]] = min(best.get(row["method"], 1.0), error)
    assert len(best) == 9
    assert max(best.values()) < 1e-3


def test_a_frequency_beside_the_curve_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["precision", "duffing", "--frequency", "50"]) == 1
    assert "no stable point" in capsys.readouterr().err
