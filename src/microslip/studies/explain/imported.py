"""What a new process loads: modules, kernels, and the time that takes."""

from __future__ import annotations

import functools
import json
import subprocess
import sys
from dataclasses import dataclass

FRC = ("microslip.studies.curve", "microslip.figures.curve", "microslip.files.store")
"""what ``microslip frc`` loads"""
PROBE = """
import importlib, json, pkgutil, sys, time
began = time.process_time()
names = sys.argv[1:]
packages = "microslip", "hbm", "timedomain", "microslip_mechanics"
for package in () if names else packages:
    folder = importlib.import_module(package).__path__
    found = pkgutil.walk_packages(folder, package + ".")
    names += [each.name for each in found if not each.name.endswith("__main__")]
for name in names:
    importlib.import_module(name)
seconds = time.process_time() - began
kernels = {
    id(value)
    for module in list(sys.modules.values())
    if module.__name__.startswith(packages)
    for value in vars(module).values()
    if hasattr(value, "py_func")
}
print(json.dumps([len(sys.modules), len(kernels), seconds]))
"""


@dataclass(frozen=True, slots=True)
class Imported:
    """What a process has loaded."""

    modules: int
    kernels: int
    """compiled functions, if machine code is made at all"""
    seconds: float
    """of processor time"""


@functools.cache
def imported(modules: tuple[str, ...]) -> Imported:
    """Return what a new process loads with some modules; with none, all of microslip's.

    Raises
    ------
    CalledProcessError
        If a module cannot be loaded.
    """
    ended = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROBE, *modules],
        capture_output=True,
        text=True,
        check=True,
    )
    return Imported(*json.loads(ended.stdout.splitlines()[-1]))
