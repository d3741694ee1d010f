"""Scenes that are wrong: one line with file, table, key and remedy, exit status 2."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

from microslip.scenes.scene_file import built_in_text

Run: TypeAlias = Callable[..., tuple[int, str, str]]
TEXT = built_in_text("two-blades")


def edited(old: str, new: str) -> str:
    """Return the built-in scene with one piece of its text replaced."""
    assert TEXT.count(old) == 1, old
    return TEXT.replace(old, new)


def length(value: str) -> str:
    """Return the built-in scene with another text for the length of the blades."""
    return edited('length = "207.5 mm"', f"length = {value}")


def without_table(name: str) -> str:
    """Return the built-in scene without one table."""
    start = TEXT.index(f"[{name}]")
    end = TEXT.find("\n[", start)
    return TEXT[:start] + (TEXT[end + 1 :] if end > 0 else "")


MALFORMED: dict[str, tuple[str | bytes, tuple[str, ...]]] = {
    "unknown table": (f"{TEXT}\n[ropes]\nstiffness = 1", ("ropes", "rope?")),
    "unknown key": (
        edited('length = "207.5 mm"', "lenght = 0.2"),
        ("[blade] lenght", "unknown", "length?"),
    ),
    "unknown key, nothing like it": (
        edited('length = "207.5 mm"', "zzz = 0.2"),
        ("[blade] zzz", "unknown", "one of length,"),
    ),
    "missing key": (
        edited("poisson_ratio = 0.3", ""),
        ("[blade] poisson_ratio", "missing"),
    ),
    "missing model": (edited('model = "full"', ""), ("model", "missing")),
    "missing rig table": (without_table("friction"), ("[friction]", "missing")),
    "missing experiment": (without_table("curve"), ("[curve]", "missing")),
    "switch for a kind": (
        edited('scene = "two-blades"', "scene = true"),
        ("scene = true: name the kind",),
    ),
    "empty table": (without_table("rope") + "\n[rope]", ("[rope] stiffness",)),
    "wrong unit": (
        length('"207.5 Hz"'),
        ("[blade] length", "207.5 Hz", "unit", '"mm"'),
    ),
    "unit on a dimensionless value": (
        edited("poisson_ratio = 0.3", 'poisson_ratio = "0.3 m"'),
        ("[blade] poisson_ratio", "without a unit"),
    ),
    "text for a number": (
        length('"long"'),
        ("[blade] length", "long", "not a number"),
    ),
    "switch for a number": (
        length("true"),
        ("[blade] length = true:", "not a number"),
    ),
    "date for a number": (
        length("1979-05-27"),
        ("[blade] length", "not a number"),
    ),
    "array for a number": (
        length("[0.2, 0.3]"),
        ("[blade] length", "not a number"),
    ),
    "table for a number": (
        length("{ value = 0.2 }"),
        ("[blade] length", "not a number"),
    ),
    "number for a table": (
        without_table("rope").replace('model = "full"', 'model = "full"\nrope = 10'),
        ("[rope]", "table", "10"),
    ),
    "array for a table": (
        without_table("rope") + "\n[[rope]]\nstiffness = 10",
        ("[rope]", "table"),
    ),
    "number for a switch": (
        edited("clamped = false", "clamped = 0"),
        ("[contact] clamped", "true or false"),
    ),
    "not a number": (
        length("nan"),
        ("[blade] length", "not finite"),
    ),
    "infinite": (length("inf"), ("[blade] length", "not finite")),
    "larger than any float": (
        length("1e400"),
        ("[blade] length", "not finite"),
    ),
    "larger than any float, with unit": (
        length('"1e400 mm"'),
        ("[blade] length", "not finite"),
    ),
    "whole number larger than any float": (
        length("9" * 400),
        ("[blade] length",),
    ),
    "whole number of 5000 digits": (length("9" * 5000), ()),
    "negative mass": (
        edited('mass = "8.4 g"', 'mass = "-8.4 g"'),
        ("[friction_element] mass", "-8.4 g", "above 0 kg"),
    ),
    "no mass": (
        edited('mass = "8.4 g"', "mass = 0"),
        ("[friction_element] mass", "above 0 kg"),
    ),
    "no length": (
        length("0"),
        ("[blade] length = 0", "above 0"),
    ),
    "Poisson's ratio of no material": (
        edited("poisson_ratio = 0.3", "poisson_ratio = 0.7"),
        ("[blade] poisson_ratio = 0.7", "at most 0.5"),
    ),
    "gigapascals typed as pascals": (
        edited('"210 GPa"', "210"),
        ("[blade] young_modulus = 210", "at least 1e+06", "Pa"),
    ),
    "millimetres typed as metres": (
        length("207.5"),
        ("[blade] length = 207.5", "at most 10 m"),
    ),
    "unknown law": (
        edited('law = "coulomb"', 'law = "columb"'),
        ("[friction] law", "columb", "coulomb, gkf, none"),
    ),
    "number for a law": (
        edited('law = "coulomb"', "law = 1"),
        ("[friction] law = 1", "coulomb, gkf, none"),
    ),
    "unknown model": (
        edited('model = "full"', 'model = "C"'),
        ("model", "C", "full, B, A"),
    ),
    "half an element": (
        edited("elements = 4 ", "elements = 4.5 "),
        ("[blade] elements = 4.5", "whole number"),
    ),
    "no elements": (
        edited("elements = 4 ", "elements = 0 "),
        ("[blade] elements = 0", "at least 1"),
    ),
    "no harmonics": (
        edited("# harmonics = 31", "harmonics = 0"),
        ("[curve] harmonics = 0", "at least 1"),
    ),
    "too few samples": (
        edited("# harmonics = 31 ", "harmonics = 31\nsamples = 100 "),
        ("[curve] samples = 100", "31 harmonics", "at least 126"),
    ),
    "sweep that starts after its end": (
        edited('start = "2 s"', 'start = "9 s"'),
        ("[sweep]", "start 9 s", "end 8 s", "start < end"),
    ),
    "sweep that outlasts the march": (
        edited('duration = "10 s"', 'duration = "7 s"'),
        ("[sweep]", "duration 7 s", "end <= duration"),
    ),
    "preload that grows into the sweep": (
        edited('ramp = "1 s"', 'ramp = "3 s"'),
        ("[sweep]", "ramp 3 s", "ramp <= start"),
    ),
    "sweep of one frequency": (
        edited('highest = "145 Hz"           # P', 'highest = "125 Hz" # P'),
        ("[sweep]", "lowest = 125 Hz", "highest = 125 Hz"),
    ),
    "curve of one frequency": (
        edited('highest = "145 Hz"\ntolerance', 'highest = "125 Hz"\ntolerance'),
        ("[curve]", "lowest = 125 Hz", "highest = 125 Hz"),
    ),
    "curve of one frequency but for rounding": (
        edited(
            'highest = "145 Hz"\ntolerance', "highest = 125.00000000000003\ntolerance"
        ),
        ("[curve]", "lowest = 125 Hz", "highest = 125.00000000000003 Hz"),
    ),
    "angles that make no wedge": (
        edited('"20 deg"', '"-20 deg"'),
        ("[contact]", "angle_excited", "angle_follower", "wedge"),
    ),
    "parallel faces": (
        edited('"20 deg"', "0"),
        ("[contact]", "angle_excited", "angle_follower", "wedge"),
    ),
    "no time step": (
        edited('time_step = "25 us"', "time_step = 0"),
        ("[march] time_step = 0", "at least 1e-18 and at most 1e+12 s"),
    ),
    "missing scene key": (
        edited('scene = "two-blades"', ""),
        ("scene is missing", "two-blades"),
    ),
    "unknown kind of scene": (
        edited('scene = "two-blades"', 'scene = "three-blades"'),
        ("scene", "three-blades", "two-blades"),
    ),
    "array for the kind of scene": (
        edited('scene = "two-blades"', "scene = [1]"),
        ("scene", "two-blades"),
    ),
    "table for the kind of scene": (
        edited('scene = "two-blades"', "scene = {a = 1}"),
        ("scene", "two-blades"),
    ),
    "not TOML": ("a scene about blades", ("not valid TOML", "line 1")),
    "table twice": (f"{TEXT}\n[blade]\n", ("not valid TOML", "blade")),
    "nested a thousand times": (f"{TEXT}\nx = {'[' * 3000}{']' * 3000}", ()),
    "empty file": ("", ("is empty: give it a scene", "two-blades")),
    "comment alone": ("# a scene", ("is empty", "two-blades")),
    "binary file": (bytes(range(256)), ("cannot be read", "UTF-8")),
    "UTF-16 file": (TEXT.encode("utf-16"), ("cannot be read", "UTF-8")),
    "zeros": (bytes(100), ("not valid TOML",)),
    "text of several lines for a number": (
        length('"""a\nb"""'),
        ("[blade] length", "not a number"),
    ),
    "line break in an unknown key": (f'{TEXT}\n"a\\nb" = 1', ("[march]", "unknown")),
}


def one_line(error: str) -> str:
    """Return the message after checking that it is one line of ours."""
    assert error.startswith("microslip: ")
    assert error.endswith("\n")
    assert len(error.splitlines()) == 1
    assert "Traceback" not in error
    return error


@pytest.mark.parametrize("name", MALFORMED)
def test_malformed_scene_ends_with_one_line_and_status_2(
    name: str, run: Run, tmp_path: Path
) -> None:
    content, words = MALFORMED[name]
    path = tmp_path / "mine.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())

    status, output, error = run("explain", str(path))

    assert status == 2
    assert output == ""
    message = one_line(error)
    for word in (str(path), *words):
        assert word in message


@pytest.mark.parametrize("command", ["frc", "sweep", "verify", "explain"])
def test_every_command_reads_scenes_alike(
    command: str, run: Run, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(edited("poisson_ratio = 0.3", "poisson_ratio = 0.7"))

    status, output, error = run(command, str(path))

    assert (status, output) == (2, "")
    assert "[blade] poisson_ratio = 0.7" in one_line(error)
    assert sorted(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("blade.length", ("blade.length", "table.key=value")),
        ("=1", ("table.key=value",)),
        ("", ("table.key=value",)),
        ("blade.=1", ("blade.=1", "table.key=value")),
        (".length=1", (".length=1", "table.key=value")),
        ("blade.root.length=1", ("blade.root.length=1", "table.key=value")),
        ("blad.root.length=1", ("no table blad: do you mean blade?",)),
        ("blade.lenght=1", ("[blade] lenght", "length?")),
        ("blades.length=1", ("blades", "blade?")),
        ("modell=A", ("modell", "model?")),
        ("model.kind=A", ("model.kind=A", 'model = "full" has no keys: give model as')),
        ("scene.kind=A", ("scene.kind=A", "scene = ")),
        ("rope=10", ("[rope]", "table", "10")),
        ("sweep=[]", ("[sweep]", "table")),
        ("blade={}", ("[blade] length", "missing")),
        ("blade.length=", ("[blade] length", "not a number")),
        ("blade.length=1,5", ("[blade] length", "1,5", "not a number")),
        ("blade.length=1e400", ("[blade] length", "not finite")),
        ("blade.length=1 kg", ("[blade] length", "1 kg", "unit")),
        ("blade.length='a'\nx", ("[blade] length", "not a number")),
        ("blade.length=0.2\nwidth=1", ("[blade] length", "wrong unit")),
        ("curve.harmonics=512", ("[curve] harmonics = 512", "at most 255")),
        ("curve.samples=1024", ("[curve] samples = 1024", "tolerance", "harmonics")),
        ("curve.tolerance=0", ("[curve] tolerance = 0", "at least 1e-06")),
        ("curve.tolerance=1", ("[curve] tolerance = 1", "at most 0.5")),
        ("scene=[1]", ("scene", "two-blades")),
        ("scene=disc", ("scene", "disc", "two-blades")),
        (f"blade.length={'9' * 400}", ("[blade] length",)),
        (f"blade.length={'[' * 3000}", ()),
    ],
)
def test_wrong_override_ends_with_one_line_and_status_2(
    override: str, words: tuple[str, ...], run: Run
) -> None:
    status, output, error = run("explain", "two-blades", "--set", override)

    assert (status, output) == (2, "")
    message = one_line(error)
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("nowhere.toml", ("no scene file nowhere.toml", "two-blades")),
        ("two_blades", ("no scene file two_blades", "two-blades")),
        ("folder", ("folder cannot be read", "directory")),
        ("mine.toml/scene", ("no scene file mine.toml/scene",)),
        ("x" * 5000, ("cannot be read", "too long")),
        ("two\nblades", ()),
        ("", ()),
    ],
)
def test_scene_that_is_no_file_ends_with_one_line_and_status_2(
    source: str, words: tuple[str, ...], run: Run, tmp_path: Path
) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "mine.toml").write_text(TEXT)

    status, output, error = run("explain", source)

    assert (status, output) == (2, "")
    message = one_line(error)
    for word in words:
        assert word in message


def test_scene_without_permission_ends_with_one_line_and_status_2(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object, **__: object) -> str:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_text", refused)

    status, output, error = run("explain", "mine.toml")

    assert (status, output) == (2, "")
    assert "mine.toml cannot be read: Permission denied" in one_line(error)


def test_unknown_built_in_scene_is_not_printed(run: Run) -> None:
    status, output, error = run("scenes", "three-blades")

    assert (status, output) == (2, "")
    assert "three-blades" in one_line(error)
    assert "two-blades" in error
