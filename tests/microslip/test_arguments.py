"""Numbers on the command line."""

from pathlib import Path

import pytest

from microslip.cli import _parser, main
from microslip.commands import arguments


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("5 kN", "5 kN has the wrong unit: give a number in Hz, or a text with one of"),
        ("-3", "-3 is out of range: it must be at least 1e-12"),
        ("inf", "inf is not finite"),
        ("fast", "fast is not a number: give one in Hz"),
    ],
)
def test_frequencies_that_are_none_are_refused(
    given: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["follow", "duffing", "drive.x", "1", "2", f"--frequency={given}"])

    assert stopped.value.code == 2
    assert f"argument --frequency: {told}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("dwell", "--most-periods=x"), "x: give a whole number from 1 to 10000000"),
        (("dwell", "--most-periods=0"), "0: give a whole number from 1 to 10000000"),
        (("dwell", "--tolerance=x"), "x: give a positive finite number"),
        (("decay", "--periods=1.5"), "1.5: give a whole number from 1 to 10000000"),
        (("verify", "--steps=few"), "few: give a whole number from 1 to 10000000"),
        (("verify", "--periods=1"), "1: give a whole number from 2 to 10000000"),
        (("stress", "--processes=65"), "65: give a whole number from 1 to 64"),
        (("modes", "--harmonics=128"), "128: give a whole number from 1 to 127"),
        (("decay", "--tolerance=2"), "2: give a number above 0 and below 1"),
        (("verify", "--tolerance=1"), "1: give a number above 0 and below 1"),
        (("jumps", "--lead=1"), "1: give a number above 0 and below 1"),
        (("modes", "--tolerance=2"), "2: give a number from 1e-06 to 0.5"),
    ],
)
def test_numbers_that_are_none_are_told_what_is_wanted(
    words: tuple[str, str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    command, option = words
    with pytest.raises(SystemExit) as stopped:
        main([command, "duffing", option])

    assert stopped.value.code == 2
    name, _, _ = option.partition("=")
    assert f"argument {name}: {told}: see" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ("poles", "tip-damper", "friction", "0", "0.3"),
            "tip-damper: no one friction coefficient stands for this scene: give a key "
            "and values (element.pin.mu, such as 0.09 0.3 0.9)",
        ),
        (
            ("frc", "duffing", "--set=structure.mass.0=1"),
            "--set structure.mass.0=1: mass = [1] has no keys: give structure.mass as "
            "a whole",
        ),
        (
            ("frc", "chain", '--set=structure.names=["a", "a", "b"]'),
            "chain: names of degrees of freedom: a stands there more than once: give "
            "each its own name",
        ),
        (
            ("frc", "chain", '--set=structure.names=["a", "ground", "b"]'),
            "chain: names of degrees of freedom: ground is what does not move: give "
            "another name",
        ),
        (
            ("frc", "chain", "--set=base={direction = [1, 0, 0], acceleration = 1}"),
            "chain: degree of freedom x1 does not say in which direction it is, which "
            "ground that moves needs: give it a name that does, such as x1.x, x1.y or "
            "x1.z",
        ),
    ],
)
def test_keys_that_a_scene_does_not_take_are_told(
    words: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(list(words)) == 2
    assert capsys.readouterr().err == f"microslip: {told}\n"


@pytest.mark.parametrize(
    "words",
    [
        "poles duffing --set curve.highest=6 element.cubic.cubic 1 2",
        "poles duffing element.cubic.cubic --set curve.highest=6 1 2",
        "poles --set curve.highest=6 duffing element.cubic.cubic 1 2",
        "poles duffing element.cubic.cubic 1 2 --set curve.highest=6",
    ],
)
def test_options_stand_anywhere_between_what_has_no_name(words: str) -> None:
    options, unknown = _parser().parse_known_args(words.split())

    assert unknown == []
    assert (options.scene, options.key) == ("duffing", "element.cubic.cubic")
    assert options.values == ["1", "2"]
    assert options.overrides == ["curve.highest=6"]


@pytest.mark.parametrize(
    "words",
    ["track bladed-disk drive.amplitude 1 2", "poles bladed-disk friction.limit 1"],
)
def test_what_cannot_be_solved_is_refused_before_a_head_is_printed(
    words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == 2

    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith('microslip: solve = "sector": only frc and explain')


def test_quantities_may_have_a_unit() -> None:
    assert arguments.hertz("0.1 kHz") == pytest.approx(100.0)
    assert arguments.hertz("100") == 100.0
    assert arguments.millimetres("20 um") == pytest.approx(0.02)
    assert arguments.millimetres("2e-2") == pytest.approx(0.02)


def test_a_folder_that_cannot_be_written_to_is_told_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("os.access", lambda *_: False)

    assert main(["frc", "duffing", "-o", str(tmp_path / "curve")]) == 2

    said = f"microslip: the folder {tmp_path} cannot be written to: give another one"
    assert capsys.readouterr().err.startswith(said)


@pytest.mark.parametrize(
    "words",
    [
        "grid duffing --csv d",
        "tables --csv d",
        "frc duffing -o curve",
        "track duffing drive.x 1 2 -o table",
        "sweep duffing -o curve",
        f"frc duffing -o {'long' * 75}",
        f"grid duffing --csv {'long' * 75}.csv",
    ],
)
def test_a_file_that_cannot_be_written_is_told_before_the_work(
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("d", "curve.png", "table.csv"):
        Path(folder).mkdir()

    assert main(words.split()) == 2

    said = capsys.readouterr()
    assert said.out == ""
    if "long" in words:
        assert said.err.startswith("microslip: longlonglong")
        assert "… cannot be written: File name too long: give another name" in said.err
    else:
        assert " is a folder and cannot be written: give the name of a file" in said.err
    assert not [each for each in Path().iterdir() if each.is_file()]


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (["frc", "duffing", "--effort", "2"], "--effort 2: it is that of"),
        (
            ["frc", "duffing", "-o", "a.csv"],
            "-o a.csv: a.nc and a.png would be written: give that name without its "
            "ending; microslip plot FILE --csv TABLE writes columns as text",
        ),
        (
            ["track", "duffing", "drive.x", "1", "2", "-o", "b.nc"],
            "-o b.nc: b.csv and b.png would be written: give that name without its "
            "ending\n",
        ),
        (["verify", "duffing", "--steps", "50"], "--steps 50: they are those of"),
    ],
)
def test_what_is_not_wanted_is_refused(
    command: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(command) == 2

    assert capsys.readouterr().err.startswith(f"microslip: {said}")


def test_a_scene_that_ends_like_a_folder_is_told_as_it_was_given(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "two-blades/"]) == 2

    said = "there is no scene file two-blades/, and no built-in scene of that name: do"
    assert f"microslip: {said} you mean two-blades?" in capsys.readouterr().err
