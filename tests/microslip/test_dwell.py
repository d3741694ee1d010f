"""Dwells: the steady state of closed forms and of harmonic balance, limits, texts."""

import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from figure_checks import check_labels
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.figures.dwell import dwell_figure
from microslip.files.result_file import load
from microslip.scenes.experiments import March
from microslip.studies.dwell import _left, amplitudes, dwelling
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from small_problems import cubic_oscillator, oscillator

Run: TypeAlias = Callable[..., tuple[int, str, str]]


def settled(
    problem: Problem, frequency: float, *, tolerance: float, steps: int = 400
) -> tuple[TimeHistory, list[float]]:
    """Return a dwell with so many steps a period, and its distances from steady."""
    march = March(2.0 * np.pi / frequency / steps * 1.0001, 10)
    periods = list(dwelling(problem, frequency, march, tolerance=tolerance, most=2000))
    blocks = [period.history for period in periods]
    return joined(blocks, "complete"), [period.distance for period in periods]


@pytest.mark.parametrize("frequency", [3.0, 12.0, 12.247, 30.0])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-5])
def test_linear_dwell_ends_as_near_as_it_says(
    frequency: float, tolerance: float
) -> None:
    history, distances = settled(oscillator(), frequency, tolerance=tolerance)

    # 2 ü + 0.5 u̇ + 300 u = 1.5 sin
    stiffness = 300.0 - 2.0 * frequency**2 + 0.5j * frequency
    (found,) = amplitudes(history, frequency)
    assert distances[-1] <= tolerance < min(distances[:-1])
    # a load that is linear over each step weakens a sine by (ωh)²/12
    own = (frequency * history.time_step) ** 2 / 12.0
    assert found == pytest.approx(1.5 / abs(stiffness), rel=1.2 * (tolerance + own))


def test_the_distance_is_neither_far_too_small_nor_too_large() -> None:
    problem, frequency = oscillator(), 12.0
    history, distances = settled(problem, frequency, tolerance=1e-7)

    rows = len(history.time) // len(distances)
    ends = np.stack(
        [
            history.displacement[rows - 1 :: rows, 0] * frequency,
            history.velocity[rows - 1 :: rows, 0],
        ],
        axis=1,
    )
    away = np.linalg.norm(ends - ends[-1], axis=1) / np.linalg.norm(ends[-1])
    middle = slice(70, len(away) // 2)
    ratio = np.array(distances)[middle] / away[middle]
    assert ratio.min() > 0.5
    assert ratio.max() < 20.0


def test_dwell_of_a_cubic_spring_is_that_of_harmonic_balance() -> None:
    problem, frequency = cubic_oscillator(drive=1.0), 1.0

    history, _ = settled(problem, frequency, tolerance=1e-6, steps=1000)

    options = CurveOptions(0.9, frequency, harmonics=9, samples=256)
    *_, last = frequency_response(problem, static_equilibrium(problem), options)
    assert last.frequency == pytest.approx(frequency)
    orbit = last.at(2.0 * np.pi * np.arange(64) / 64)[0][:, 0]
    expected = abs(2.0 * np.fft.rfft(orbit)[1] / 64)
    assert amplitudes(history, frequency)[0] == pytest.approx(expected, rel=1e-4)


def test_dwell_is_written_drawn_and_told(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    words = ("--frequency", "130", "--tolerance", "0.5")
    status, output, _ = run("dwell", str(quick_scene), *words)

    assert status == 0
    assert "130 Hz: steady after" in output
    assert "estimated error of the peak amplitude" in output
    history = load(tmp_path / "quick-dwell.nc").result
    assert isinstance(history, TimeHistory)
    assert history.ending == "complete"
    np.testing.assert_allclose(history.frequency, 2.0 * np.pi * 130.0)
    assert (tmp_path / "quick-dwell.png").stat().st_size > 10_000
    assert run("plot", "quick-dwell.nc")[0] == 0
    assert run("plot", "quick-dwell.nc", "-o", "again")[0] == 0
    assert Path("again.png").stat().st_size > 0


@pytest.mark.parametrize("scene", ["jenkins", "duffing"])
def test_dwell_tells_the_errors_of_its_steps(scene: str, run: Run) -> None:
    _, output, _ = run("dwell", scene, "--frequency", "3", "--most-periods", "3")

    words = output.split("estimated error of the peak amplitude ")[1].split()
    assert 1e-9 < float(words[0]) < 0.1
    assert ("friction, error" in output) == (scene == "jenkins")  # which rubs


def test_dwell_that_is_not_steady_in_time_says_so(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    words = ("--frequency", "130", "--most-periods", "3")
    status, output, error = run("dwell", str(quick_scene), *words)

    assert status == 1
    assert "NOT steady after 3 periods" in output
    assert error.startswith("microslip: not steady after 3 periods: give more")
    assert "or a smaller march.time_step" in error
    assert error.count("\n") == 1
    ending = load(tmp_path / "quick-dwell.nc").result.ending
    assert ending.startswith("not steady")


STOPS = """
scene = "system"
structure = {names = ["x"], mass = [1], stiffness = [1000], damping_ratio = 0.03}
drive = {x = 0.1}
sweep = {end = 5, duration = 6, lowest = 4, highest = 7}
curve = {lowest = 4, highest = 7}
march = {time_step = "1 ms"}
[[element]]
name = "stop"
law = "unilateral-spring"
between = ["ground", "x"]
stiffness = 20_000
gap = "0.3 mm"
"""


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize(("hertz", "many"), [("4.3", 3), ("4.51", 2), ("4.45", 0)])
def test_a_subharmonic_dwell_tells_after_how_many_periods_it_repeats_itself(
    hertz: str, many: int, run: Run, tmp_path: Path
) -> None:
    (tmp_path / "stops.toml").write_text(STOPS)
    words = ("--frequency", hertz, "--most-periods", "200")
    status, output, error = run("dwell", "stops.toml", *words)

    assert status == 1
    assert "NOT steady" in output
    assert (f"it repeats itself every {many} periods" in output) == (many > 0)
    assert error.count("\n") == 1
    assert (f"repeats itself every {many} periods of the drive" in error) == (many > 0)
    assert ("give more --most-periods" in error) == (many == 0)


@pytest.mark.usefixtures("no_picture")
def test_a_dwell_whose_energies_do_not_balance_is_wrong(run: Run) -> None:
    few = ("--set", "march.time_step=0.1")  # two steps a period
    status, output, error = run("dwell", "duffing", "--frequency", "5", *few)

    assert status == 1
    assert "5 Hz: steady after" in output
    assert error.startswith("microslip: the energy balance does not close")


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("dwell", []),
        ("dwell", ["--frequency", "0"]),
        ("dwell", ["--frequency", "130", "--most-periods", "0"]),
        ("dwell", ["--frequency", "130", "--tolerance", "-1"]),
        ("decay", []),
        ("decay", ["--frequency", "130", "--from", "x.nc"]),
        ("decay", ["--frequency", "130", "--probe", "nose"]),
    ],
)
def test_what_makes_no_sense_is_refused(
    command: str, words: list[str], run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    status, _, error = run(command, str(quick_scene), *words)

    assert status == 2
    assert error
    assert not list(tmp_path.glob("*.nc"))


def test_a_dwell_of_one_probe_has_no_empty_panel(small_history: TimeHistory) -> None:
    alone = dataclasses.replace(
        small_history,
        probes=("blade",),
        displacement=small_history.displacement[:, :1],
        velocity=small_history.velocity[:, :1],
    )

    figure = dwell_figure(alone, [0.1, 0.01], 1e-3, "one")

    check_labels(figure)
    assert len(figure.axes) == 5
    assert all(axes.lines for axes in figure.axes)


@pytest.mark.parametrize(("known", "marker"), [(1, "."), (12, "."), (400, "None")])
def test_a_single_distance_is_seen(
    known: int, marker: str, small_history: TimeHistory
) -> None:
    distances = [math.inf, math.inf, *[1e-2] * known]

    figure = dwell_figure(small_history, distances, 1e-3, "few")

    (line, _) = figure.axes[4].lines
    assert len(line.get_xdata()) == known  # type: ignore[arg-type]
    assert line.get_marker() == marker


def test_of_many_motions_the_picture_shows_those_that_move_most(
    small_history: TimeHistory,
) -> None:
    count = 6
    sizes = 1e-3 * np.arange(1.0, count + 1.0)
    moved = small_history.displacement[:, :1] + 1.0
    many = dataclasses.replace(
        small_history,
        probes=tuple(f"x{place}" for place in range(count)),
        displacement=moved * sizes,
        velocity=moved * sizes,
    )

    figure = dwell_figure(many, [0.1], 1e-3, "many")

    titles = [axes.get_title(loc="left") for axes in figure.axes[:2]]
    assert titles == ["Displacement, x4", "Displacement, x5"]
    for axes in figure.axes[2:4]:
        names = axes.get_legend_handles_labels()[1]
        assert names == ["x2", "x3", "x4", "x5"]


def test_a_dwell_of_few_periods_counts_them_and_says_what_is_unknown(
    small_history: TimeHistory,
) -> None:
    figure = dwell_figure(small_history, [math.inf] * 3, 1e-3, "few")

    figure.draw_without_rendering()
    (distance,) = [
        axes
        for axes in figure.axes
        if axes.get_title(loc="left").startswith("Distance")
    ]
    assert [int(tick) for tick in distance.get_xticks()] == list(distance.get_xticks())
    assert [text.get_text() for text in distance.texts] == [
        "not known after so few periods"
    ]


@pytest.mark.parametrize("command", ["dwell", "decay"])
def test_a_scene_without_drive_has_no_steady_motion(
    command: str, run: Run, tmp_path: Path
) -> None:
    words = ("two-blades", "--set", "model=A", "--set", "excitation.force=0")
    place = ("--frequency", "136.2", "-o", str(tmp_path / "still"))

    status, printed, error = run(command, *words, *place)

    assert (status, printed) == (2, "")
    assert "nothing moves at any frequency: the scene has no drive" in error
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("creep", [0.0, 1e-3])
def test_the_way_that_is_left_of_a_beating_motion_is_known(creep: float) -> None:
    # a mode that fades by 1 % a period and turns by 0.8 in each, and one that creeps
    draw = np.random.default_rng(3)
    waves, slow = draw.normal(size=(2, 6)), draw.normal(size=6)

    def place(period: int) -> np.ndarray:
        turned = 0.99**period * np.array([np.cos(0.8 * period), np.sin(0.8 * period)])
        return turned @ waves + creep * 0.999**period * slow

    for last in (50, 200):
        places = [place(period) for period in range(last - 3, last + 1)]
        found = _left(list(np.diff(places, axis=0)), 999.0)
        true = np.linalg.norm(places[-1])

        assert true * (1.0 - 1e-9) <= found
        if creep == 0.0:
            assert found <= 1.001 * true
