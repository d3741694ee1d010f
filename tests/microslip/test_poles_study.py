"""Poles of the linearised scene against a parameter, and the command for them."""

import csv
import itertools
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from hbm.errors import ContinuationError
from hbm.one_harmonic import one_harmonic_response
from hbm.structure.poles import damping_ratios, frequencies
from microslip.scenes.quantity import SceneError
from microslip.studies import poles as study
from microslip.studies.pole_question import FRICTION, SHARES, Question
from microslip.studies.poles import (
    Linearised,
    branches,
    limit_lines,
    limits_of,
    linearised,
)

Run = Callable[..., tuple[int, str, str]]
A = ("model=A",)


def asked(values: list[str], key: str = FRICTION) -> tuple[Question, list[Linearised]]:
    """Return model A at some values of a key."""
    question = Question("two-blades", A, key)
    return question, list(linearised(question, values))


@pytest.mark.long
def test_branches_go_from_the_free_to_the_stuck_structure() -> None:
    question, found = asked(["0", "0.0003", "0.05", "0.2", "0.4", "9"])
    span = limits_of(question.at("0.3"))

    table = branches(found, span)
    free, stuck = (limit_lines(found, name, span) for name in ("free", "stuck"))

    assert table.shape == (6, 2)
    hertz, ratio = frequencies(table), damping_ratios(table)
    np.testing.assert_allclose(hertz[0], frequencies(free[0]), rtol=1e-5)
    # one mode ends as that of the tied blades, the other does not oscillate any more
    last = int(hertz[-1].argmax())
    np.testing.assert_allclose(hertz[-1, last], frequencies(stuck[-1, 0]), rtol=1e-5)
    assert hertz[-1, 1 - last] == 0.0
    assert ratio[-1, 1 - last] == 1.0
    # sliding damps more than either limit
    assert ratio[1:5].max(axis=0).min() > 3.0 * ratio[0].max()


def test_the_friction_coefficients_stay_in_proportion() -> None:
    question = Question("two-blades", ("friction.law=gkf",), FRICTION)

    friction = question.at("0.12").rig.friction

    assert friction.mu_dynamic == 0.12
    assert friction.mu_static == pytest.approx(0.24)


def test_usual_values_go_from_none_to_sticking() -> None:
    values = [
        float(text) for text in Question("two-blades", (), FRICTION).usual_values()
    ]

    assert values[0] == 0.0
    assert len(values) == len(SHARES)
    ratios = [after / before for before, after in itertools.pairwise(values[1:])]
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-3)
    assert values[-1] == pytest.approx(0.3 * SHARES[-1], rel=1e-3)


@pytest.mark.parametrize("lacking", ["friction.mu_dynamic=0", "friction.law=none"])
def test_without_friction_there_is_nothing_to_vary(lacking: str) -> None:
    with pytest.raises(SceneError, match="no friction to vary"):
        Question("two-blades", (lacking,), FRICTION).usual_values()


@pytest.mark.parametrize(
    ("scene", "named"),
    [
        ("friction-beam", "element.friction.mu, such as 0.15 0.5 1.5"),
        ("jenkins", r"element.\w+.limit, such as"),
        ("bladed-disk", "friction.limit, such as 0.3 1 3"),
        ("duffing", "none of its elements has friction"),
    ],
)
def test_other_scenes_are_asked_for_a_key_that_they_have(
    scene: str, named: str
) -> None:
    with pytest.raises(SceneError, match=named):
        Question(scene, (), FRICTION).usual_values()


def test_contacts_that_nothing_presses_are_answered_too() -> None:
    _, (free,) = asked(["0"], "preload.force")

    assert free.ending == "complete"


def test_more_drive_turns_the_stuck_mode_into_sliding_ones() -> None:
    _, (weak, strong) = asked(["0.01", "1"], "excitation.force")

    assert weak.linear is not None
    assert strong.linear is not None
    assert weak.linear.error.amplitude < 1e-6
    assert 0.01 < strong.linear.error.amplitude < 0.3


@pytest.mark.parametrize("failure", [ContinuationError, ValueError])
def test_a_value_without_a_response_leaves_a_gap(
    failure: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = itertools.count()

    def failing(*arguments: object) -> object:
        if next(calls) == 1:
            raise failure("stuck: try less")
        return one_harmonic_response(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(study, "one_harmonic_response", failing)
    question, found = asked(["9", "10", "11"])

    table = branches(found, limits_of(question.at("9")))

    assert [each.ending for each in found] == [
        "complete",
        "stuck: try less",
        "complete",
    ]
    assert np.isnan(table.imag).any(axis=1).tolist() == [False, True, False]


def test_the_command_writes_a_table_and_a_picture(run: Run, tmp_path: Path) -> None:
    status, output, error = run(
        *("poles", "two-blades", "friction", "0", "0.2", "5", "--set", "model=A")
    )

    assert (status, error) == (0, "")
    assert (tmp_path / "two-blades-poles.png").stat().st_size > 20_000
    with (tmp_path / "two-blades-poles.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["friction"] for row in rows] == ["0", "0", "0.2", "0.2", "5", "5"]
    for row in rows:
        pole = complex(float(row["real_1_s"]), float(row["imag_rad_s"]))
        assert float(row["damping_ratio"]) == pytest.approx(-pole.real / abs(pole))
        assert float(row["response_error"]) < 0.01
        assert float(row["response_frequency_error"]) < 1e-4
    printed = re.findall(r"(\d+\.\d{4}) \((\d+\.\d{3})\)", output)
    in_table = {f"{float(row['frequency_hz']):.4f}" for row in rows}
    assert len(printed) == 5
    assert {hertz for hertz, _ in printed} < in_table


def test_poles_of_a_scene_without_elements_are_those_of_its_structure(
    run: Run, tmp_path: Path
) -> None:
    scene = tmp_path / "linear.toml"
    scene.write_text(
        'scene = "system"\nstructure = {mass = [1], stiffness = [1e4], '
        "damping_ratio = 0.01}\ndrive = {x1 = 1}\ncurve = {lowest = 10, highest = 20}\n"
    )

    status, output, error = run("poles", str(scene), "structure.damping_ratio", ".1")

    assert (status, error) == (0, "")
    damped = 100.0 * np.sqrt(1.0 - 0.1**2) / (2.0 * np.pi)
    assert f"{damped:.4f} (10.000)" in output


def test_lines_of_limits_that_cross_keep_their_names(tmp_path: Path) -> None:
    scene = tmp_path / "two.toml"
    scene.write_text(
        """
        scene = "system"
        [structure]
        names = ["x", "y"]
        mass = [1, 1]
        stiffness = [[1e4, 0], [0, 1.25e4]]
        damping_ratio = 0.005
        [[element]]
        name = "slider"
        law = "jenkins"
        between = ["x", "ground"]
        stiffness = 1000
        limit = 1
        [drive]
        x = 0.5
        y = 0.1
        [curve]
        lowest = 14
        highest = 22
        """
    )
    stiffness = np.array([1000.0, 2000.0, 4000.0, 6000.0])
    question = Question(str(scene), (), "element.slider.stiffness")
    found = list(linearised(question, [str(each) for each in stiffness]))

    stuck = limit_lines(found, "stuck", limits_of(question.at("1000")))

    tied = np.sqrt((1e4 + stiffness) * (1.0 - 0.005**2)) / (2.0 * np.pi)
    alone = np.full(4, np.sqrt(1.25e4 * (1.0 - 0.005**2)) / (2.0 * np.pi))
    np.testing.assert_allclose(frequencies(stuck), np.c_[tied, alone], rtol=1e-4)


def test_the_frequency_of_the_response_may_be_given(run: Run, tmp_path: Path) -> None:
    status, output, _ = run(
        *("poles", "two-blades", "friction", "0.3", "--set", "model=A"),
        *("--frequency", "134", "-o", str(tmp_path / "fixed")),
    )

    assert status == 0
    assert "134.0000" in output
    assert (tmp_path / "fixed.csv").is_file()


def test_a_peak_beyond_the_range_is_told(run: Run) -> None:
    settings = ("--set", "curve.lowest=4")

    _, output, _ = run("poles", "duffing", "drive.x", "0.3", "0.02", *settings)

    beyond, within = output.splitlines()[2:4]
    assert beyond.endswith("none  (the peak lies outside the range)")
    assert "outside" not in within


def test_values_before_an_interruption_are_kept(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*arguments: object) -> Iterator[Linearised]:
        yield from itertools.islice(linearised(*arguments), 1)  # type: ignore[arg-type]
        raise KeyboardInterrupt

    monkeypatch.setattr(study, "linearised", stopped)
    words = ("poles", "two-blades", "friction", "5", "9", "--set", "model=A")

    status, _, error = run(*words)

    assert status == 130
    assert error == "microslip: interrupted; what was computed is kept\n"
    table = (tmp_path / "two-blades-poles.csv").read_text(encoding="utf-8")
    assert len(table.splitlines()) == 2


@pytest.mark.usefixtures("no_picture")
def test_small_amplitudes_and_damping_keep_their_digits(run: Run) -> None:
    lightly = "--set=structure.damping_ratio=1e-6"

    status, output, _ = run("poles", "jenkins", "drive.x", "1e-9", lightly)

    assert status == 0
    # both springs hold: F / (2 ζ k_all), where the ratio is one of k alone
    *_, amplitude, _, _, _, ratio = output.splitlines()[2].split()
    assert float(amplitude) == pytest.approx(
        1e-6 / (2e-6 * 1.5e4) / 1.5**-0.5, rel=1e-3
    )
    assert ratio == f"({1e-4 * 1.5**-0.5:.3g})"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("friction", "much"), "mu_dynamic"),
        (("friction", "-1"), "mu_dynamic"),
        (("friction.mu_dynamic",), "give values"),
        (("friction.my_dynamic", "1"), "mu_dynamic"),
        (("friction", "0.1", "0.10"), "0.10 stands there twice: give different"),
        (("excitation.force", "1 N", "2", "1"), "1 stands there twice"),
    ],
)
def test_wrong_values_are_refused_in_one_line(
    words: tuple[str, ...], named: str, run: Run, tmp_path: Path
) -> None:
    status, output, error = run("poles", "two-blades", "--", *words)

    assert (status, output) == (2, "")
    assert named in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
