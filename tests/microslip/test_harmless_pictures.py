"""Pictures that take nothing away: interrupted ones, and those named like results."""

import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import pytest
from matplotlib.figure import Figure

from microslip.commands.written import written
from microslip.files.store import Stored, save, save_figure
from microslip.studies.poles import branches
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.results.time_history import TimeHistory

Run: TypeAlias = Callable[..., tuple[int, str, str]]
SAID = "microslip: interrupted; files are written only where named above\n"
RANGE = ("--set=curve.lowest=30 Hz", "--set=curve.highest=32 Hz")
CASES = {
    "frc": (("frc", "jenkins", *RANGE), "points in it.nc", "estimated error"),
    "follow": (
        ("follow", "jenkins", "drive.x", "5", "5.1", "--frequency=30 Hz"),
        "points in it.nc",
        "parameter",
    ),
    "sweep": (
        ("sweep", "jenkins", "--set=sweep.duration=1 s", "--set=sweep.end=1 s"),
        "times in it.nc",
        "closing error",
    ),
    "dwell": (
        ("dwell", "gap", "--frequency=30 Hz", "--most-periods=2"),
        "2 periods in it.nc",
        "closing error",
    ),
    "track": (("track", "jenkins", "drive.x", "5", *RANGE), "table in it.csv", "Hz"),
    "modes": (("modes", "gap"), "table in it.csv", "damping"),
    "poles": (
        ("poles", "jenkins", "element.slider.limit", "1", *RANGE),
        "table in it.csv",
        "poles",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_an_interrupted_picture_leaves_tables_and_names_of_files(
    case: str, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("microslip.files.store.save_figure", interrupted)
    words, told, table = CASES[case]
    Path("it.png").write_bytes(b"of an older result")

    status, output, error = run(*words, "-o", "it")

    assert status == 130
    assert error == SAID
    *lines, last = output.splitlines()
    assert last.endswith(told)
    assert any(table in line for line in lines)
    assert [each.name for each in tmp_path.iterdir()] == [told.split()[-1]]


def test_an_interruption_waits_until_what_was_printed_is_in_its_table(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*arguments: Any) -> ComplexArray:
        signal.raise_signal(signal.SIGINT)
        return branches(*arguments)

    monkeypatch.setattr("microslip.studies.poles.branches", interrupted)

    # a process in the background may ignore them
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        status, output, error = run(
            "poles", "jenkins", "element.slider.limit", "1", "-o", "it"
        )
    finally:
        signal.signal(signal.SIGINT, before)

    assert (status, error) == (130, SAID)
    assert output.splitlines()[-1] == "table in it.csv"
    _, row = Path("it.csv").read_text().splitlines()
    assert row.startswith("1,")


def test_a_decay_that_is_not_measured_has_no_older_table_and_picture(
    run: Run, tmp_path: Path
) -> None:
    for name in ("it.csv", "it.png"):
        Path(name).write_bytes(b"of an older decay")

    status, *_ = run(
        *("decay", "gap", "--frequency=5 Hz", "-o", "it"),
        "--set=structure.damping_ratio=0.999",
    )

    assert status == 1
    assert [each.name for each in tmp_path.iterdir()] == ["it.nc"]


def test_an_older_picture_that_is_a_link_is_left_to_its_owner(tmp_path: Path) -> None:
    owner, link = tmp_path / "owner.png", tmp_path / "it.png"
    owner.write_bytes(b"of somebody")
    link.symlink_to(owner)

    with written("table in it.csv", link):
        pass

    assert link.is_symlink()
    assert owner.read_bytes() == b"of somebody"


def test_an_interrupted_picture_leaves_no_half_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = Figure.savefig

    def interrupted(figure: Figure, *where: object, **named: object) -> None:
        whole(figure, *where, **named)  # type: ignore[arg-type]
        raise KeyboardInterrupt

    monkeypatch.setattr(Figure, "savefig", interrupted)

    with pytest.raises(KeyboardInterrupt):
        save_figure(tmp_path / "it.png", Figure(figsize=(1.0, 1.0)))

    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "words",
    [
        ("plot", "it.png"),
        ("plot", "it.nc", "-o", "it.png"),
        ("sweep", "duffing", "--resume", "it.png"),
    ],
)
def test_a_picture_is_not_written_over_its_result(
    words: tuple[str, ...], run: Run, small_history: TimeHistory, tmp_path: Path
) -> None:
    save(tmp_path / "it.nc", Stored(small_history, "", ""))
    (tmp_path / "it.png").hardlink_to(tmp_path / "it.nc")
    before = (tmp_path / "it.nc").read_bytes()

    status, output, error = run(*words)

    assert (status, output) == (2, "")
    assert error.startswith("microslip: it.png holds the result")
    assert len(error.splitlines()) == 1
    assert (tmp_path / "it.nc").read_bytes() == before
