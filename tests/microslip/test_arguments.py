"""Numbers on the command line."""

from pathlib import Path

import pytest

from microslip.cli import main
from microslip.commands import arguments


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("5 kN", "5 kN has the wrong unit: give a number in Hz, or a text with one of"),
        ("-3", "-3 is out of range: it must be above 0 Hz"),
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
