"""Events of curves against a parameter, and the command that draws them."""

import csv
from pathlib import Path

import numpy as np
import pytest

from microslip.cli import main
from microslip.figures.track import track_figure
from microslip.scenes.scene_file import load_scene
from microslip.studies.axis import axis
from microslip.studies.track import tracked
from scene_texts import BETWEEN_FACES

SHORT = ("model=A", "curve.lowest=134 Hz", "curve.highest=136 Hz")


def test_without_sliding_the_peak_is_proportional_to_the_drive() -> None:
    sticky = (*SHORT, "friction.mu_dynamic=50")

    one, two = tracked("two-blades", sticky, "excitation.force", ["0.5", "1 N"])

    assert one.peak is not None
    assert two.peak is not None
    assert two.peak.amplitude == pytest.approx(2.0 * one.peak.amplitude, rel=1e-4)
    assert two.peak.frequency == pytest.approx(one.peak.frequency, rel=1e-7)


def test_more_drive_slides_more_and_grows_less() -> None:
    one, two = tracked("two-blades", SHORT, "excitation.force", ["0.5", "1"])

    assert one.peak is not None
    assert two.peak is not None
    assert two.peak.amplitude < 1.5 * one.peak.amplitude


def test_the_largest_amplitude_by_other_tractions_is_told(tmp_path: Path) -> None:
    scene = tmp_path / "faces.toml"
    scene.write_text(BETWEEN_FACES, encoding="utf-8")

    held, free = tracked(str(scene), (), "element.holds.limit", ["40 N", "1e-3 N"])

    assert held.peak is not None
    assert held.otherwise is not None
    assert held.otherwise.amplitude > 1.2 * held.peak.amplitude
    assert free.otherwise is None


def test_the_command_writes_a_table_and_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["track", "two-blades", "excitation.force", "0.5", "1"]
    overrides = [word for each in SHORT for word in ("--set", each)]

    status = main([*words, *overrides, "-o", str(tmp_path / "drive")])

    assert status == 0
    assert "peak" in capsys.readouterr().out
    assert (tmp_path / "drive.png").stat().st_size > 10_000
    with (tmp_path / "drive.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["excitation.force"] for row in rows} == {"0.5", "1"}


def test_a_key_that_the_scene_lacks_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["track", "two-blades", "excitation.farce", "1"]) == 2
    assert "force" in capsys.readouterr().err


def test_a_value_that_stands_twice_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["track", "two-blades", "excitation.force", "1", "2", "1 N"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "1 N stands there twice: give different values" in said.err


def test_values_with_units_lie_in_their_order() -> None:
    texts = ["50 mN", "0.1 N", "1"]
    scenes = [load_scene("duffing", [f"drive.x={text}"]) for text in texts]

    assert axis("drive.x", texts, scenes) == ([0.05, 0.1, 1.0], "drive.x [N]", [])


def test_numbers_that_are_not_the_rigs_lie_where_they_were_given() -> None:
    texts = ["134 Hz", "136 Hz"]
    scenes = [load_scene("two-blades", [f"curve.lowest={text}"]) for text in texts]

    label = "curve.lowest [Hz]"
    assert axis("curve.lowest", texts, scenes) == ([134.0, 136.0], label, [])


def test_values_that_are_no_numbers_lie_in_the_order_of_the_list() -> None:
    scenes = [load_scene("two-blades", [f"model={text}"]) for text in ("A", "full")]

    names = ["A", "full"]
    assert axis("model", names, scenes) == ([0.0, 1.0], "model", names)


def test_values_out_of_order_are_drawn_in_order() -> None:
    peaks = [(1.0, 134.0, 1e-3), (3.0, 133.0, 3e-3), (2.0, 133.5, 2e-3)]

    figure = track_figure(peaks, [], "drive", "two-blades", otherwise=[(2.0, 5e-3)])

    left, right = figure.axes
    for axes in (left, right):
        assert np.array_equal(axes.lines[0].get_xdata(), [1.0, 2.0, 3.0])
    assert np.array_equal(left.lines[1].get_ydata(), [5.0])
    assert left.get_ylim()[1] > 5.0


@pytest.mark.parametrize("step", [1e-4, 1e-9])
def test_ticks_of_values_that_hardly_differ_are_told_apart(step: float) -> None:
    peaks = [(1000.0 + step * place, 134.0, 1e-3) for place in range(5)]

    figure = track_figure(peaks, [], "drive.x", "two-blades")

    figure.draw_without_rendering()
    labels = [label.get_text() for label in figure.axes[0].get_xticklabels()]
    assert len(set(labels)) == len(labels) > 2


@pytest.mark.parametrize(
    ("drives", "scale"), [((0.1, 1.0, 10.0), "log"), ((1.0, 2.0, 3.0), "linear")]
)
def test_amplitudes_over_decades_of_a_parameter_are_drawn_by_decades(
    drives: tuple[float, ...], scale: str
) -> None:
    peaks = [(drive, 134.0, 1e-3 * drive) for drive in drives]

    figure = track_figure(peaks, [], "excitation.force [N]", "two-blades")

    left = figure.axes[0]
    assert left.get_yscale() == scale
    assert left.get_ylim()[1] > drives[-1]
    assert left.get_ylim()[0] < drives[0]


def test_a_range_that_ends_below_its_peak_tells_the_largest_amplitude(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["track", "duffing", "drive.x", "0.05", "0.4", "-o", str(tmp_path / "a")]

    assert main(words) == 0

    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    told = {(row["drive.x"], row["event"]): row for row in rows}
    assert ("0.05", "peak") in told
    assert ("0.05", "largest") not in told
    assert float(told["0.4", "largest"]["frequency_hz"]) == pytest.approx(7.0)
    assert float(told["0.4", "largest"]["amplitude_m"]) > 4e-3
    assert "largest" in capsys.readouterr().out
