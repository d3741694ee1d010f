"""The study of agreement: envelopes, energies, rates, and the command's verdict."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.commands.verify_sweeps import sweep_rows
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import Traced, trace_curve
from microslip.studies.sweep import march_whole, swept_sine
from microslip.studies.verify.orbits import spread
from microslip.studies.verify.quasi_static import (
    compared_energies,
    quasi_static_energy,
)
from microslip.studies.verify.verify import (
    SweepAgreement,
    falls,
    orbits,
    rate_of,
    sweep_agreement,
)
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.time_history import TimeHistory
from scene_texts import unswept

Run: TypeAlias = Callable[..., tuple[int, str, str]]

ORBITS = ("--frequencies", "3", "--periods", "30", "--slower")
BAND = ("curve.highest=131", "curve.harmonics=2", "curve.samples=32")
SWEEP = (
    "sweep.ramp=0.01",
    "sweep.start=0.02",
    "sweep.end=0.1",
    "sweep.duration=0.1",
    "sweep.lowest=130",
    "sweep.highest=131",
)


def sets(*overrides: str) -> list[str]:
    """Return the arguments that override values of a scene."""
    return [f"--set={each}" for each in overrides]


@pytest.fixture
def scene(quick_scene: Path) -> Scene:
    """Return model A where it sticks, with a sweep of ten cycles."""
    return load_scene(str(quick_scene), [*BAND, *SWEEP])


def agreed(slower: float, energy_error: float, envelope: float) -> SweepAgreement:
    """Return an agreement with given errors."""
    nothing = np.zeros(0)
    return SweepAgreement(
        slower=slower,
        energy=2.0 * (1.0 + energy_error),
        quasi_static=2.0,
        envelope_error=envelope,
        closing_error=0.0,
        envelope_frequency=nothing,
        envelope=nothing,
    )


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.0])
def test_rate_is_the_exponent_by_which_the_difference_falls(exponent: float) -> None:
    found = [
        agreed(slower, -0.4 * slower**-exponent, 0.1) for slower in (10.0, 1.0, 4.0)
    ]

    assert rate_of(found) == pytest.approx(exponent, rel=1e-9)


@pytest.mark.parametrize(
    "errors",
    [
        (0.0017, -0.0314, -0.0037),
        (0.4, 0.1, -0.01),
        (0.1, 0.4, 0.01),
        (0.4, 0.1, 0.0),
        (0.0, 0.0),
        (0.4, math.inf),
        (math.inf, math.inf),
        (0.4,),
    ],
)
def test_differences_that_follow_no_power_have_no_exponent(
    errors: tuple[float, ...],
) -> None:
    found = [agreed(4.0**place, error, 0.1) for place, error in enumerate(errors)]

    assert rate_of(found) is None
    assert "the difference" not in sweep_rows(found)


def test_energy_error_is_relative_to_the_slow_sweep() -> None:
    assert agreed(1.0, 0.25, 0.1).energy_error == pytest.approx(0.25)
    assert agreed(1.0, -0.25, 0.1).energy_error == pytest.approx(-0.25)


@pytest.mark.parametrize(
    ("errors", "envelopes", "approach"),
    [
        ((0.4, 0.2, 0.1), (0.3, 0.2, 0.1), True),
        ((0.4, -0.2, 0.1), (0.3, 0.2, 0.1), True),
        ((0.2, 0.2, 0.2), (0.3, 0.2, 0.1), False),
        ((0.4, 0.01, -0.2), (0.3, 0.2, 0.1), True),
        ((0.4, 0.2, 0.1), (0.3, 0.3, 0.1), True),
        ((0.4, 0.2, 0.1), (0.3, 0.2, 0.2), False),
        ((0.1, -0.2, 0.05), (0.3, 0.2, 0.1), True),
        ((0.05, -0.2, 0.1), (0.3, 0.2, 0.1), False),
        ((0.05, -0.2, 0.09), (0.3, 0.2, 0.1), True),
        ((0.05, -0.06, 0.09), (0.3, 0.2, 0.1), False),
        ((0.4,), (0.3,), True),
        ((), (), True),
    ],
)
def test_sweeps_agree_when_the_slowest_is_closest(
    errors: tuple[float, ...], envelopes: tuple[float, ...], approach: bool
) -> None:
    found = [
        agreed(slower, error, envelope)
        for slower, error, envelope in zip(
            (1.0, 4.0, 10.0), errors, envelopes, strict=False
        )
    ]

    assert falls(found) is approach


def test_march_stays_on_the_orbits_it_began_on(scene: Scene) -> None:
    problem = problem_of(scene)
    traced = trace_curve(problem, scene.curve)
    chosen = [traced.responses[place] for place in spread(traced, 3)]

    found = list(orbits(problem, chosen, periods=10, steps_per_period=600))

    assert [each.frequency for each in found] == [each.frequency for each in chosen]
    for each, response in zip(found, chosen, strict=True):
        place = traced.responses.index(response)
        amplitude = traced.curve.amplitude[place]
        np.testing.assert_allclose(each.predicted, amplitude, rtol=1e-9)
        assert each.deviation[:3].max() < 1e-3


def test_sweep_is_compared_with_the_curve_at_its_own_rate(scene: Scene) -> None:
    problem = problem_of(scene)
    curve = trace_curve(problem, scene.curve).curve

    found = sweep_agreement(scene, problem, curve, slower=2.0)

    sweep = swept_sine(scene.sweep, slower=2.0)
    history = march_whole(problem, sweep, scene.march)
    driven = history.time >= sweep.start - 1e-12
    friction = history.of("friction")
    # per length of the scene's sweep
    energy = (friction[-1] - np.interp(sweep.start, history.time, friction)) / 2.0
    assert found.energy == pytest.approx(energy, rel=1e-9)
    rate = swept_sine(scene.sweep).rate
    upward = np.arange(curve.frequency.size)  # without a fold
    expected = quasi_static_energy(curve, rate, (130.0, 131.0), upward)
    assert found.quasi_static == pytest.approx(expected, rel=1e-9)
    assert found.estimated == pytest.approx(history.energy_error[-1] / 2.0, rel=1e-9)
    assert f" {found.estimated:.1e} " in sweep_rows([found])
    # what came in, beside what was stored, and is neither spent nor stored, over it
    came, others = history.of("input"), set(history.energies) - {"input"}
    left = came + history.stored_at_start - sum(map(history.of, others))
    assert 0.0 < np.abs(left).max() < 1e-3 * came.max()
    assert found.closing_error == pytest.approx(np.abs(left).max() / came.max())
    largest = np.abs(history.displacement[driven]).max(axis=0)
    assert (found.envelope.max(axis=0) <= largest * (1.0 + 1e-9)).all()
    assert (found.envelope.max(axis=0) > 0.8 * largest).all()


def test_envelope_has_a_point_for_each_cycle_of_the_drive(scene: Scene) -> None:
    problem = problem_of(scene)
    curve = trace_curve(problem, scene.curve).curve

    found = sweep_agreement(scene, problem, curve, slower=1.0)

    # 0.08 s at about 130.5 Hz are 10.4 cycles; the last one is cut off
    assert found.envelope.shape == (10, len(curve.probes))
    assert (np.diff(found.envelope_frequency) > 0.0).all()
    assert 130.0 <= found.envelope_frequency[0] < 130.05


def test_verification_agrees_within_a_loose_tolerance(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    arguments = (str(quick_scene), *sets(*BAND), *ORBITS)

    status, output, error = run("verify", *arguments)

    assert (status, error) == (0, "")
    assert "agree: largest difference of an amplitude" in output
    assert "3 of 3 orbits within both estimates" in output
    assert "agree: largest deviation of an amplitude" in output
    assert "tolerance 1 %" in output
    assert (tmp_path / "quick-verify.png").is_file()
    rows = [line.split() for line in output.splitlines() if line[:2] == " 1"]
    # three orbits by shooting, and three marches
    assert len(rows) == 6
    assert float(rows[0][0]) == pytest.approx(130.0)
    assert float(rows[-1][0]) == pytest.approx(131.0)


def test_verification_disagrees_within_an_absurd_tolerance(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    arguments = (str(quick_scene), *sets(*BAND), "--tolerance", "1e-12", *ORBITS)

    status, output, _ = run("verify", *arguments)

    assert status == 1
    assert "DISAGREE: largest deviation of an amplitude" in output
    assert (tmp_path / "quick-verify.png").is_file()


def test_verification_of_a_curve_of_another_problem_names_where_it_is_wrong(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The curve of one per cent more drive, beside orbits of the scene's drive.
    def traced(problem: Problem, *arguments: object) -> Traced:
        louder = dataclasses.replace(problem, drive=1.01 * problem.drive)
        return trace_curve(louder, *arguments)  # type: ignore[arg-type]

    monkeypatch.setattr("microslip.studies.curve.trace_curve", traced)
    band = sets("curve.highest=131", "curve.harmonics=7", "curve.samples=128")

    status, output, _ = run(
        "verify",
        str(quick_scene),
        *band,
        "--frequencies=3",
        "--tolerance=0.5",
        "--slower",
    )

    assert status == 1
    said = [line for line in output.splitlines() if line.startswith("DISAGREE at")]
    assert len(said) == 3
    assert said[0].startswith("DISAGREE at 130.0000 Hz (stable): amplitudes differ by")
    assert "harmonics that differ most: 1 (1e-02)" in said[0]
    assert "DISAGREE: 3 of 3 orbits differ by more than both estimates" in output


@pytest.mark.parametrize(
    ("approach", "status"),
    [pytest.param(True, 0, marks=pytest.mark.long), (False, 1)],
)
def test_verdict_of_the_sweeps_decides_the_status_too(
    approach: bool,
    status: int,
    run: Run,
    quick_scene: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def found(
        scene: Scene, *arguments: object, slower: float, **others: object
    ) -> SweepAgreement:
        made = sweep_agreement(scene, *arguments, slower=slower, **others)  # type: ignore[arg-type]
        error = 0.4 / slower if approach else 0.4 * slower
        return dataclasses.replace(
            made, energy=made.quasi_static * (1.0 + error), envelope_error=error
        )

    monkeypatch.setattr("microslip.studies.verify.verify.sweep_agreement", found)
    few = ("--frequencies", "1", "--periods", "2", "--slower", "2", "1")

    ended, output, _ = run("verify", str(quick_scene), *sets(*BAND, *SWEEP), *few)

    assert ended == status
    word = "agree: energy and envelope" if approach else "DISAGREE: energy and envelope"
    assert word in output
    told = "falls as duration^-1.00" if approach else "grows as duration^1.00"
    assert f"the difference {told}" in output


@pytest.mark.usefixtures("no_hang")
@pytest.mark.parametrize(
    "arguments",
    [
        ("--periods", "1", "--slower"),
        ("--slower", "0"),
        ("--slower", "-1"),
        ("--slower", "nan"),
        ("--slower", "inf"),
        ("--slower", "1", "1"),
        ("--tolerance", "nan", "--slower"),
        ("--tolerance", "-1", "--slower"),
        ("--slower", "1", "--set=friction.law=none"),
        ("--slower", "1", "--set=friction.mu_dynamic=0"),
        ("--slower", "1", "--set=march.store_every=10000"),
        ("--slower", "--set=excitation.force=0"),
    ],
    ids=" ".join,
)
def test_verification_of_what_cannot_be_compared_ends_with_a_result_or_one_line(
    arguments: tuple[str, ...], run: Run, quick_scene: Path
) -> None:
    few = ("--frequencies", "1", "--periods", "2")

    status, output, error = run(
        "verify", str(quick_scene), *sets(*BAND, *SWEEP), *few, *arguments
    )

    assert status in (0, 1, 2)
    assert "nan" not in output
    if status == 2:
        assert "error: " in error or error.startswith("microslip: ")
    elif error:
        assert error.startswith("microslip: ")
        assert len(error.splitlines()) == 1


@pytest.mark.usefixtures("no_picture")
def test_a_scene_without_a_sweep_is_verified_by_its_orbits(
    run: Run, tmp_path: Path
) -> None:
    scene = unswept(tmp_path)

    status, output, _ = run("verify", str(scene), "--frequencies", "2")

    assert status == 0
    assert "This scene has no [sweep]. Orbits alone are verified." in output
    assert "agree: largest difference" in output
    assert run("verify", str(scene), "--slower", "1")[0] == 2


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.parametrize("model", ["A", "B"])
def test_sweeps_approach_the_curve_of_the_built_in_scene(model: str, run: Run) -> None:
    few = ("--frequencies", "3", "--periods", "60", "--slower", "1", "4")

    status, output, error = run("verify", "two-blades", f"--set=model={model}", *few)

    assert (status, error) == (0, "")
    assert "DISAGREE" not in output


def test_energies_are_compared_where_friction_takes_out_some_along_the_curve(
    small_history: TimeHistory,
) -> None:
    rows = len(small_history.time)
    flows = np.linspace(0.0, 1.0, rows)[:, None] * np.array([2.0, 0.5])
    history = dataclasses.replace(
        small_history, energies=("input", "friction"), energy=flows
    )
    span = float(history.time[0]), float(history.time[-1])

    assert compared_energies(history, span, 0.4, 2.0) == pytest.approx((0.25, 0.4))
    # what a slider that sticks stores at the end, beside rounding along the curve
    assert compared_energies(history, span, -1e-19, 2.0) == (0.0, 0.0)


def test_quasi_static_energy_of_the_rate_does_not_depend_on_slowness() -> None:
    table = load_scene("two-blades").sweep

    rates = [swept_sine(table, slower=slower).rate * slower for slower in (1.0, 10.0)]

    assert rates[0] == pytest.approx(rates[1])
    assert rates[0] == pytest.approx(math.log(145.0 / 125.0) / 6.0)


@pytest.mark.parametrize("slower", ["1000.1", "1e300"])
def test_a_sweep_of_more_than_a_thousand_times_is_refused(
    slower: str, run: Run, quick_scene: Path
) -> None:
    status, output, error = run("verify", str(quick_scene), "--slower", "1", slower)

    assert (status, output) == (2, "")
    assert f"{slower} times as long is too long: give at most 1000" in error


@pytest.mark.parametrize("beyond", ["132", "131.0000002"])
def test_a_sweep_beyond_the_curve_is_refused(
    beyond: str, run: Run, quick_scene: Path
) -> None:
    ranges = "curve.highest=131", "sweep.lowest=130", f"sweep.highest={beyond}"

    status, output, error = run(
        "verify", str(quick_scene), "--slower=1", *sets(*ranges)
    )

    assert (status, output) == (2, "")
    assert f"[sweep] 130 to {beyond} Hz: give it the sweep's range" in error
    assert "does not cover" in error
    assert f"[curve] 130 to {beyond} Hz" not in error
