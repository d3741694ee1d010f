"""The pages on systems and laws: their examples run, and nothing is missing."""

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import microslip
from microslip.rigs import problem_of
from microslip.scene_file import load_scene
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
    assert printed.count("complete") == 2
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
