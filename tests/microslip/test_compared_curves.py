"""Several curves in one picture: what it shows, and what is told of each."""

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

import microslip
from microslip.commands.compared_table import compared_table
from microslip.errors import GivenError
from microslip.figures.compared import compared_figure
from microslip.figures.style import COLOURS
from microslip.files.compared import told_apart
from microslip.files.store import Stored, save
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory

Run: TypeAlias = Callable[..., tuple[int, str, str]]
SCENE = 'scene = "two-blades"\n'
FILES = [Path("soft.nc"), Path("stiff.nc")]


def scaled(curve: ResponseCurve, factor: float) -> ResponseCurve:
    return dataclasses.replace(curve, amplitude=factor * curve.amplitude)


@pytest.mark.parametrize(
    ("texts", "labels"),
    [
        (
            ("# --set model=A\n# --set preload.force=3", "# --set model=A"),
            ["preload.force = 3", "the scene's own values"],
        ),
        (
            ("# --set model=B\n# --set model=A", "# --set model = full"),
            ["model = A", "model = full"],
        ),
        (("# --set model=A", "# --set model=A"), ["soft", "stiff"]),
        (("", "model = 1\n# --set model=A"), ["soft", "stiff"]),
    ],
)
def test_curves_are_called_by_what_was_replaced_in_one_scene(
    texts: tuple[str, str], labels: list[str], small_curve: ResponseCurve
) -> None:
    stored = [Stored(small_curve, f"{SCENE}\n{text}", "") for text in texts]

    assert told_apart(stored, FILES) == labels


def test_each_curve_is_drawn_up_to_its_own_largest_amplitude(
    small_curve: ResponseCurve,
) -> None:
    curves = [scaled(small_curve, factor) for factor in (1.0, 2.0, 3.0)]

    axes = compared_figure(curves, ["one", "two", "three"], "").axes[0]

    for label, factor in (("one", 1.0), ("two", 2.0), ("three", 3.0)):
        (line,) = [each for each in axes.lines if each.get_label() == label]
        watched = [i for i, name in enumerate(small_curve.probes) if "-to-" not in name]
        stable = small_curve.unstable <= 0
        largest = 1e3 * factor * small_curve.amplitude[stable][:, watched].max()
        assert np.nanmax(np.asarray(line.get_ydata(), dtype=float)) == pytest.approx(
            largest
        )


def test_more_curves_than_colours_have_one_each(small_curve: ResponseCurve) -> None:
    count = len(COLOURS) + 3
    labels = [str(place) for place in range(count)]

    axes = compared_figure([small_curve] * count, labels, "").axes[0]

    seen = {str(line.get_color()) for line in axes.lines if line.get_label() in labels}
    assert len(seen) == count


def test_what_takes_out_nothing_has_neither_panel_nor_column(
    small_curve: ResponseCurve,
) -> None:
    none = np.zeros(len(small_curve.frequency))
    free = dataclasses.replace(small_curve, friction_energy=none, damping_energy=none)

    assert len(compared_figure([free, free], ["a", "b"], "").axes) == 1
    assert "mJ" not in compared_table([free, free], ["a", "b"])
    assert len(compared_figure([free, small_curve], ["a", "b"], "").axes) == 2
    assert "mJ" in compared_table([free, small_curve], ["a", "b"])


def test_several_files_have_one_picture_and_a_line_each(
    run: Run, small_curve: ResponseCurve, tmp_path: Path
) -> None:
    for file, factor in zip(FILES, (1.0, 2.0), strict=True):
        text = f"{SCENE}\n# --set contact.sigma={factor:g}"
        curve = scaled(small_curve, factor)
        save(tmp_path / file, Stored(curve, text, "microslip frc two-blades"))

    status, output, error = run("plot", *map(str, FILES))

    assert (status, error) == (0, "")
    head, *rows, where = output.splitlines()
    assert head.split()[:3] == ["curve", "largest", "[mm]"]
    assert [row.split()[:3] for row in rows] == [
        ["contact.sigma", "=", "1"],
        ["contact.sigma", "=", "2"],
    ]
    first, second = (float(row.split()[3]) for row in rows)
    assert second == pytest.approx(2.0 * first, rel=1e-4)
    assert where == "picture in compared.png"
    assert (tmp_path / "compared.png").stat().st_size > 1000


def test_what_cannot_be_compared_is_told(
    run: Run, small_curve: ResponseCurve, small_history: TimeHistory, tmp_path: Path
) -> None:
    along = dataclasses.replace(small_curve, along="excitation.force")
    save(tmp_path / "curve.nc", Stored(small_curve, "", ""))
    save(tmp_path / "march.nc", Stored(small_history, "", ""))
    save(tmp_path / "follow.nc", Stored(along, "", ""))

    for other, words in (
        ("march.nc", "march.nc holds a time history: only curves are drawn together"),
        ("follow.nc", "follow.nc along excitation.force: draw them one by one"),
        ("none.nc", "there is no result file none.nc"),
    ):
        status, output, error = run("plot", "curve.nc", other)
        assert (status, output) == (2, "")
        assert words in error
        assert len(error.splitlines()) == 1
    assert not (tmp_path / "compared.png").exists()


def test_a_notebook_compares_curves_too(small_curve: ResponseCurve) -> None:
    both = [small_curve, scaled(small_curve, 2.0)]

    assert microslip.figure(both, labels=["one", "two"]).axes
    assert microslip.figure(both).axes
    with pytest.raises(GivenError, match="give a list of 2 texts"):
        microslip.figure(both, labels=["one"])
    other = dataclasses.replace(small_curve, along="excitation.force")
    with pytest.raises(GivenError, match=r"along excitation\.force and the frequency"):
        microslip.figure([small_curve, other])
