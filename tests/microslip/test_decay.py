"""Free decay: closed forms, the modes of harmonic balance, the command."""

import csv
import dataclasses
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest

from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import modes_in_range, nonlinear_mode
from microslip.commands.decay_tables import cycles
from microslip.files.result_file import load
from microslip.scenes.experiments import March
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.decay import (
    liveliest,
    measured,
    released,
    too_fast,
    unmeasured,
)
from microslip.studies.dwell import dwelling
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.loads.sine_test import SineTest, Tone
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import oscillator, sliding_block
from timedomain.integrate import IntegrationError, MarchOptions, integrate
from timedomain.record.checkpoint import at_end
from timedomain.record.start import Start

Run: TypeAlias = Callable[..., tuple[int, str, str]]


def let_go(
    problem: Problem, start: Start, frequency: float, *, periods: int, steps: int = 600
) -> RingDown:
    """Return the decay of the first probe after a start."""
    march = March(2.0 * np.pi / frequency / steps, 10)
    blocks = list(released(problem, start, march, frequency=frequency, periods=periods))
    return measured(problem, joined(blocks, "complete"), 0)


def test_linear_decay_has_the_damping_of_its_equation() -> None:
    # 2 ü + 0.5 u̇ + 300 u = 4
    start = Start(np.array([0.05]), np.zeros(1))

    decay = let_go(oscillator(preload=4.0), start, np.sqrt(150.0), periods=20)

    assert decay.time.size > 30
    np.testing.assert_allclose(decay.damping, 0.5 / (2.0 * np.sqrt(600.0)), rtol=1e-4)
    # average acceleration turns slower by (ωh)²/12
    np.testing.assert_allclose(decay.frequency, np.sqrt(150.0), rtol=2e-5)


def test_decay_against_friction_loses_as_much_in_each_cycle() -> None:
    # 0.6 N, which turn over within a velocity of 1e-5 of the motion's
    friction = {"load": 2.0, "threshold": 1e-5, "viscous": 0.0}
    block = sliding_block(mass=2.0, stiffness=200.0, **friction)
    start = Start(np.array([0.1]), np.zeros(1))

    decay = let_go(block, start, 10.0, periods=6, steps=4000)

    # 2F/k each half cycle; the amplitude is the geometric mean of those a cycle apart
    lost = 2.0 * 0.6 / 200.0
    middle = np.hypot(decay.amplitude, lost)
    np.testing.assert_allclose(np.diff(middle), -lost, rtol=2e-3)
    decrement = np.log((middle + lost) / (middle - lost))
    expected = decrement / np.hypot(2.0 * np.pi, decrement)
    np.testing.assert_allclose(decay.damping, expected, rtol=2e-3)


@pytest.mark.long
@pytest.mark.slow
def test_decay_of_a_sliding_rig_is_that_of_its_mode() -> None:
    problem = rig_problem(model="A")
    linear = modes_in_range(problem, static_equilibrium(problem), 800.0, 900.0)[0]
    options = ModeOptions(1e-4, 4e-3, harmonics=15)
    points = list(nonlinear_mode(problem, static_equilibrium(problem), linear, options))
    sizes = np.array([abs(point.probes[0]) for point in points])
    first = int(np.flatnonzero(np.diff(sizes) <= 0.0).max(initial=-1)) + 1
    points, sizes = points[first:], sizes[first:]
    begin = points[int(np.abs(sizes - 2e-3).argmin())]

    start = Start(*begin.state(0.0))
    decay = let_go(problem, start, begin.pole.imag, periods=30, steps=1600)

    damping = np.interp(decay.amplitude, sizes, [point.damping for point in points])
    hertz = np.interp(decay.amplitude, sizes, [point.frequency for point in points])
    assert decay.amplitude[-1] < 0.9 * decay.amplitude[0]
    np.testing.assert_allclose(decay.damping, damping, rtol=0.05)
    # a motion that slows down lags behind the modes of its amplitudes
    fallen = np.ptp(hertz)
    assert fallen > 2.0
    np.testing.assert_allclose(decay.frequency, hertz, rtol=0.0, atol=0.1 * fallen)


@pytest.mark.parametrize("drive", ["0.05 N", "2 N"])
def test_sliders_are_let_go_with_the_forces_that_they_hold(drive: str) -> None:
    # stuck, and sliding
    problem, frequency = problem_of(load_scene("jenkins", [f"drive.x={drive}"])), 107.0
    march = March(1e-4, 5)
    end = None
    for period in dwelling(problem, frequency, march, tolerance=1e-3, most=8):
        end = period.history.checkpoint
    assert isinstance(end, Checkpoint)
    held = at_end(problem, end)

    found = joined(
        list(released(problem, end, march, frequency=frequency, periods=2)), ""
    )
    hertz = frequency / (2.0 * np.pi)
    silence = SineTest(0.0, 0.0, (Tone(hertz, hertz, 2.0 / hertz, 0.0),), 0.0)
    blocks = integrate(problem, silence, MarchOptions(1e-4, 5), start=held)
    expected = joined(list(blocks), "").displacement

    swing = float(np.ptp(expected))
    np.testing.assert_allclose(found.displacement, expected, rtol=0, atol=1e-9 * swing)


def test_a_decay_about_where_a_slider_holds_it_is_measured_to_its_end() -> None:
    problem = problem_of(load_scene("jenkins", ["structure.damping_ratio=0.05"]))
    free = 2.0 * np.pi * 18.3748
    still = np.zeros(problem.structure.dofs)
    # the slider slides once, and holds the mass beside zero
    start = Start(still + 2e-4, still)

    history = joined(
        list(released(problem, start, March(1e-4, 5), frequency=free, periods=20)), ""
    )
    decay = measured(problem, history, 0)

    last = history.displacement[-200:, 0]
    aside, swing = abs(last.max() + last.min()) / 2.0, np.ptp(last) / 2.0
    assert aside > 20.0 * swing
    assert decay.time[-1] > 0.9 * history.time[-1]
    assert decay.amplitude[-1] == pytest.approx(swing, rel=0.05)


def test_the_state_of_other_contacts_is_refused() -> None:
    problem = problem_of(load_scene("jenkins", []))
    still = np.zeros(problem.structure.dofs)

    with pytest.raises(SceneError, match="give the scene of its file"):
        next(
            released(
                problem, Checkpoint(still, still, np.zeros(3)), March(1e-4, 10),
                frequency=107.0, periods=1,
            )
        )  # fmt: skip


def test_the_probe_that_moves_most_is_no_slip(small_history: TimeHistory) -> None:
    moved = np.zeros((6, 4))
    moved[0] = 1.0, 3.0, 2.0, 9.0

    assert small_history.probes[3] == "element-to-excited"
    assert liveliest(dataclasses.replace(small_history, displacement=moved)) == 1


def test_decay_is_measured_from_a_dwell_and_from_a_file(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    scene = str(quick_scene)
    words = ("--tolerance", "0.5", "--periods", "12")
    status, output, _ = run("decay", scene, "--frequency", "135", *words)
    assert status == 0
    assert "damping ratio" in output
    told = (
        r"error of time steps and rows: frequency (\S+), damping (\S+), of the largest"
    )
    assert all(0.0 < float(each) < 1e-2 for each in re.findall(told, output)[0])
    run("dwell", scene, "--frequency", "135", "--tolerance", "0.5")

    begun = ("--from", "quick-dwell.nc", "--periods", "12", "-o", "again")
    assert run("decay", scene, *begun)[0] == 0

    tables = []
    for name in ("quick-decay", "again"):
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
        with (tmp_path / f"{name}.csv").open(encoding="utf-8") as file:
            tables.append([[*map(float, row.values())] for row in csv.DictReader(file)])
    assert len(tables[0]) >= 18
    np.testing.assert_allclose(tables[0], tables[1], rtol=1e-9)
    history = load(tmp_path / "again.nc").result
    assert isinstance(history, TimeHistory)
    np.testing.assert_array_equal(history.level, 0.0)


@pytest.mark.parametrize("blocks", [0, 1])
def test_a_decay_whose_longer_steps_fail_is_measured_all_the_same(
    blocks: int, run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(
        problem: Problem, state: Checkpoint, march: March, **given: Any
    ) -> Iterator[TimeHistory]:
        first, *more = released(problem, state, march, **given)
        if march.time_step > step:
            yield from [first][:blocks]
            raise IntegrationError("too long")
        yield from [first, *more]

    step = load_scene(str(quick_scene), []).march.time_step
    monkeypatch.setattr("microslip.studies.decay.released", failing)

    words = ("--frequency", "135", "--tolerance", "0.5", "--periods", "12")
    status, output, _ = run("decay", str(quick_scene), *words)

    assert status == 0
    assert output.endswith(
        "estimated error of time steps and rows: not known: too long\n"
    )


@pytest.mark.parametrize("change", ["blade.elements=3", "friction.mu_dynamic=0.1"])
def test_march_of_another_scene_is_refused(
    change: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    run("sweep", str(quick_scene))

    words = ("--set", change, "--from", "quick-sweep.nc")
    status, _, error = run("decay", str(quick_scene), *words)

    assert status == 2
    assert "quick-sweep.nc is the march of another scene" in error
    assert error.count("\n") == 1
    assert not (tmp_path / "quick-decay.nc").exists()


def test_state_of_another_structure_is_refused() -> None:
    two = Start(np.zeros(2), np.zeros(2))

    with pytest.raises(SceneError, match="give the scene of its file"):
        let_go(oscillator(preload=4.0), two, 10.0, periods=1)


@pytest.mark.parametrize(
    ("damping", "drive", "told"),
    [
        (200.0, 1.0, "comes to rest before it has swung to and fro often enough"),
        (1e5, 1.0, "unless it is damped so strongly that it creeps back to rest"),
        (1.0, 0.0, "x1 does not move when it is let go: give the scene a drive"),
    ],
)
def test_a_decay_without_swings_tells_why(
    damping: float, drive: float, told: str
) -> None:
    problem = system(
        mass=[1.0], stiffness=[1e3], damping=[damping], drive={"x1": drive}
    )
    start = Start(np.array([drive]), np.zeros(1))
    march = March(1e-3, 10)

    blocks = list(released(problem, start, march, frequency=30.0, periods=20))
    history = joined(blocks, "complete")

    assert not measured(problem, history, 0).time.size
    assert told in unmeasured(problem, history, 0)


def test_what_is_over_before_it_swings_is_not_measured_in_its_last_digits() -> None:
    problem = system(mass=[1.0], stiffness=[1e3], damping_ratio=0.999)
    start = Start(np.array([1.0]), np.zeros(1))

    decay = let_go(problem, start, 30.0, periods=300, steps=60)

    assert not decay.time.size


@pytest.mark.long
def test_motions_that_beat_are_told(run: Run) -> None:
    words = ("--frequency", "0.16", "--tolerance", "0.5", "--periods", "60")

    status, output, _ = run("decay", "chain", *words)

    assert status == 0
    assert "cycles: several motions decay together and beat" in output


@pytest.mark.parametrize(
    ("step", "frequency", "stride"),
    [(0.3, 5.0, 1), (0.05, 5.0, 1), (1e-3, 0.1, 1000)],
    ids=["aliased", "four to a cycle", "of a drive that is slow"],
)
def test_rows_too_few_to_a_cycle_are_not_measured(
    step: float, frequency: float, stride: int
) -> None:
    problem = system(mass=[1.0], stiffness=[1e3], damping_ratio=0.01)
    start, march = Start(np.ones(1), np.zeros(1)), March(step, stride)

    turning = 2.0 * np.pi * frequency
    blocks = released(problem, start, march, frequency=turning, periods=40)
    history = joined(list(blocks), "complete")

    assert not measured(problem, history, 0).time.size
    told = unmeasured(problem, history, 0)
    assert re.match(r"x1 has [\d.]+ rows to a cycle, where .* need 12: give a ", told)


def test_fast_swings_on_a_contact_that_sticks_at_last_are_left_out() -> None:
    slider = Element(Jenkins(stiffness=1e6, limit=3.0), between=("x1", "ground"))
    problem = system(mass=[1.0], stiffness=[1e3], elements=[slider])
    start = Start(np.array([0.05]), np.zeros(1))
    period = 2.0 * np.pi / np.sqrt(1e3)

    blocks = released(
        problem, start, March(period / 3000.0, 50), frequency=np.sqrt(1e3), periods=20
    )
    history = joined(list(blocks), "complete")

    decay, lost = measured(problem, history, 0), too_fast(problem, history, 0)
    assert lost > 2
    assert decay.frequency.max() < 50.0  # 1000 on the contact, two rows to a cycle
    told = cycles(decay, "x1", lost)[-1]
    assert told.startswith(f"left out: {lost} swings at the end, whose cycles have few")
    assert not any("left out" in line for line in cycles(decay, "x1"))


@pytest.mark.parametrize(
    ("option", "given"), [("--tolerance", "0.1"), ("--most-periods", "1")]
)
def test_limits_of_a_dwell_do_not_go_with_a_file(
    option: str, given: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    words = ("--from", "quick-sweep.nc", option, given)

    status, output, error = run("decay", str(quick_scene), *words)

    assert (status, output) == (2, "")
    assert error == (
        f"microslip: {option} beside --from: the motion of a file has come to its end: "
        "leave one of them out\n"
    )
    assert not (tmp_path / "quick-decay.nc").exists()


@pytest.mark.parametrize(
    "part", ["microslip.studies.decay.measured", "microslip.files.store.save_table"]
)
def test_a_decay_that_ends_while_it_is_measured_names_its_file(
    part: str, run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(part, interrupted)

    words = ("--frequency", "135", "--tolerance", "0.5", "--periods", "12")
    status, output, _ = run("decay", str(quick_scene), *words)

    assert status == 130
    assert output == "decay in quick-decay.nc\n"
