"""Files are written at once: nobody reads, or leaves, a half of one."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from microslip.files.record_file import RecordFile
from microslip.files.record_layout import Layout
from microslip.files.whole_file import write_whole


def test_who_has_a_file_open_keeps_what_it_was(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    write_whole(path, b"before")

    with path.open("rb") as file:
        write_whole(path, b"after it")
        assert file.read() == b"before"

    assert path.read_bytes() == b"after it"
    assert list(tmp_path.iterdir()) == [path]


def test_of_several_writers_one_is_kept_whole(tmp_path: Path) -> None:
    path, sizes = tmp_path / "a.nc", range(100_000, 900_000, 100_000)
    children = []
    for size in sizes:
        child = os.fork()
        if not child:
            write_whole(path, str(size)[:1].encode() * size)
            os._exit(0)
        children.append(child)

    assert [os.waitpid(child, 0)[1] for child in children] == [0] * len(sizes)
    found = path.read_bytes()
    assert len(found) in sizes
    assert len(set(found)) == 1
    assert list(tmp_path.iterdir()) == [path]


def test_links_and_modes_stay(tmp_path: Path) -> None:
    path, link = tmp_path / "a.csv", tmp_path / "link.csv"
    path.write_bytes(b"before")
    path.chmod(0o640)
    link.symlink_to(path)

    write_whole(link, b"after")

    assert link.is_symlink()
    assert path.read_bytes() == b"after"
    assert path.stat().st_mode & 0o777 == 0o640


def test_what_is_no_plain_file_is_written_to(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)

    with ThreadPoolExecutor(1) as reader:
        found = reader.submit(pipe.read_bytes)
        write_whole(pipe, b"content")

        assert found.result(timeout=10.0) == b"content"


def test_what_cannot_be_written_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        write_whole(tmp_path / "no" / "a.nc", b"content")

    (tmp_path / "folder").mkdir()
    with pytest.raises(IsADirectoryError):
        write_whole(tmp_path / "folder", b"content")

    assert [each.name for each in tmp_path.iterdir()] == ["folder"]


def test_the_file_of_a_march_under_way_is_left_to_it(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    march = RecordFile(path, Layout(b"header", {}, {}, 8, 8), goes_on=False)
    before = path.read_bytes()

    with pytest.raises(OSError, match="another command is writing it"):
        write_whole(path, b"a curve")
    left = path.read_bytes()
    march.close()
    write_whole(path, b"a curve")

    assert left == before
    assert path.read_bytes() == b"a curve"
    assert list(tmp_path.iterdir()) == [path]
