"""Scenes of kind ``system``: built-in ones, matrices, overrides, malformed files."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import SYSTEMS, built_in_text, load_scene
from microslip.studies.explain.explain import obeyed
from microslip.studies.parameter import parameter
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.beam import RectangularSection
from scene_texts import EXPERIMENTS

Run: TypeAlias = Callable[..., tuple[int, str, str]]
BEGIN = 'scene = "system"\n' + EXPERIMENTS
PAIR = """\
[structure]
names = ["a", "b"]
mass = [1, 2]
stiffness = [[3000, -1000], [-1000, 1000]]
damping_ratio = 0.01
[[element]]
name = "slider"
law = "jenkins"
between = ["a", "b"]
stiffness = "2 N/mm"
limit = "500 mN"
[drive]
a = "2 N"
b = {amplitude = 1, phase = "90 deg"}
[preload]
b = "0.5 N"
[probes]
slip = ["a", "b"]
"""


def written(folder: Path, text: str) -> str:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def made(folder: Path, text: str = PAIR, *overrides: str) -> Problem:
    return problem_of(load_scene(written(folder, BEGIN + text), overrides))


def test_tables_become_the_problem(tmp_path: Path) -> None:
    problem = made(tmp_path)

    assert problem.structure.names == ("a", "b")
    np.testing.assert_array_equal(problem.structure.mass, np.diag([1.0, 2.0]))
    assert problem.interface.points.tangential.tolist() == [2000.0]
    assert problem.interface.points.load.tolist() == [0.5]
    np.testing.assert_array_equal(problem.interface.displacement[1], [1.0, -1.0])
    np.testing.assert_allclose(problem.drive, [2.0, 1.0j], atol=1e-15)
    np.testing.assert_array_equal(problem.preload, [0.0, 0.5])
    assert problem.probes.names == ("slip",)


def test_overrides_reach_elements_loads_and_damping(tmp_path: Path) -> None:
    problem = made(
        tmp_path,
        PAIR,
        "element.slider.limit=2 N",
        "drive.a=3",
        "drive.b.phase=0",
        "preload.b=1",
        "structure.damping_ratio=0",
    )

    assert problem.interface.points.load.tolist() == [2.0]
    assert problem.drive.tolist() == [3.0, 1.0]
    assert problem.preload.tolist() == [0.0, 1.0]
    assert not problem.structure.damping.any()


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("element.slider.limit", "N"),
        ("element.slider.stiffness", "N/m"),
        ("drive.a", "N"),
        ("preload.b", "N"),
        ("structure.damping_ratio", ""),
    ],
)
def test_numbers_can_be_followed(tmp_path: Path, name: str, unit: str) -> None:
    source = written(tmp_path, BEGIN + PAIR)

    followed = parameter(source, (), name, "0.2", "0.4")

    assert followed.label == (f"{name} [{unit}]" if unit else name)
    by_override = problem_of(load_scene(source, [f"{name}=0.3"]))
    by_number = followed.problem_at(0.3)
    for mine, other in (
        (by_number.drive, by_override.drive),
        (by_number.preload, by_override.preload),
        (by_number.structure.damping, by_override.structure.damping),
        (by_number.interface.points.load, by_override.interface.points.load),
        (
            by_number.interface.points.tangential,
            by_override.interface.points.tangential,
        ),
    ):
        np.testing.assert_array_equal(mine, other)


def test_matrices_come_from_an_archive_beside_the_scene(tmp_path: Path) -> None:
    stiffness = np.array([[3000.0, -1000.0], [-1000.0, 1000.0]])
    np.savez(
        tmp_path / "pair.npz", M=np.diag([1.0, 2.0]), K=stiffness, names=["a", "b"]
    )
    inline = PAIR.index("[[element]]")
    head = '[structure]\nmass = "pair.npz:M"\nstiffness = "pair.npz:K"\n'

    problem = made(tmp_path, head + "damping_ratio = 0.01\n" + PAIR[inline:])

    expected = made(tmp_path)
    assert problem.structure.names == expected.structure.names
    for name in ("mass", "damping", "stiffness"):
        np.testing.assert_allclose(
            getattr(problem.structure, name), getattr(expected.structure, name)
        )


def test_cantilever_has_eulers_first_frequency() -> None:
    overrides = ["structure.beam.elements=20", "structure.beam.thickness=2 mm"]
    problem = problem_of(load_scene("friction-beam", overrides))

    squares = np.linalg.eigvals(
        np.linalg.solve(problem.structure.mass, problem.structure.stiffness)
    )

    section = RectangularSection(20e-3, 2e-3, 210e9, 0.3, 7800.0)
    bending = section.young_modulus * 20e-3 * (2e-3) ** 3 / 12.0
    line = section.density * 20e-3 * 2e-3
    closed = 1.875104069**2 * np.sqrt(bending / line / 0.3**4)
    assert np.sqrt(squares.real.min()) == pytest.approx(closed, rel=1e-3)


@pytest.mark.parametrize("name", SYSTEMS)
def test_built_in_systems_load_and_say_their_laws(name: str) -> None:
    scene = load_scene(name)
    problem = problem_of(scene)

    laws = obeyed(scene)
    assert len(laws) == len(scene.rig.element)
    assert all("=" in equation for _, _, equation in laws)
    assert problem.drive.any()
    assert scene.curve.lowest < scene.curve.highest


def test_chain_is_nlvibs_example() -> None:
    problem = problem_of(load_scene("chain"))

    row = np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]])
    np.testing.assert_array_equal(problem.structure.stiffness, row)
    np.testing.assert_allclose(problem.structure.damping, 0.02 * row, rtol=1e-14)
    points = problem.interface.points
    assert remembers(points).tolist() == [True, True, False, False, False]
    assert points.tangential[:2].tolist() == [20.0, 20.0]
    assert (points.dynamic * points.load)[:2].tolist() == [1.0, 1.0]
    assert points.exponent[2:].tolist() == [3.0, 3.0, 1.0]
    assert points.gap[4] == 0.25
    curve = load_scene("chain").curve
    assert 2.0 * np.pi * curve.lowest == pytest.approx(0.5, rel=1e-14)
    assert 2.0 * np.pi * curve.highest == pytest.approx(2.0, rel=1e-14)


def test_frc_draws_and_prints_a_system(run: Run) -> None:
    status, output, error = run("frc", "duffing", "--set", "curve.tolerance=1e-2")

    assert (status, error) == (0, "")
    assert "     [Hz]          x     least      most" in output, "nothing rubs"
    assert "fold" in output
    assert Path("duffing-frc.png").is_file()
    assert Path("duffing-frc.nc").is_file()


@pytest.mark.parametrize(("drive", "said"), [("0 N", True), ("1 N", False)])
def test_frc_says_that_nothing_moves_without_a_drive(
    drive: str, said: bool, run: Run
) -> None:
    _, output, _ = run("frc", "duffing", "--set", f"drive.x={drive}")

    assert ("nothing moves at any frequency" in output) == said


def test_frc_knows_the_stability_of_contacts_that_remember(run: Run) -> None:
    short = ("curve.tolerance=1e-2", "curve.lowest=18", "curve.highest=18.8")
    sets = (word for each in short for word in ("--set", each))

    status, output, error = run("frc", "jenkins", *sets)

    assert (status, error) == (0, "")
    assert "every point is stable" in output


@pytest.mark.parametrize("rigid", [False, True])
def test_sweep_says_that_what_remembers_or_is_rigid_has_no_estimated_error(
    rigid: bool, run: Run, tmp_path: Path
) -> None:
    short = ("sweep.end=0.2", "sweep.duration=0.3", "march.time_step=1e-3")
    sets = [word for each in short for word in ("--set", each)]
    scene = "jenkins"
    if rigid:
        text = built_in_text("jenkins").replace('"jenkins"', '"rigid-coulomb"')
        text = text.replace('between = ["x", "ground"]', 'tangents = [["x", "ground"]]')
        text = text.replace('stiffness = "5 kN/m"\nlimit = "1 N"', "load = 2\nmu = 0.5")
        scene = str(tmp_path / "rigid.toml")
        Path(scene).write_text(text)

    status, output, error = run("sweep", scene, "--tolerance", "1e-6", *sets)

    assert (status, error) == (0, "")
    assert "0.001 s, and no tolerance: a smaller march.time_step lowers" in output
    assert "motions that begin alike part" not in output
    assert "estimated error of the peak amplitude" in output


def test_modes_of_a_slider_go_from_sticking_to_slipping(run: Run) -> None:
    status, output, error = run(
        "modes", "jenkins", "--harmonics", "3", "--amplitudes", "0.1", "10"
    )

    assert (status, error) == (0, "")
    assert "mode at 19.4924 Hz" in output
    assert "most damped" in output


def test_a_march_of_equal_steps_that_is_wrong_asks_for_shorter_ones(run: Run) -> None:
    short = ("sweep.end=2", "sweep.duration=2", "march.time_step=0.01")
    sets = [word for each in short for word in ("--set", each)]

    status, _, error = run("sweep", "jenkins", *sets)

    assert status == 1
    assert "does not close, so the march is wrong: give a shorter march.time" in error


def test_explain_lists_each_element_with_its_equation(run: Run) -> None:
    status, output, _ = run("explain", "chain")

    assert status == 0
    for name in load_scene("chain").rig.element:
        (line,) = (each for each in output.splitlines() if each.startswith(f"{name} "))
        assert "=" in line


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('law = "jenkins"', 'law = "jenkin"', ("slider", "jenkin", "jenkins?")),
        ('law = "jenkins"\n', "", ("slider", "law is missing", "jenkins")),
        ('limit = "500 mN"', "limt = 1", ("slider", "limt = 1", "limit?")),
        ('limit = "500 mN"\n', "", ("slider", "limit", "missing")),
        ('limit = "500 mN"', 'limit = "1 kg"', ("slider", "1 kg", "unit")),
        ('["a", "b"]\nstiff', '["a", "c"]\nstiff', ("slider", "'c'", "a, b")),
        ('["a", "b"]\nstiff', '["a"]\nstiff', ("slider", "two ends", '"ground"')),
        ('["a", "b"]\nstiff', '"a"\nstiff', ("slider", "two ends")),
        ('between = ["a", "b"]\n', "", ("slider", "between", "needs 1")),
        ("[[element]]", "[element]", ("[element]", "[[element]]")),
        ("mass = [1, 2]", "mass = [1, 0]", ("mass of b is 0",)),
        ("mass = [1, 2]", "mass = [1, 2, 3]", ("names", "(3, 3)")),
        ("mass = [1, 2]", "mass = [1, nan]", ("mass", "finite")),
        ("mass = [1, 2]", "mass = 1", ("[structure] mass = 1", "rows")),
        ("mass = [1, 2]\n", "", ("[structure] mass", "missing")),
        ("mass = [1, 2]", 'mass = "none.npz"', ("alike",)),
        ("[-1000, 1000]]", "[1000, 1000]]", ("stiffness is not symmetric",)),
        ("damping_ratio = 0.01", "damping_ratio = -1", ("damping_ratio", "at least 0")),
        ("damping_ratio = 0.01", "damping = [1, -1]", ("damping of b", "negative")),
        ("damping_ratio = 0.01", "dampin = 1", ("dampin", "damping?")),
        (
            "damping_ratio = 0.01",
            "damping_ratio = 0.01\nloss_factor = 0.1",
            ("damping_ratio beside loss_factor",),
        ),
        ("damping_ratio = 0.01", "damping_ratios = [0.1, 0.1, 0.1]", ("3 modes",)),
        ('a = "2 N"', 'c = "2 N"', ("drive", "'c'")),
        ("[drive]", "[base]\ndirection = [1]\nacceleration = 1\n[drive]", ("three",)),
        (
            "[drive]",
            "[base]\ndirection = {a = 1}\nacceleration = 1\n[drive]",
            ("numbers in brackets",),
        ),
        (
            'between = ["a", "b"]',
            'between = ["a", "b"]\neach = ["face"]',
            ("slider", "no set 'face'", "[structure.sets]"),
        ),
        ('a = "2 N"', 'a = "2 m"', ("[drive] a", "2 m", "unit")),
        ('b = "0.5 N"', "b = [1]", ("[preload] b", "not a number")),
        ('slip = ["a", "b"]', 'slip = "d"', ("probe slip", "'d'")),
        ("[drive]", "[driv]", ("driv", "drive?")),
    ],
)
def test_malformed_scene_ends_with_one_line_that_names_the_file(
    tmp_path: Path, old: str, new: str, words: tuple[str, ...]
) -> None:
    assert PAIR.count(old) == 1
    with pytest.raises(SceneError) as raised:
        made(tmp_path, PAIR.replace(old, new))

    message = str(raised.value)
    assert message.startswith(str(tmp_path / "mine.toml"))
    assert "\n" not in message
    for word in words:
        assert word in message


def test_override_of_an_unknown_element_names_those_there_are() -> None:
    with pytest.raises(SceneError, match=r"no element slider: do you mean slider-\d\?"):
        load_scene("chain", ["element.slider.limit=1"])


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("element.cubic.law=[]", r"element cubic: law = \[\] is unknown: give one of"),
        ("element.cubic.between=3", "between = 3: give two ends"),
        ("element.cubic.each=[[1]]", r"element cubic: each: there is no set \[1\]"),
        ("probes=3", "probes = 3: give the names"),
        ("probes.a=5", "probe a = 5: give two ends"),
    ],
)
def test_values_of_a_wrong_kind_are_told_in_one_line(override: str, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        problem_of(load_scene("duffing", [override]))


def test_wrong_numbers_of_the_structure_name_the_scene(tmp_path: Path) -> None:
    table = '[structure.rayleigh]\nfrequencies = ["1 Hz"]\nratios = [0.1]\n[[element]]'
    text = built_in_text("duffing").replace("damping_ratio", "# damping_ratio")
    path = tmp_path / "scene.toml"
    path.write_text(text.replace("[[element]]", table, 1))

    with pytest.raises(
        SceneError, match=r"scene.toml: \[structure.rayleigh\]: give two frequencies"
    ):
        load_scene(str(path), [])


def test_a_tolerance_beside_fixed_harmonics_is_refused(run: Run) -> None:
    status, output, error = run("frc", "chain", "--tolerance", "1e-4")

    assert (status, output) == (2, "")
    assert "the scene fixes curve.harmonics = 7: leave one of them out" in error


def test_a_scene_may_begin_with_a_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "windows.toml"
    path.write_text(built_in_text("duffing"), encoding="utf-8-sig")

    assert load_scene(str(path), []).curve == load_scene("duffing", []).curve


@pytest.mark.parametrize("name", SYSTEMS)
def test_built_in_text_names_the_ground(name: str) -> None:
    assert '"ground"' in built_in_text(name)


@pytest.mark.parametrize("name", ["drive.tip.uz", 'drive."tip.uz"', "preload.tip.uy"])
def test_degrees_of_freedom_with_dots_can_be_overridden_and_followed(name: str) -> None:
    made = parameter("tip-damper", [], name, "1", "3")

    assert made.label == f"{name} [N]"
    loads = [made.problem_at(value) for value in (1.0, 3.0)]
    changed = [np.abs(each.drive).sum() + np.abs(each.preload).sum() for each in loads]
    assert changed[1] == pytest.approx(changed[0] + 2.0)


def test_a_number_for_a_force_keeps_its_phase(tmp_path: Path) -> None:
    path = written(tmp_path, BEGIN + PAIR)

    bare = made(tmp_path, PAIR, "drive.b=3 kN")
    whole = made(tmp_path, PAIR, "drive.b={amplitude=3}")
    followed = parameter(path, [], "drive.b", "3", "4").problem_at(4.0)

    np.testing.assert_allclose(bare.drive, [2.0, 3000.0j], atol=1e-12)
    np.testing.assert_allclose(whole.drive, [2.0, 3.0])
    np.testing.assert_allclose(followed.drive, [2.0, 4.0j], atol=1e-15)


def test_phase_of_a_force_with_dots_can_be_overridden() -> None:
    scene = load_scene("tip-damper", ['drive.tip.uz={amplitude=2, phase="0 deg"}'])
    turned = load_scene(
        "tip-damper",
        ['drive.tip.uz={amplitude=2, phase="0 deg"}', "drive.tip.uz.phase=1"],
    )

    assert scene.rig.drive["tip.uz"].phase == 0.0
    assert turned.rig.drive["tip.uz"].phase == 1.0


@pytest.mark.parametrize(("exponent", "unit"), [("1", "N/m"), ("1.5", "N/m^p")])
def test_the_unit_of_a_stiffness_that_is_followed_is_that_of_its_exponent(
    exponent: str, unit: str
) -> None:
    overrides = (f"element.stop.exponent={exponent}",)

    followed = parameter("gap", overrides, "element.stop.stiffness", "1e3", "2e3")

    assert followed.label == f"element.stop.stiffness [{unit}]"
