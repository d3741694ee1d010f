"""Files that hold no result: each is told in one line."""

from collections.abc import Callable
from pathlib import Path

import pytest
from scipy.io import netcdf_file

from microslip.files.result_file import load
from microslip.files.store import StoreError


def no_file(path: Path) -> None:
    """Leave the path empty."""


def folder(path: Path) -> None:
    path.mkdir()


def empty(path: Path) -> None:
    path.write_bytes(b"")


def text(path: Path) -> None:
    path.write_text("a result about blades")


def other_netcdf(path: Path) -> None:
    with netcdf_file(path, "w") as file:
        file.createDimension("place", 3)


def unknown_kind(path: Path) -> None:
    texts = {"kind": "mode shapes", "scene": "", "command": ""}
    with netcdf_file(path, "w") as file:
        for name, content in texts.items():
            setattr(file, name, content)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (no_file, "there is no result file .*: give what frc, follow, "),
        (folder, "cannot be read: Is a directory"),
        (empty, "is not a result file"),
        (text, "is not a result file"),
        (other_netcdf, "is not a result file"),
        (unknown_kind, "'mode shapes', which this version does not know: give what"),
    ],
)
def test_file_that_is_no_result_is_told_in_words(
    make: Callable[[Path], None], words: str, tmp_path: Path
) -> None:
    path = tmp_path / "result.nc"
    make(path)

    with pytest.raises(StoreError, match=words) as caught:
        load(path)
    assert str(path) in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1
