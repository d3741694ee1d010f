"""Pictures and tables that are written: their formats, and failures in words."""

import csv
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from microslip.files.store import StoreError, save_figure, save_table


@pytest.mark.parametrize("name", ["nowhere/picture.png", "folder.png"])
def test_picture_that_cannot_be_written_is_told_in_words(
    name: str, tmp_path: Path
) -> None:
    (tmp_path / "folder.png").mkdir()

    with pytest.raises(StoreError, match=f"{name} cannot be written: "):
        save_figure(tmp_path / name, Figure())


def test_picture_of_an_unknown_format_is_told_in_words(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match=r"picture\.xyz .*\.png, \.pdf or \.svg"):
        save_figure(tmp_path / "picture.xyz", Figure())


def test_picture_that_cannot_be_drawn_is_not_blamed_on_its_ending(
    tmp_path: Path,
) -> None:
    with pytest.raises(ValueError, match="too large"):
        save_figure(tmp_path / "picture.png", Figure(figsize=(1e6, 1.0)))


@pytest.mark.parametrize(
    ("ending", "start"),
    [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".svg", b"<?xml")],
)
def test_picture_has_the_format_of_its_ending(
    ending: str, start: bytes, tmp_path: Path
) -> None:
    path = (tmp_path / "picture").with_suffix(ending)

    save_figure(path, Figure(figsize=(1.0, 1.0)))

    assert path.read_bytes().startswith(start)


def test_table_is_read_back_as_it_was_written(tmp_path: Path) -> None:
    path, rows = tmp_path / "table.csv", [("a, b", 0.1 + 0.2), ("", -1e-300)]

    save_table(path, ("name", "value"), rows)

    with path.open(encoding="utf-8", newline="") as file:
        names, *found = csv.reader(file)
    assert names == ["name", "value"]
    assert [(name, float(value)) for name, value in found] == rows


@pytest.mark.parametrize("name", ["nowhere/table.csv", "folder.csv"])
def test_table_that_cannot_be_written_is_told_in_words(
    tmp_path: Path, name: str
) -> None:
    (tmp_path / "folder.csv").mkdir()

    with pytest.raises(StoreError, match=f"{name} cannot be written: "):
        save_table(tmp_path / name, ("name",), [])
