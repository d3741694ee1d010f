"""Interruptions where numba makes what a kernel returns end no process."""

import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
from collections.abc import Iterator
from types import CodeType, FunctionType, ModuleType

import pytest

import hbm
import microslip
import microslip_mechanics
import timedomain
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.memory import pressed

INTERRUPTED = """
import signal, time
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.loads.excitation import Dwell
from timedomain.record.start import Start, first_state
import numpy as np

problem = problem_of(load_scene("two-blades", ["model=A"]))
still = np.zeros(problem.structure.dense.mass.shape[0])
arguments = problem, Dwell(800.0, 1.0), Start(still, still)
first_state(*arguments)

def stop(*_):
    raise KeyboardInterrupt

signal.signal(signal.SIGPROF, stop)
seen, end = 0, time.process_time() + 2.0
while time.process_time() < end:
    try:
        signal.setitimer(signal.ITIMER_PROF, 1e-3)
        while True:
            first_state(*arguments)
    except (KeyboardInterrupt, SystemError):
        seen += 1
signal.setitimer(signal.ITIMER_PROF, 0.0)
print(seen)
"""


def modules() -> Iterator[ModuleType]:
    """Yield all modules that may hold kernels or call them."""
    for package in (microslip, hbm, timedomain, microslip_mechanics):
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                yield importlib.import_module(found.name)


def is_named_tuple(name: str, module: ModuleType) -> bool:
    """Return whether a name of a module is that of a class of named tuples."""
    return hasattr(vars(module).get(name), "_fields")


def returns_named_tuple(kernel: object) -> bool:
    """Return whether the annotation of what a kernel returns names such a class."""
    function = getattr(kernel, "py_func", None)
    if not inspect.isfunction(function):
        return False
    returned = str(function.__annotations__.get("return"))
    module = sys.modules[function.__module__]
    return any(is_named_tuple(name, module) for name in re.findall(r"\w+", returned))


def called(code: CodeType) -> Iterator[str]:
    """Yield the global names in a function and in what it defines."""
    yield from code.co_names
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from called(inner)


def python_functions(module: ModuleType) -> Iterator[FunctionType]:
    """Yield the functions and methods of a module that are no kernels."""
    held = list(vars(module).values())
    held += [
        each
        for owner in held
        if inspect.isclass(owner)
        for each in vars(owner).values()
    ]
    for each in held:
        function = each.fget if isinstance(each, property) else each
        function = getattr(function, "__func__", function)
        if inspect.isfunction(function) and function.__module__ == module.__name__:
            yield function


def test_no_kernel_that_python_calls_returns_a_named_tuple() -> None:
    assert returns_named_tuple(pressed)
    assert not returns_named_tuple(contact_force)
    calling = {
        f"{module.__name__}.{function.__qualname__} calls {name}"
        for module in modules()
        for function in python_functions(module)
        for name in called(function.__code__)
        if returns_named_tuple(vars(module).get(name))
    }

    assert not calling


@pytest.mark.skipif(sys.platform == "win32", reason="no timer of the processor")
def test_an_interruption_of_the_first_state_ends_no_process() -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, check=False
    )

    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 100
