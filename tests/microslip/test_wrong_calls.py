"""Calls of plain Python that make no sense: one line with a remedy for each."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import microslip

SPRING = microslip.CubicSpring(cubic=1.0)
CHAIN: dict[str, Any] = {"mass": [1.0, 1.0], "stiffness": [[2.0, -1.0], [-1.0, 1.0]]}


@pytest.fixture(scope="module")
def duffing() -> Any:
    return microslip.scene("duffing")


@pytest.mark.parametrize(
    ("given", "text"),
    [
        (
            {"preload": {"x1": 3 + 4j}},
            r"preload of x1 is \(3\+4j\): give a real number",
        ),
        ({"preload": [1.0]}, r"preload = \[1\.0\]: give static forces \[N\] by degree"),
        ({"preload": np.ones(2)}, "preload = array"),
        ({"drive": np.ones(2)}, "drive = array"),
        (
            {"elements": microslip.Element(SPRING, ("x1", "ground"))},
            r"elements = Element\(.*: give a list of microslip.Element",
        ),
        ({"elements": 3}, "elements = 3: give a list"),
        ({"names": [1, "x"]}, "names of degrees of freedom: 1 is no name: give a"),
        ({"names": "xy"}, "names of degrees of freedom: 'xy' is no name: give a list"),
        ({"drive": {"x1": True}}, "drive of x1 is True: give a finite amplitude"),
        ({"preload": {"x1": True}}, "preload of x1 is True: give a finite number"),
        ({"names": 3}, "names of degrees of freedom: 3 is no name"),
        ({"names": ["x", None]}, "names of degrees of freedom: None is no name"),
        ({"names": ["x", ""]}, "names of degrees of freedom: '' is no name"),
        ({"probes": {1: "x1"}}, "probe 1: give a text of one line as its name"),
        ({"probes": {" ": "x1"}}, "probe ' ': give a text of one line as its name"),
        ({"probes": {"a\nb": "x1"}}, r"probe 'a\\nb': give a text of one line"),
        ({"names": ["a\nb", "x2"]}, r"names of degrees of freedom: 'a\\nb' is no name"),
        ({"sets": [1]}, r"sets = \[1\]: give nodes by the name of their set, such as"),
        ({"sets": {"face": "x1"}}, "sets: face = 'x1': give a list of nodes as texts"),
        ({"sets": {"face": []}}, r"sets: face = \[\]: give a list of nodes"),
        ({"sets": {"face": [1]}}, r"sets: face = \[1\]: give a list of nodes"),
        ({"damping_ratio": "1 %"}, "damping_ratio = '1 %': give a number such as 0.01"),
        ({"damping_ratio": ["a"]}, r"damping_ratio = \['a'\]: give a number"),
        ({"loss_factor": "1 %"}, "loss_factor = '1 %': give a number such as 0.01"),
        ({"rayleigh_damping": ("a", 1)}, r"rayleigh_damping = \('a', 1\): give two"),
    ],
)
def test_arguments_of_a_system_that_are_of_no_use_are_named(
    given: dict[str, Any], text: str
) -> None:
    with pytest.raises(ValueError, match=f"^{text}"):
        microslip.system(**CHAIN, **given)


def test_elements_may_come_one_by_one_and_ratios_in_arrays() -> None:
    elements = [
        microslip.Element(SPRING, (name, "ground"), name=name) for name in ("x1", "x2")
    ]

    made = microslip.system(
        **CHAIN, elements=iter(elements), damping_ratio=np.array([0.01, 0.02])
    )

    assert made.interface.names == ("x1", "x2")
    assert made.structure.dense.damping.any()
    rayleigh = microslip.system(**CHAIN, rayleigh_damping=np.array([0.1, 0.0]))
    np.testing.assert_allclose(rayleigh.structure.dense.damping, 0.1 * np.eye(2))


def test_a_picture_has_axes_of_its_own(duffing: Any) -> None:
    march = microslip.sweep(duffing, 4.0, 5.0, duration=0.1, time_step=1e-2)

    with pytest.raises(
        microslip.MicroslipError, match=r"^microslip\.figure: title = 3"
    ):
        microslip.figure(march, 3)  # type: ignore[arg-type]


@pytest.mark.parametrize("labels", [5, "ab", ["a"], ["a", "b", "c"]])
def test_curves_have_a_label_each(duffing: Any, labels: Any) -> None:
    curve = microslip.curve(duffing, 4.0, 4.2, harmonics=1)

    with pytest.raises(
        microslip.MicroslipError, match=r"labels = .*: give a list of 2 texts"
    ):
        microslip.figure([curve, curve], labels=labels)


def test_a_picture_is_not_what_is_saved(duffing: Any, tmp_path: Path) -> None:
    march = microslip.sweep(duffing, 4.0, 5.0, duration=0.1, time_step=1e-2)

    with pytest.raises(
        microslip.MicroslipError, match=r"x.png: it writes netCDF: give"
    ):
        microslip.save(march, tmp_path / "x.png")
    assert not (tmp_path / "x.png").exists()


@pytest.mark.parametrize("ending", ["toml", "csv", "npz", "TOML"])
def test_a_result_is_not_saved_over_a_scene_a_table_or_a_matrix(
    duffing: Any, tmp_path: Path, ending: str
) -> None:
    march = microslip.sweep(duffing, 4.0, 5.0, duration=0.1, time_step=1e-2)
    place = tmp_path / f"mine.{ending}"
    place.write_text("mine")

    with pytest.raises(
        microslip.MicroslipError, match=r"it writes netCDF: give .* ends with \.nc$"
    ):
        microslip.save(march, place)
    assert place.read_text() == "mine"


def call(name: str, /, *given: Any, **more: Any) -> Callable[[], object]:
    return lambda: getattr(microslip, name)(*given, **more)


@pytest.mark.parametrize(
    ("made", "text"),
    [
        (call("Element", "jenkins"), "Element: law = 'jenkins': give a law with its"),
        (
            call("Element", microslip.Jenkins, between=("x1", "ground")),
            r"Element: Jenkins is a class: give Jenkins\(stiffness=…, limit=…\)",
        ),
        (call("PolynomialSpring", [1, 2]), r"polynomial-spring: .* = \[1, 2\]: give"),
        (
            call("PolynomialSpring", {"a": 1}),
            "polynomial-spring: .* of power 'a': give",
        ),
        (call("PolynomialSpring", {3: "b"}), "polynomial-spring: coefficient 'b' of"),
        (
            call("Element", SPRING, ("x1", "ground"), name=5),
            "Element: name = 5: give a text",
        ),
        (
            call("Iwan", slip_force=1.0, stiffness=1e3, chi=0.0, beta=1.0, sliders=2.5),
            "iwan: sliders = 2.5: is not a whole number: give one",
        ),
        (call("EngineOrder", "x1", 1, 1.0), "engine order: blades = 'x1': give a list"),
        (
            call("EngineOrder", [1], 1, 1.0),
            r"engine order: blades = \[1\]: give a list",
        ),
        (
            call("EngineOrder", ["x1"], "1", 1.0),
            "engine order '1': give a whole number",
        ),
        (
            call("EngineOrder", ["x1"], 1.5, 1.0),
            "engine order 1.5: give a whole number",
        ),
        (
            call("EngineOrder", ["x1"], 1, math.nan),
            "engine order: amplitude nan: give a finite number",
        ),
        (call("BaseMotion", [0, 0, math.nan], 1), "base: direction .*: give three"),
        (call("BaseMotion", "xyz", 1), "base: direction xyz: give three numbers"),
        (call("BaseMotion", [0, 0, 1], math.nan), "base: acceleration nan: give a"),
        (call("reduced_problem", 3, 5e3), "reduced_problem: problem = 3: give what"),
    ],
)
def test_what_is_no_law_motion_or_problem_is_told(
    made: Callable[[], object], text: str
) -> None:
    with pytest.raises(ValueError, match=f"^{text}"):
        made()


@pytest.mark.parametrize(
    ("made", "text"),
    [
        (call("scene", None), "scene: source = None: give the name of a built-in"),
        (call("scene", "duffing", 3), "scene: overrides = 3: give texts table.key"),
        (call("scene", "duffing", [None]), r"scene: overrides = \[None\]: give texts"),
        (call("load", None), "load: path = None: give the path of a file"),
    ],
)
def test_what_is_no_scene_or_path_is_told(
    made: Callable[[], object], text: str
) -> None:
    with pytest.raises(microslip.MicroslipError, match=rf"^microslip\.{text}"):
        made()


def test_a_scene_may_be_a_path(tmp_path: Path) -> None:
    from microslip.scenes.scene_file import built_in_text

    path = tmp_path / "mine.toml"
    path.write_text(built_in_text("duffing"), encoding="utf-8")

    assert microslip.scene(path).probes.names == ("x",)


def test_a_result_is_saved_to_a_path_alone(duffing: Any) -> None:
    march = microslip.sweep(duffing, 4.0, 5.0, duration=0.1, time_step=1e-2)

    with pytest.raises(microslip.MicroslipError, match="save: path = 3: give the path"):
        microslip.save(march, 3)  # type: ignore[arg-type]


def test_a_frequency_is_one_number(duffing: Any) -> None:
    given: Any = np.array([4.0, 5.0])

    text = r"curve: lowest = \[4\.0, 5\.0\]: is not a number"
    with pytest.raises(microslip.MicroslipError, match=text):
        microslip.curve(duffing, given, 7.0)


def test_a_sweep_that_would_not_end_names_its_arguments(duffing: Any) -> None:
    text = r"^microslip\.sweep: a march of .*: give a longer time_step, a larger store"
    with pytest.raises(microslip.MicroslipError, match=text):
        microslip.sweep(duffing, 4.0, 5.0, duration=1e9, time_step=1e-6)


def test_modes_are_kept_up_to_a_frequency_with_a_unit() -> None:
    problem = microslip.system(**CHAIN)

    plain = microslip.reduced_problem(problem, 0.2, keep=["x1"])
    units = microslip.reduced_problem(problem, "2e-4 kHz", keep=["x1"])

    assert units.problem.structure.names == plain.problem.structure.names
    with pytest.raises(ValueError, match="highest = '5 kg': has the wrong unit"):
        microslip.reduced_problem(problem, "5 kg", keep=["x1"])
    assert repr(plain).startswith(
        "<ReducedProblem: of 2 degrees of freedom; <Problem: "
    )
    assert "\n" not in repr(plain)


@pytest.mark.parametrize("keep", ["x1", [1], None])
def test_what_is_kept_of_a_reduction_is_a_list_of_texts(keep: Any) -> None:
    problem = microslip.system(**CHAIN)

    with pytest.raises(
        ValueError, match=r"^reduced_problem: keep = .*: give a list of"
    ):
        microslip.reduced_problem(problem, 0.2, keep=keep)


def test_modes_in_a_list_or_alone_are_drawn_but_no_points(duffing: Any) -> None:
    modes = microslip.modes(duffing, 4.0, 6.0, smallest=1e-4, largest=2e-4)

    for drawn in (microslip.figure(list(modes)), microslip.figure(modes[0])):
        assert drawn.axes[0].lines
    with pytest.raises(
        microslip.MicroslipError, match=r"give what microslip.modes, microslip\.cu"
    ):
        microslip.figure(modes[0].points[0])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("slides", "tolerance", "remedy"),
    [
        (True, None, "give a shorter time_step"),
        (True, 1e-3, "give a shorter time_step"),
        (False, None, "give a shorter time_step, or a tolerance"),
    ],
)
def test_a_march_that_does_not_close_is_told_what_closes_it(
    slides: bool, tolerance: float | None, remedy: str
) -> None:
    law = microslip.Jenkins(5e3, 1.0) if slides else microslip.CubicSpring(5e9)
    problem = microslip.system(
        mass=[1.0],
        stiffness=[1e4],
        drive={"x1": 2.0},
        elements=[microslip.Element(law, between=("x1", "ground"))],
    )

    history = microslip.sweep(
        problem, 14.0, 22.0, duration=1.0, time_step=0.02, tolerance=tolerance
    )

    assert history.ending.endswith(f"wrong: {remedy}")


def test_numbers_of_a_law_are_asked_for_in_si_units() -> None:
    with pytest.raises(ValueError, match=r"is not a number: give one in SI units$"):
        microslip.Jenkins(stiffness=np.array([5.0, 6.0]), limit=1.0)  # type: ignore[arg-type]
