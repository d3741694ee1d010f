"""Where results are, which is told also if what follows ends early."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path

from microslip.interruption import held_back


@contextlib.contextmanager
def written(
    told: str, picture: Path, save: Callable[[], object] = lambda: None
) -> Iterator[None]:
    """Save results whole, then print and draw them; tell last where they are.

    An interruption waits until they are saved. Where this ends early, as by one, the
    file is named all the same, and has no picture of older results beside it.
    """
    with contextlib.ExitStack() as last:
        with held_back():
            save()
            last.enter_context(named(told))
            discard(picture)
        yield
    print(f"{told}, picture in {picture}")


@contextlib.contextmanager
def named(told: str) -> Iterator[None]:
    """Tell where results are if what follows ends early."""
    try:
        yield
    except BaseException:
        print(told)
        raise


def discard(*older: Path) -> None:
    """Remove files that tell of older results; a link is left to its owner."""
    for each in older:
        if each.is_file() and not each.is_symlink():
            with contextlib.suppress(OSError):  # told where the new one is written
                each.unlink()
