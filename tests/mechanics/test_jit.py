"""The `kernel` decorator: disk cache, its invalidation, and life without either."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import microslip_mechanics

PACKAGE = Path(microslip_mechanics.__file__).parent
POWER = """
from microslip_mechanics.contact.hunt_crossley import power
print(power(2.0, 3.0), sum(power.stats.cache_hits.values()))
"""
ENERGY = """
import numpy as np
from microslip_mechanics.contact.normal import contact_energy
from microslip_mechanics.contact.points import ContactPoints
flags = dict(normal=np.int64, clamped=bool, friction=np.int64, constant_load=bool)
types = [flags.get(name, float) for name in ContactPoints._fields]
points = ContactPoints(*(np.ones(1, type) for type in types))
points.normal[0], points.gap[0] = 0, 0.0
print(contact_energy(points, 0, 2.0))
"""
LENDER = """
from microslip_mechanics.jit import kernel


@kernel
def lent(number: float) -> float:
    return 2.0 * number
"""
BORROWER = """
from lending.owned.lender import lent
from microslip_mechanics.jit import kernel


@kernel
def borrowed(number: float) -> float:
    return lent(number)
"""
BORROWED = """
from lending.owing.borrower import borrowed
print(borrowed(3.0), sum(borrowed.stats.cache_hits.values()))
"""
PLAIN = """
import inspect
from microslip_mechanics.contact.hunt_crossley import power
print(inspect.isfunction(power))
"""


def run(code: str, **environment: Path | str) -> list[str]:
    """Run code in a new process, warnings as errors; return the words it prints."""
    kept = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
    kept["PYTHONPATH"] = str(PACKAGE.parent)
    done = subprocess.run(
        [sys.executable, "-P", "-W", "error", "-c", code],
        env=kept | {name: str(value) for name, value in environment.items()},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split()


def files(folder: Path) -> dict[Path, int]:
    """Return all files of a folder with the time when they were written."""
    return {
        path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()
    }


def test_second_process_finds_the_machine_code_of_the_first(tmp_path: Path) -> None:
    first = run(POWER, XDG_CACHE_HOME=tmp_path)
    compiled = files(tmp_path)

    second = run(POWER, XDG_CACHE_HOME=tmp_path)

    assert first == ["8.0", "0"]
    assert second == ["8.0", "1"]
    assert {path.suffix for path in compiled} == {".nbi", ".nbc"}
    assert files(tmp_path) == compiled


def test_edit_of_a_callee_in_another_file_reaches_its_caller(tmp_path: Path) -> None:
    package = tmp_path / "copy" / "microslip_mechanics"
    shutil.copytree(PACKAGE, package)
    places = {"PYTHONPATH": package.parent, "XDG_CACHE_HOME": tmp_path / "cache"}
    callee, formula = package / "contact" / "hunt_crossley.py", "return law.stiffness *"
    text = callee.read_text(encoding="utf-8")

    before = run(ENERGY, **places)
    callee.write_text(text.replace(formula, f"{formula} 5.0 *"), encoding="utf-8")
    after = run(ENERGY, **places)

    assert text.count(formula) == 1
    assert before == ["2.0"]
    assert after == ["10.0"]
    assert len(list((tmp_path / "cache" / "microslip").iterdir())) == 2


def test_edit_of_a_neighbour_in_another_package_reaches_its_caller(
    tmp_path: Path,
) -> None:
    package = tmp_path / "lending"
    for folder in (package, package / "owned", package / "owing"):
        folder.mkdir()
        (folder / "__init__.py").touch()
    lender = package / "owned" / "lender.py"
    lender.write_text(LENDER, encoding="utf-8")
    (package / "owing" / "borrower.py").write_text(BORROWER, encoding="utf-8")
    places: dict[str, Path | str] = {
        "PYTHONPATH": f"{tmp_path}{os.pathsep}{PACKAGE.parent}",
        "XDG_CACHE_HOME": tmp_path / "cache",
    }

    before, again = (run(BORROWED, **places) for _ in range(2))
    lender.write_text(LENDER.replace("2.0", "5.0"), encoding="utf-8")
    after = run(BORROWED, **places)

    assert before == ["6.0", "0"]
    assert again == ["6.0", "1"]
    assert after == ["15.0", "0"]


def test_unchanged_copy_of_the_package_shares_the_name_of_the_cache_folder(
    tmp_path: Path,
) -> None:
    package = tmp_path / "copy" / "microslip_mechanics"
    shutil.copytree(PACKAGE, package)

    run(PLAIN, XDG_CACHE_HOME=tmp_path / "cache")
    run(PLAIN, XDG_CACHE_HOME=tmp_path / "cache", PYTHONPATH=package.parent)

    assert len(list((tmp_path / "cache" / "microslip").iterdir())) == 1


def test_numbas_own_cache_folder_is_neither_used_nor_changed(tmp_path: Path) -> None:
    shared = tmp_path / "shared"
    code = f"{POWER}\nfrom numba.core import config\nprint(config.CACHE_DIR)"

    printed = run(code, XDG_CACHE_HOME=tmp_path / "own", NUMBA_CACHE_DIR=shared)

    assert printed[-1] == str(shared)
    assert files(tmp_path / "own")
    assert not files(shared)


def test_without_jit_a_kernel_is_the_function_itself(tmp_path: Path) -> None:
    off = run(PLAIN, XDG_CACHE_HOME=tmp_path, NUMBA_DISABLE_JIT="1")
    on = run(PLAIN, XDG_CACHE_HOME=tmp_path)

    assert (off, on) == (["True"], ["False"])


def test_without_jit_nothing_is_written_to_disk(tmp_path: Path) -> None:
    code = "from microslip_mechanics.contact.hunt_crossley import power\n"

    printed = run(
        f"{code}print(power(2.0, 3.0))", XDG_CACHE_HOME=tmp_path, NUMBA_DISABLE_JIT="1"
    )

    assert printed == ["8.0"]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("variable", ["XDG_CACHE_HOME", "HOME"])
def test_kernels_run_where_no_cache_folder_can_be_made(
    tmp_path: Path, variable: str
) -> None:
    file = tmp_path / "file"
    file.write_text("a file cannot hold a folder", encoding="utf-8")

    printed = run(POWER, **{variable: file})

    assert printed == ["8.0", "0"]
    assert list(tmp_path.iterdir()) == [file]


def test_kernels_run_where_the_disk_is_full(tmp_path: Path) -> None:
    # No file may be larger than 4 kB: an index is smaller, machine code is larger.
    full = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))\n"

    for _ in range(2):
        assert run(f"{full}{POWER}", XDG_CACHE_HOME=tmp_path) == ["8.0", "0"]
    assert not [path for path in files(tmp_path) if path.suffix == ".nbc"]

    assert run(POWER, XDG_CACHE_HOME=tmp_path) == ["8.0", "0"]
    assert run(POWER, XDG_CACHE_HOME=tmp_path) == ["8.0", "1"]


def test_a_filled_cache_that_can_only_be_read_is_used(tmp_path: Path) -> None:
    reading = "import os\nos.access = lambda path, mode: mode != os.W_OK\n"
    places = {"XDG_CACHE_HOME": tmp_path / "cache", "TMPDIR": tmp_path}
    run(POWER, **places)
    kept = files(tmp_path / "cache")

    assert run(f"{reading}{POWER}", **places) == ["8.0", "1"]
    assert run(f"{reading}{ENERGY}", **places) == run(ENERGY, XDG_CACHE_HOME=tmp_path)
    assert files(tmp_path / "cache") == kept
    assert not list(tmp_path.glob("microslip-*"))  # the copies are gone


def test_kernels_leave_no_code_beside_their_source(tmp_path: Path) -> None:
    # A file stands where the cache wants a folder; numba would take __pycache__ then.
    package = tmp_path / "copy" / "microslip_mechanics"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    places = {"PYTHONPATH": package.parent, "XDG_CACHE_HOME": tmp_path / "cache"}
    run(POWER, **places)
    (folder,) = (tmp_path / "cache" / "microslip").glob("*/contact_*")
    shutil.rmtree(folder)
    folder.touch()

    printed = run(POWER, **places)

    assert printed == ["8.0", "0"]
    assert not list(package.rglob("*.nbi"))


def test_cache_lives_below_home_unless_told_otherwise(tmp_path: Path) -> None:
    run(POWER, HOME=tmp_path)

    folders = list((tmp_path / ".cache" / "microslip").iterdir())

    assert len(folders) == 1
    assert {path.suffix for path in files(folders[0])} == {".nbi", ".nbc"}
