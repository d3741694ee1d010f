"""The report: one page that needs nothing else, whatever becomes of its sections."""

import argparse
import base64
import errno
import importlib
import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from hbm.curves.residual_range import ResidualRange
from microslip.commands.report_parts import PARTS, Part
from microslip.commands.report_sections import words_of
from microslip.page import DONE, FAILED, LEFT_OUT, Section, page
from microslip.scenes.scene_file import BUILT_IN, load_scene
from scene_texts import BETWEEN_FACES, unswept

Run: TypeAlias = Callable[..., tuple[int, str, str]]
PICTURE = b"\x89PNG\r\n\x1a\n" + bytes(range(64))
OPEN_ENDED = {"meta", "img", "!doctype"}


class Tags(HTMLParser):
    """What a page is made of; every tag must be closed in its turn."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.seen: list[str] = []
        self.sources: list[str] = []
        self._open: list[str] = []
        self.feed(text)
        assert self._open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append(tag)
        self.sources += [v or "" for name, v in attrs if name in ("src", "href")]
        if tag not in OPEN_ENDED:
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag


@pytest.fixture
def only(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Return what leaves some sections alone in a report."""

    def kept(*names: str) -> None:
        parts = tuple(part for part in PARTS if part.command in names)
        monkeypatch.setattr("microslip.commands.report.PARTS", parts)

    return kept


def test_a_page_holds_its_pictures_and_needs_nothing_else(tmp_path: Path) -> None:
    picture = tmp_path / "one.png"
    picture.write_bytes(PICTURE)
    section = Section("one", "One", "About it.", DONE, "good", pictures=[picture])

    made = Tags(page("title", "about", "microslip report", [section]))

    assert "script" not in made.seen
    inside = [each for each in made.sources if not each.startswith("#")]
    (source,) = inside
    kind, content = source.split(",")
    assert kind == "data:image/png;base64"
    assert base64.b64decode(content) == PICTURE


def test_what_a_scene_says_is_text_and_no_html() -> None:
    wild = "<script>alert('1 < 2 & $x')</script>"
    section = Section("one", wild, wild, FAILED, wild, wild, wild)

    text = page(wild, wild, wild, [section])

    assert "<script" not in text
    assert "&lt;script&gt;alert(&#x27;1 &lt; 2 &amp; $x&#x27;)" in text
    Tags(text)


@pytest.mark.usefixtures("no_hang")
def test_the_command_writes_what_its_sections_print_and_draw(
    run: Run, quick_scene: Path, tmp_path: Path, only: Callable[..., None]
) -> None:
    only("frc", "sweep", "tables")

    status, output, error = run("report", str(quick_scene), "--quick", "-o", "folder")

    assert (status, error) == (0, "")
    assert "page in folder/index.html" in output
    text = (tmp_path / "folder" / "index.html").read_text(encoding="utf-8")
    made = Tags(text)
    pictures = [each for each in made.sources if each.startswith("data:image/png")]
    for name, source in zip(("frc", "sweep"), pictures, strict=True):
        drawn = (tmp_path / "folder" / f"{name}.png").read_bytes()
        assert base64.b64decode(source.split(",")[1]) == drawn
    (place,) = {text.find(each) for each in ("http://", "https://")}
    assert place == -1, text[place - 80 : place + 80]
    assert "[friction_element]" in text
    assert "estimated error of amplitude: at most" in text
    assert "energy until 0.01 s [J]" in text
    assert "Left out of a quick report" in text
    assert re.search(r"numpy +\d", text)
    for command in ("report", "frc"):
        assert f"<code>microslip {command} {quick_scene}" in text


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_the_summary_tells_the_error_of_a_sweeps_friction(
    run: Run, quick_scene: Path, only: Callable[..., None]
) -> None:
    only("sweep")

    status, output, _ = run("report", str(quick_scene), "--quick", "-o", "page")

    assert status == 0
    assert re.search(r"sweep +done +friction, error \S+ \(\S+ of it\); closing", output)


def test_a_report_promises_sweeps_of_its_verification_unless_it_is_quick() -> None:
    (part,) = [each for each in PARTS if each.command == "verify"]

    assert part.quick is not None
    assert part.quick[-1] == "--slower"  # no sweep
    assert "--slower" in part.more
    assert "unless the report is quick, sweeps" in part.about


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_the_summary_tells_an_amplitude_that_exceeds_the_curves(
    run: Run,
    tmp_path: Path,
    only: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    only("frc")
    # the search for it takes longest, and is not what the report adds
    monkeypatch.setattr(ResidualRange, "at", lambda *_: np.array([[-0.1], [0.5]]))
    scene = tmp_path / "faces.toml"
    scene.write_text(BETWEEN_FACES, encoding="utf-8")

    status, output, _ = run("report", str(scene), "--quick", "-o", "page")

    assert status == 0
    said = r"frc +done +largest amplitude that was found: .+; estimated error of ampl"
    assert re.search(said, output)


@pytest.mark.usefixtures("no_hang")
def test_a_section_that_fails_says_why_and_the_others_are_made(
    run: Run, quick_scene: Path, tmp_path: Path, only: Callable[..., None]
) -> None:
    only("frc", "verify", "sweep")
    narrow = "--set=curve.lowest=130"

    status, _, error = run("report", str(quick_scene), "-o", "page", narrow)

    assert (status, error) == (1, "")
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert "does not cover [sweep]" in text
    assert "energy until 0.01 s [J]" in text
    assert [each for each in Tags(text).sources if "png" in each]


@pytest.mark.usefixtures("no_hang")
def test_a_defect_costs_its_section_alone(
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    only: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def broken(*_: object) -> None:
        raise KeyError("lost")

    only("frc", "sweep")
    monkeypatch.setattr("microslip.figures.curve.curve_figure", broken)

    status, output, _ = run("report", str(quick_scene), "-o", "page")

    assert status == 1
    assert re.search(r"frc +failed +KeyError: 'lost'", output)
    assert re.search(r"sweep +done", output)
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert "KeyError: &#x27;lost&#x27;" in text


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_an_interruption_keeps_the_sections_made_so_far(
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    only: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    only("frc", "sweep", "explain")
    monkeypatch.setattr("microslip.studies.sweep.marched", stopped)

    status, output, error = run("report", str(quick_scene), "-o", "page")

    assert status == 130
    assert "interrupted; what was computed is kept" in error
    assert "explain" not in output
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert "estimated error of amplitude" in text
    assert "interrupted" in text
    assert "Versions" in text


def test_sections_that_do_not_apply_say_so_and_nothing_fails(
    run: Run, tmp_path: Path, only: Callable[..., None]
) -> None:
    only("sweep", "verify", "precision", "tables", "stress")

    status, output, _ = run("report", "bladed-disk", "-o", "page")

    assert status == 0
    assert output.count("left out") == 5
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert text.count("one sector of a disk, which cannot be marched") == 2 * 3
    assert text.count("the numbers of two blades, which this scene lacks") == 2 * 2


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_of_a_scene_without_drive_there_is_no_orbit_to_tell_of(
    run: Run, tmp_path: Path, only: Callable[..., None]
) -> None:
    only("frc", "verify", "precision")

    status, output, _ = run("report", "jenkins", "--set=drive.x=0", "-o", "page")

    assert status == 0
    assert re.search(r"frc +done", output)
    assert re.search(r"verify +left out +Nothing drives this scene", output)
    assert re.search(r"precision +left out +Nothing drives this scene", output)
    text = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    assert text.count("Nothing drives this scene") == 2 * 2


@pytest.mark.parametrize(
    ("missing", "expected"),
    [
        (("sweep",), {"sweep"}),
        (("march",), {"sweep"}),
        (("curve",), {"frc", "verify", "precision", "explain"}),
    ],
)
def test_what_needs_a_table_that_a_scene_lacks_is_left_out(
    missing: tuple[str, ...], expected: set[str]
) -> None:
    whole = load_scene("jenkins")
    tables = replace(whole.experiments, **dict.fromkeys(missing))
    scene = replace(whole, experiments=tables)

    told = {part.command: part.excuse(scene) for part in PARTS}

    rig_alone = {"tables", "stress"}
    assert {each for each in told if told[each]} - rig_alone == expected
    names = " and no ".join(f"[{each}]" for each in missing)
    assert all(told[each] == f"This scene has no {names}." for each in expected)


@pytest.mark.usefixtures("no_hang", "no_picture")
def test_a_scene_that_cannot_be_swept_is_verified_without_sweeps(
    run: Run, tmp_path: Path, only: Callable[..., None]
) -> None:
    only("verify")
    scene = unswept(tmp_path)

    status, output, _ = run("report", str(scene), "-o", "page")

    assert status == 0
    assert re.search(r"verify +done +agree", output)


@pytest.mark.parametrize("name", BUILT_IN)
def test_only_what_belongs_to_the_rig_or_to_a_march_is_left_out(name: str) -> None:
    scene = load_scene(name)

    out = {part.command for part in PARTS if part.excuse(scene)}

    expected = set() if name == "two-blades" else {"tables", "stress"}
    if name == "bladed-disk":
        expected |= {"sweep", "verify", "precision"}
    assert out == expected


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.command)
def test_options_of_a_section_are_those_of_its_command(part: Part) -> None:
    for quick in (True, False):
        words = words_of(part, "two-blades", ["model=A"], Path("x"), quick=quick)
        commands = argparse.ArgumentParser().add_subparsers()
        importlib.import_module(f"microslip.commands.{part.command}").add(commands)
        commands.choices[part.command].parse_args(words[1:])


def test_a_folder_that_cannot_be_made_is_told_in_a_line(
    run: Run, quick_scene: Path
) -> None:
    status, output, error = run("report", str(quick_scene), "-o", "no/such/folder")

    assert (status, output) == (2, "")
    assert error.startswith("microslip: the folder no/such/folder cannot be made: ")


def test_a_full_disk_leaves_the_page_that_was_there(
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    only: Callable[..., None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def full(path: Path, content: bytes) -> int:
        with path.open("wb") as file:
            file.write(content[:10])
        raise OSError(errno.ENOSPC, "no space")

    only("tables")
    there = tmp_path / "page" / "index.html"
    there.parent.mkdir()
    there.write_text("whole", encoding="utf-8")
    monkeypatch.setattr(Path, "write_bytes", full)

    status, _, error = run("report", str(quick_scene), "--quick", "-o", "page")

    assert status == 1
    assert error == "microslip: page/index.html cannot be written: no space\n"
    assert there.read_text(encoding="utf-8") == "whole"


def test_left_out_sections_show_no_time() -> None:
    section = Section("one", "One", "", LEFT_OUT, "It does not apply.")

    text = page("t", "a", "c", [section])

    assert '<td class="time"></td>' in text
    assert text.count("It does not apply.") == 2
