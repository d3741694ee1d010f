"""The pages on systems, laws and files: examples run, and nothing is missing."""

import importlib
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import microslip
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.laws.catalogue import LAWS
from microslip_mechanics.laws.page import laws_page

DOCS = Path(__file__).parents[2] / "docs"
SYSTEMS = (DOCS / "systems.md").read_text(encoding="utf-8")


def blocks(kind: str) -> list[str]:
    return re.findall(rf"```{kind}\n(.*?)```", SYSTEMS, re.DOTALL)


def test_examples_in_python_run(capsys: pytest.CaptureFixture[str]) -> None:
    known: dict[str, Any] = {}

    for code in blocks("python"):
        exec(code, known)

    printed = capsys.readouterr().out
    assert printed.count("complete") == 4
    (message,) = [line for line in SYSTEMS.splitlines() if "element slider: " in line]
    assert message in printed


def test_example_in_toml_is_that_in_python(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(blocks("toml")[0], encoding="utf-8")
    known: dict[str, Any] = {}
    code = blocks("python")[0]
    exec(code[: code.index("curve =")], known)

    scene, own = problem_of(load_scene(str(path))), known["problem"]

    for name in ("mass", "damping", "stiffness"):
        np.testing.assert_array_equal(
            getattr(scene.structure, name), getattr(own.structure, name)
        )
    np.testing.assert_array_equal(scene.drive, own.drive)
    for mine, other in zip(scene.interface.points, own.interface.points, strict=True):
        np.testing.assert_array_equal(mine, other)


@pytest.mark.parametrize(
    "package", ["src/microslip", "src/microslip_mechanics", "hbm", "timedomain"]
)
def test_page_of_the_code_names_what_is_there(package: str) -> None:
    root = DOCS.parent / package
    page = (DOCS / "code.md").read_text(encoding="utf-8")
    part = page.split(f"## `{package}`")[1].split("\n## ")[0]
    named = set(re.findall(r"`(?:\w+/)?(\w+(?:\.py)?)`", part))
    files = {path.name for path in root.rglob("*.py")}
    parts = {path.name for path in root.iterdir()} - {"__init__.py", "py.typed"}

    assert parts - {"__pycache__"} <= named
    assert {name for name in named if name.endswith(".py")} <= files


def test_page_of_laws_is_that_of_the_catalogue() -> None:
    assert (DOCS / "laws.md").read_text(encoding="utf-8") == laws_page()


def test_laws_are_found_by_their_classes_names() -> None:
    for law in LAWS.values():
        assert getattr(microslip, law.__name__) is law
    with pytest.raises(AttributeError, match="nothing"):
        microslip.nothing  # noqa: B018


def test_importing_the_package_loads_no_numbers() -> None:
    code = "import microslip, sys; print(*sys.modules)"

    ended = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )

    assert not {"numpy", "numba", "scipy", "hbm"} & set(ended.stdout.split())


FILES = (DOCS / "files.md").read_text(encoding="utf-8")
COMMANDS = Path(microslip.__file__).parent / "commands"
TABLES = {
    path.stem: path
    for path in sorted(COMMANDS.glob("*.py"))
    if "save_table(" in path.read_text(encoding="utf-8")
}
"""commands that write a table"""


def test_every_table_has_the_columns_that_its_command_names() -> None:
    for path in TABLES.values():
        (call,) = re.findall(r"save_table\(.*", path.read_text(encoding="utf-8"))
        assert "COLUMNS" in call
    assert len(TABLES) == 9


@pytest.mark.parametrize("command", TABLES)
def test_every_column_of_a_table_is_documented_in_its_order(command: str) -> None:
    module = "precision_tables" if command == "precision" else command
    columns = importlib.import_module(f"microslip.commands.{module}").COLUMNS
    section = FILES.split(f"### `microslip {command}`\n")[1].split("\n##")[0]
    heads = re.findall(r"^\| (`.*?) \|", section, re.MULTILINE)

    documented = [name for head in heads for name in re.findall("`(.*?)`", head)]

    assert documented == list(columns)


@pytest.mark.parametrize(
    ("command", "kinds"),
    [
        ("stress", ["stress.finding.Finding"]),
        ("grid", ["grid.Case", "grid.Attempt"]),
    ],
)
def test_rows_of_records_have_a_column_for_each_field(
    command: str, kinds: list[str]
) -> None:
    columns = importlib.import_module(f"microslip.commands.{command}").COLUMNS
    for kind in kinds:
        file, _, name = kind.rpartition(".")
        record = getattr(importlib.import_module(f"microslip.studies.{file}"), name)
        own = [field.name for field in fields(record) if field.name != "case"]
        first = columns.index(own[0])
        assert list(columns[first : first + len(own)]) == own


THEORY = (DOCS / "theory.md").read_text(encoding="utf-8")
ROOT = DOCS.parent
CITING = [
    path
    for folder in ("src", "hbm", "timedomain", "tests")
    for path in sorted((ROOT / folder).rglob("*.py"))
]


def test_parts_and_equations_that_are_cited_are_there() -> None:
    parts = set(re.findall(r"^##+ (\d(?:\.\d)?) ", THEORY, re.MULTILINE))
    divided = {part.split(".")[0] for part in parts if "." in part}
    equations = set(re.findall(r"\\tag\{(\w+)\}", THEORY))

    for path in CITING:
        text = path.read_text(encoding="utf-8")
        for part in re.findall(r"§(\d(?:\.\d)?)(?!\d)", text):
            assert part in parts - divided, f"{path}: §{part}"
        for cited in re.findall(r"\beqs?\. ([\d\w]+(?:(?:–|, )\d+\w?)*)", text):
            for equation in re.split(r"–|, ", cited):
                assert equation in equations, f"{path}: eq. {equation}"


def test_files_that_theory_names_are_there() -> None:
    named = re.findall(
        r"`((?:tests|hbm|timedomain|microslip_mechanics)/[\w/.]*)", THEORY
    )

    assert len(named) > 20
    for name in named:
        assert (ROOT / name).exists() or (ROOT / "src" / name).exists(), name
