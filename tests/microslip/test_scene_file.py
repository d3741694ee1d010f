"""Scenes that are right: the built-in one, copies, overrides, optional tables."""

import dataclasses
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

import rigs
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import BUILT_IN, built_in_text, load_scene
from microslip.scenes.two_blades.tables import TwoBlades

Run: TypeAlias = Callable[..., tuple[int, str, str]]


def plain(scene: Scene) -> dict[str, object]:
    """Return all values of a scene but its text and where it comes from."""
    return {**dataclasses.asdict(scene), "text": "", "source": ""}


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """Return a copy of the built-in scene."""
    path = tmp_path / "mine.toml"
    path.write_text(built_in_text("two-blades"), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", BUILT_IN)
def test_built_in_scene_loads(name: str) -> None:
    scene = load_scene(name)

    assert isinstance(scene.rig, TwoBlades) == (name == "two-blades")
    assert scene.text == built_in_text(name)


def test_values_of_the_built_in_scene_are_those_of_its_text() -> None:
    scene = load_scene("two-blades")

    assert scene.rig == rigs.rig()
    assert scene.rig.blade.length == pytest.approx(0.2075, rel=1e-15)
    assert (scene.sweep.start, scene.sweep.end) == (2.0, 8.0)
    assert (scene.curve.lowest, scene.curve.highest) == (125.0, 145.0)
    assert scene.march.time_step == pytest.approx(25e-6, rel=1e-15)


def test_copy_of_the_built_in_scene_is_the_same_scene(copied: Path) -> None:
    scene = load_scene(str(copied))

    assert scene == load_scene("two-blades")


def test_copy_with_the_built_in_name_goes_before_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = built_in_text("two-blades").replace('"207.5 mm"', "0.1")
    Path("two-blades").write_text(text, encoding="utf-8")

    scene = load_scene("two-blades")

    assert scene.rig.blade.length == 0.1


def test_every_key_of_the_tables_stands_in_the_built_in_text() -> None:
    document = tomllib.loads(built_in_text("two-blades"))
    fields = {field.name for field in dataclasses.fields(TwoBlades)}
    fields -= {"rotation"}  # the rig stands still

    assert fields < set(document)
    for name in fields - {"model"}:
        made = getattr(load_scene("two-blades").rig, name)
        assert set(document[name]) == {each.name for each in dataclasses.fields(made)}


@pytest.mark.parametrize(
    ("override", "table", "key", "value"),
    [
        ("blade.length=0.3", "blade", "length", 0.3),
        ("blade.length=.3", "blade", "length", 0.3),
        ("blade.length=+3.e-1", "blade", "length", 0.3),
        ("rope.stiffness=5.", "rope", "stiffness", 5.0),
        ("blade.length=300 mm", "blade", "length", 0.3),
        ('blade.length="300 mm"', "blade", "length", 0.3),
        ("blade.length = 300 mm", "blade", "length", 0.3),
        ("blade.elements=7", "blade", "elements", 7),
        ("blade.elements=7.0", "blade", "elements", 7),
        ("friction.law=gkf", "friction", "law", "gkf"),
        ("friction.law='none'", "friction", "law", "none"),
        ("contact.clamped=true", "contact", "clamped", True),
        ("contact.sigma=3e-7", "contact", "sigma", 3e-7),
        ("rope.stiffness=0", "rope", "stiffness", 0.0),
    ],
)
def test_override_replaces_one_value(
    override: str, table: str, key: str, value: object
) -> None:
    scene = load_scene("two-blades", [override])

    changed = getattr(getattr(scene.rig, table), key)
    assert changed == pytest.approx(value)
    assert type(changed) is type(value)
    restored = dataclasses.asdict(scene.rig)
    restored[table][key] = dataclasses.asdict(load_scene("two-blades").rig)[table][key]
    assert restored == dataclasses.asdict(load_scene("two-blades").rig)


@pytest.mark.parametrize("model", ["full", "B", "A"])
def test_model_is_a_choice(model: str) -> None:
    scene = load_scene("two-blades", [f"model={model}"])

    assert scene.rig.model == model


def test_last_of_two_overrides_holds() -> None:
    scene = load_scene("two-blades", ["model=A", "model=B"])

    assert scene.rig.model == "B"


def test_overrides_of_experiments_are_read_too() -> None:
    scene = load_scene(
        "two-blades",
        ["curve.harmonics=5", "sweep.highest=0.15 kHz", "march.time_step=1e-5"],
    )

    assert scene.curve.harmonics == 5
    assert scene.sweep.highest == 150.0
    assert scene.march.time_step == 1e-5


def test_overrides_end_the_text_as_comments() -> None:
    scene = load_scene("two-blades", ["model=A", "contact.sigma=3e-7"])

    tail = scene.text.removeprefix(built_in_text("two-blades"))
    assert tail.split("\n") == ["", "# --set model=A", "# --set contact.sigma=3e-7"]
    assert tomllib.loads(scene.text) == tomllib.loads(built_in_text("two-blades"))


def test_rope_may_be_left_out(copied: Path) -> None:
    text = copied.read_text(encoding="utf-8")
    start = text.index("[rope]")
    end = text.index("[contact]")
    copied.write_text(text[:start] + text[end:], encoding="utf-8")

    scene = load_scene(str(copied))

    assert scene.rig.rope is None


def test_rope_that_was_left_out_comes_back_by_an_override(copied: Path) -> None:
    text = copied.read_text(encoding="utf-8")
    start, end = text.index("[rope]"), text.index("[contact]")
    copied.write_text(text[:start] + text[end:], encoding="utf-8")

    scene = load_scene(str(copied), ["rope.stiffness=20"])

    assert scene.rig.rope is not None
    assert scene.rig.rope.stiffness == 20.0


def test_windows_line_ends_change_nothing(copied: Path) -> None:
    copied.write_bytes(copied.read_bytes().replace(b"\n", b"\r\n"))

    scene = load_scene(str(copied))

    assert plain(scene) == plain(load_scene("two-blades"))


def test_scene_error_names_the_file_as_it_was_given(copied: Path) -> None:
    with pytest.raises(SceneError, match=f"^{copied}: "):
        load_scene(str(copied), ["blade.length=-1"])


LEAST = """
scene = "system"
[structure]
mass = [1]
stiffness = [1000]
damping_ratio = 0.02
[drive]
x1 = "0.5 N"
"""
CURVE = """
[curve]
lowest = 4
highest = 7
"""


def test_a_scene_needs_the_tables_of_what_is_done_with_it_alone(
    run: Run, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(LEAST + CURVE, encoding="utf-8")

    assert load_scene(str(path)).curve.tolerance == 1e-3
    status, _, error = run("frc", str(path), "-o", str(tmp_path / "curve"))
    assert (status, error) == (0, "")

    status, _, error = run("sweep", str(path))
    assert status == 2
    assert error == f"microslip: {path}: table [sweep] is missing: add it\n"


@pytest.mark.parametrize("name", ["sweep", "curve", "march"])
def test_tables_that_are_left_out_are_named(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(LEAST, encoding="utf-8")

    with pytest.raises(SceneError, match=rf"table \[{name}\] is missing: add it"):
        getattr(load_scene(str(path)), name)


def test_all_that_a_table_lacks_is_told_at_once(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        'scene = "two-blades"\nmodel = "A"\n[excitation]\nforce = "1 N"\n',
        encoding="utf-8",
    )

    told = r"table \[blade\], table \[blade_end\], .* are missing: add them"
    with pytest.raises(SceneError, match=told):
        load_scene(str(path))
