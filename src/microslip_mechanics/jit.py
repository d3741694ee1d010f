"""The `kernel` decorator: numba's options and its disk cache in one place."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numba
from numba.core import config
from numba.core.caching import FunctionCache, NullCache

if TYPE_CHECKING:
    from collections.abc import Callable

Function = TypeVar("Function", bound="Callable[..., Any]")


def kernel(function: Function) -> Function:
    """Compile a hot loop to machine code and keep it on disk.

    Numba's disk cache watches the file of the compiled function alone: a caller
    keeps the old machine code of a callee that was edited in another file. Hence
    the cache folder is named after the content of all files whose kernels a kernel
    may call: those of this package and those beside its own. No fast-math: results
    must not differ between machines more than rounding makes them.

    What Python calls must not return a named tuple: numba makes one by calling Python
    without looking whether that succeeds, so that an interruption there (Ctrl-C, or the
    end of a time) ends the process with a segmentation fault.
    """
    return _compiled(function, counted=True)


def bare_kernel(function: Function) -> Function:
    """Compile like :func:`kernel` what makes no arrays, without counting references.

    Counting takes most of the time of a step that hands many arrays from kernel to
    kernel. A kernel that makes an array does not compile so.
    """
    return _compiled(function, counted=False)


def inner_kernel(function: Function) -> Function:
    """Compile like :func:`bare_kernel`, as a part of each kernel that calls it.

    Numba makes machine code of each kernel, and makes it anew within its callers and
    theirs. What one or two kernels call is made there alone: a third less to compile.
    Large functions do not gain: time grows faster than their size.
    """
    return _compiled(function, counted=False, inline="always")


def closure(function: Function) -> Function:
    """Compile a function with all that it closes over as constants; not kept on disk.

    What a solver written in Python has to hand over at every call is then little.
    """
    if config.__dict__["DISABLE_JIT"]:
        return function
    return cast("Function", numba.njit(error_model="numpy", nogil=True)(function))


def _compiled(function: Function, *, counted: bool, inline: str = "never") -> Function:
    """Return the kernel with its disk cache; ``inline`` is numba's option."""
    options = config.__dict__
    if options["DISABLE_JIT"]:
        return function
    choices: dict[str, Any] = {"error_model": "numpy", "nogil": True, "_nrt": counted}
    choices["inline"] = inline
    choices["no_cfunc_wrapper"] = True  # nobody takes the address of a kernel
    dispatcher = numba.njit(**choices)(function)
    folder = _cache_folder(_package(Path(function.__code__.co_filename)))
    if folder is not None:
        shared, options["CACHE_DIR"] = options["CACHE_DIR"], str(folder)
        try:
            dispatcher._cache = _cache(function, folder)
        finally:
            options["CACHE_DIR"] = shared
    return cast("Function", dispatcher)


class _Cache(FunctionCache):
    """Machine code on disk; what cannot be read or written there is compiled anew."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:  # noqa: ANN401
        with contextlib.suppress(OSError):
            return super().load_overload(sig, target_context)  # type: ignore[no-untyped-call]
        return None

    def save_overload(self, sig: Any, data: Any) -> None:  # noqa: ANN401
        with contextlib.suppress(OSError):
            super().save_overload(sig, data)  # type: ignore[no-untyped-call]


def _cache(function: Function, folder: Path) -> _Cache | NullCache:
    """Return the cache in a folder; none where numba would take another folder."""
    try:
        cache = _Cache(function)  # type: ignore[no-untyped-call]
    except RuntimeError:  # there is no folder at all that can be written to
        return NullCache()
    inside = Path(cache.cache_path).is_relative_to(folder)
    return cache if inside else NullCache()


def _package(source: Path) -> Path:
    """Return the folder of the outermost package that a file belongs to."""
    folder = source.parent
    while (folder.parent / "__init__.py").exists():
        folder = folder.parent
    return folder


@functools.cache
def _cache_folder(package: Path) -> Path | None:
    """Return a writable folder for machine code, or None where there is none.

    Of one that can only be read, as in a container, it is a copy for this process:
    numba does not look where it cannot write.
    """
    try:
        home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        folder = Path(home) / "microslip" / _content(package)
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return folder if os.access(folder, os.W_OK) else _copied(folder)


def _copied(folder: Path) -> Path | None:
    """Return a copy of a folder, for as long as the process; None without room."""
    import shutil
    import tempfile
    import weakref

    try:
        copy = Path(tempfile.mkdtemp(prefix="microslip-"))
        weakref.finalize(_copied, shutil.rmtree, copy, ignore_errors=True)
        shutil.copytree(folder, copy, dirs_exist_ok=True)
    except (OSError, shutil.Error):
        return None
    return copy


def _content(package: Path) -> str:
    """Return a name for the content of the ground floor and one package."""
    ground = Path(__file__).parent
    sources = sorted(ground.rglob("*.py"))
    if not package.is_relative_to(ground):
        sources += sorted(package.rglob("*.py"))
    content = hashlib.sha256()
    for source in sources:
        content.update(source.read_bytes())
    return content.hexdigest()[:16]
