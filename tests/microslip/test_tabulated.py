"""A result as a table that other programs read."""

import csv
import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest
from scipy.io import netcdf_file

from microslip.files.result_file import load
from microslip.files.schema import Result
from microslip.files.store import Stored, save
from microslip.files.tabulated import tabulated
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory

Run: TypeAlias = Callable[..., tuple[int, str, str]]


def columns(result: Result) -> dict[str, np.ndarray]:
    heads, rows = tabulated(result)
    return dict(zip(heads, map(np.array, zip(*rows, strict=True)), strict=True))


def test_a_curve_has_a_column_for_each_motion_and_contact(
    small_curve: ResponseCurve,
) -> None:
    found = columns(small_curve)

    np.testing.assert_array_equal(found["frequency [rad/s]"], small_curve.frequency)
    for name, amplitude in zip(
        small_curve.probes, small_curve.amplitude.T, strict=True
    ):
        np.testing.assert_array_equal(found[f"amplitude {name} [m]"], amplitude)
    for name, force in zip(
        small_curve.contacts, small_curve.normal_largest.T, strict=True
    ):
        np.testing.assert_array_equal(found[f"normal_largest {name} [N]"], force)
    assert found["event"].tolist() == list(small_curve.event)
    assert "unstable" in found


def test_what_repeats_another_variable_is_left_out(small_curve: ResponseCurve) -> None:
    amplitude = small_curve.amplitude
    same = dataclasses.replace(
        small_curve, amplitude_lowest=amplitude, amplitude_highest=2.0 * amplitude
    )

    heads = " ".join(columns(same))

    assert "amplitude_lowest" not in heads
    assert "amplitude_highest" in heads


def test_what_is_followed_has_its_own_unit(small_curve: ResponseCurve) -> None:
    along = dataclasses.replace(small_curve, along="drive.x [N]")

    assert "parameter of drive.x [N]" in columns(along)
    assert "parameter [rad/s]" in columns(small_curve)


def test_a_march_has_a_row_for_each_time(small_history: TimeHistory) -> None:
    found = columns(small_history)

    np.testing.assert_array_equal(found["time [s]"], small_history.time)
    for name, energy in zip(
        small_history.energies, small_history.energy.T, strict=True
    ):
        np.testing.assert_array_equal(found[f"energy {name} [J]"], energy)
    assert not any(head.startswith("checkpoint") for head in found)


def test_plot_writes_the_table_of_a_file(
    run: Run, small_curve: ResponseCurve, tmp_path: Path
) -> None:
    save(tmp_path / "result.nc", Stored(small_curve, "", ""))

    status, output, error = run("plot", "result.nc", "--csv", "result.csv")

    assert (status, error) == (0, "")
    assert output == "picture in result.png\ntable in result.csv\n"
    with (tmp_path / "result.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    place = head.index(f"amplitude {small_curve.probes[0]} [m]")
    read = [float(row[place]) for row in rows]
    np.testing.assert_array_equal(read, small_curve.amplitude[:, 0])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("result.nc", "--csv", "result.nc"), "its table would be written over it"),
        (("result.nc", "result.nc", "--csv", "x.csv"), "give one"),
        (("result.nc", "--csv", "nowhere/x.csv"), "there is no folder nowhere"),
    ],
)
def test_a_table_that_cannot_be_written_is_told_before_anything_is(
    arguments: tuple[str, ...],
    words: str,
    run: Run,
    small_curve: ResponseCurve,
    tmp_path: Path,
) -> None:
    save(tmp_path / "result.nc", Stored(small_curve, "", ""))

    status, output, error = run("plot", *arguments)

    assert (status, output) == (2, "")
    assert words in error
    assert len(error.splitlines()) == 1
    assert [each.name for each in tmp_path.iterdir()] == ["result.nc"]


def test_the_unit_of_a_parameter_may_have_any_letters(
    small_curve: ResponseCurve, tmp_path: Path
) -> None:
    path = tmp_path / "result.nc"
    along = dataclasses.replace(small_curve, along="Weg ü [µm]")

    save(path, Stored(along, "", ""))

    assert load(path).result == along
    with netcdf_file(path, "r", mmap=False) as file:
        assert getattr(file.variables["parameter"], "units") == "µm".encode()  # noqa: B009
    assert "parameter of Weg ü [µm]" in columns(along)
