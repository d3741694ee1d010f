"""What a notebook asks for beside a curve: parameters, modes, marches by tolerance."""

import copy
import math
import pickle
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import microslip
from figure_checks import check_labels
from microslip.studies.follow import follow
from microslip.studies.parameter import parameter
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.time_history import TimeHistory

CUBIC, MASS, STIFFNESS = 3.0, 1.0, 30.0


def spring(drive: float = 1.0, cubic: float = CUBIC) -> Problem:
    law = microslip.CubicSpring(cubic=cubic)
    return microslip.system(
        names=["x"],
        mass=[MASS],
        stiffness=[STIFFNESS],
        damping_ratio=0.01,
        drive={"x": drive},
        elements=[microslip.Element(law, between=("x", "ground"), name="cubic")],
    )


def test_a_function_of_a_value_is_followed_as_a_key_of_a_scene_is() -> None:
    def driven(force: float) -> Problem:
        return microslip.scene("duffing", f"drive.x={force!r}")

    curve = microslip.follow(
        driven, 0.05, 0.2, frequency=5.4, label="force [N]", harmonics=5
    )
    few = ("curve.harmonics=5",)
    by_key = follow(parameter("duffing", few, "drive.x", "0.05", "0.2"), 10.8 * math.pi)

    assert curve.ending == "complete"
    assert curve.along == "force [N]"
    assert curve.event.count("fold") == 2
    np.testing.assert_allclose(curve.parameter, by_key.parameter, rtol=1e-12)
    np.testing.assert_allclose(curve.amplitude, by_key.amplitude, rtol=1e-12)
    check_labels(microslip.figure(curve, "duffing"))


def test_results_have_what_the_docstrings_say() -> None:
    curve = microslip.curve(spring(), 0.5, 0.6, harmonics=3)
    along = microslip.follow(spring, 1.0, 2.0, frequency=0.5, harmonics=3)
    march = microslip.sweep(spring(), 0.5, 0.6, duration=1.0, time_step=0.01)

    made = {microslip.curve: curve, microslip.follow: along, microslip.sweep: march}
    for function, result in made.items():
        returned = str(function.__doc__).split("Returns\n")[1].split("Raises\n")[0]
        for name in re.findall(r"``(\w+)[`(]", returned):
            assert hasattr(result, name), name
    np.testing.assert_allclose(curve.frequency[[0, -1]], [math.pi, 1.2 * math.pi])
    assert curve.amplitude.shape == curve.peak.shape == (curve.frequency.size, 1)
    assert march.displacement.shape == march.velocity.shape == (march.time.size, 1)
    assert march.normal_force.shape == march.displacement.shape
    assert march.frequency[-1] == pytest.approx(1.2 * math.pi)


def test_what_scales_with_the_parameter_does_along_it() -> None:
    # x/√(c₀/c) turns one cubic spring into another under √(c₀/c) of the drive
    curve = microslip.follow(
        lambda cubic: spring(math.sqrt(CUBIC / cubic), cubic),
        1.0,
        100.0,
        frequency=1.0,
        harmonics=7,
    )

    scaled = curve.amplitude[:, 0] * np.sqrt(curve.parameter)
    np.testing.assert_allclose(scaled, scaled[0], rtol=1e-6)


@pytest.mark.parametrize("resolution", [{"harmonics": 15}, {"tolerance": 1e-3}])
def test_a_cubic_spring_s_mode_has_its_exact_period(
    resolution: dict[str, Any],
) -> None:
    (mode,) = microslip.modes(
        spring(), 0.5, 1.5, smallest="10 mm", largest=5.0, **resolution
    )

    assert repr(mode).startswith("<FollowedMode: 0.8717")
    assert repr(mode).endswith(" points, 10 to 5000 mm; complete>")
    largest = mode.points[-1]
    assert repr(largest).startswith("<NonlinearMode: 5000 mm, ")
    assert repr(mode.linear).startswith("<LinearMode: 0.8717")
    orders = largest.coefficients[1::2, 0], largest.coefficients[2::2, 0]
    phase = np.linspace(0.0, 2.0 * math.pi, 4001)
    turn = np.outer(phase, np.arange(1, len(orders[0]) + 1))
    swing = np.abs(np.cos(turn) @ orders[0] + np.sin(turn) @ orders[1]).max()
    # T = 4 ∫ dx / ẋ over a quarter, x = a sin φ
    angle = (np.arange(2000) + 0.5) * math.pi / 4000.0
    stiff = STIFFNESS + 0.5 * CUBIC * swing**2 * (1.0 + np.sin(angle) ** 2)
    quarter = np.mean(np.sqrt(MASS / stiff)) * math.pi / 2.0
    exact = math.pi / 2.0 / quarter
    assert exact > 2.0 * mode.linear.frequency / 1.5
    np.testing.assert_allclose(largest.frequency, exact, rtol=1e-3)
    check_labels(microslip.figure((mode,), "cubic"))


def test_a_tolerance_sets_the_steps_of_a_sweep() -> None:
    def swept(tolerance: float | None) -> Any:
        return microslip.sweep(
            spring(), 0.8, 1.6, duration=30.0, time_step=0.1, tolerance=tolerance
        )

    close, equal, best = swept(1e-3), swept(None), swept(1e-8)

    def off(history: Any) -> float:
        sizes = [np.abs(each.displacement).max() for each in (history, best)]
        return float(abs(sizes[0] / sizes[1] - 1.0))

    assert close.ending == equal.ending == "complete"
    np.testing.assert_allclose(close.time, best.time, rtol=0.0, atol=1e-9)
    assert off(close) < 1e-3 < off(equal)
    assert all(off(each) < each.peak_error[-1] for each in (close, equal))


def test_a_sweep_whose_energies_do_not_balance_is_not_complete() -> None:
    history = microslip.sweep(spring(3.0), 0.8, 1.6, duration=30.0, time_step=0.5)

    assert history.ending.startswith("the energy balance does not close")


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_the_unit_of_time_says_nothing(unit: float) -> None:
    """From 2.5 µHz, at steps of an hour, to 2.5 MHz."""

    def marched(second: float) -> TimeHistory:
        hardening = microslip.CubicSpring(cubic=CUBIC / second**2)
        problem = microslip.system(
            mass=[MASS],
            stiffness=[STIFFNESS / second**2],
            damping_ratio=0.01,
            drive={"x1": 1.0 / second**2},
            elements=[microslip.Element(hardening, ("x1", "ground"), name="cubic")],
        )
        return microslip.sweep(
            problem,
            0.5 / second,
            1.5 / second,
            duration=20.0 * second,
            time_step=0.01 * second,
        )

    usual, other = marched(1.0), marched(unit)

    assert other.ending == "complete"
    np.testing.assert_allclose(other.displacement, usual.displacement, atol=1e-10)


@pytest.mark.parametrize("which", [0, -1])
def test_modes_are_equal_if_all_that_they_hold_is(which: int) -> None:
    (mode,) = microslip.modes(spring(), 0.5, 1.5, smallest=0.1, largest=1.0)

    assert pickle.loads(pickle.dumps(mode)) == copy.deepcopy(mode) == mode
    points = list(mode.points)
    points[which] = replace(points[which], damping_error=1.0)
    assert replace(mode, points=tuple(points)) != mode
    assert points[which] != mode.points[which]


def call(name: str, *given: Any, **more: Any) -> Callable[[], object]:
    return lambda: getattr(microslip, name)(*given, **more)


@pytest.mark.parametrize(
    ("made", "text"),
    [
        (
            call("follow", spring(), 1, 2, frequency=1),
            r"follow: problem_at = <Problem.*>: give a function that makes",
        ),
        (
            call("follow", spring, 1, 1.0, frequency=1),
            "follow: first and last are both 1: give two different",
        ),
        (
            call("follow", lambda _: None, 1, 2, frequency=1),
            "follow: problem = None: give what microslip.system",
        ),
        (
            call("follow", spring, 1, 2, frequency=1, label=3),
            "follow: label = 3: give a text",
        ),
        (
            call("follow", spring, 1, 2, frequency=1, label=""),
            "follow: label = '': give a text of one line",
        ),
        (
            call("follow", spring, 1, math.inf, frequency=1),
            "follow: last = inf: is not finite",
        ),
        (
            call("follow", spring, 1, 2, frequency=1, harmonics=3, tolerance=0.1),
            "follow: tolerance = 0.1: harmonics are fixed",
        ),
        (
            call(
                "follow",
                lambda value: microslip.scene("duffing" if value < 2 else "gap"),
                1,
                3,
                frequency=1,
            ),
            "follow: problem_at makes <Problem.* of 1, and <Problem.* of 3: it may",
        ),
        (
            call("modes", spring(), 1, 2, harmonics=3, tolerance=1e-3),
            "modes: tolerance = 0.001: harmonics are fixed: leave one of them out",
        ),
        (
            call("modes", spring(), 1, 2, smallest=2, largest=1),
            "modes: smallest = 2 m, largest = 1 m: give the smaller one first",
        ),
        (call("modes", 3, 1, 2), "modes: problem = 3: give what microslip.system"),
        (
            call("modes", spring(), 100, 200),
            "modes: no mode has a natural frequency in this range: give another",
        ),
        (call("sweep", spring(), 1, 2, duration=1, time_step=0.1, tolerance=2), "sw"),
        (call("figure", (3,)), r"figure: \(3,\): give what microslip.modes, "),
        (call("figure", ()), r"figure: \(\): give what microslip\.modes, "),
    ],
)
def test_what_makes_no_sense_is_told(made: Callable[[], object], text: str) -> None:
    with pytest.raises(microslip.MicroslipError, match=rf"^microslip\.{text}"):
        made()


@pytest.mark.parametrize("kind", ["none", "gap"])
def test_a_function_that_makes_something_else_between_the_ends_is_told(
    kind: str,
) -> None:
    other = None if kind == "none" else microslip.scene(kind)

    def changing(value: float) -> Any:
        return other if 1.5 < value < 1.6 else spring(value)

    with pytest.raises(microslip.MicroslipError, match=r"microslip\.follow: problem"):
        microslip.follow(changing, 1.0, 2.1, frequency=1.0, harmonics=3)
