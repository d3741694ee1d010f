"""Where results are, which is told also if what follows ends early."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path


@contextlib.contextmanager
def written(told: str, picture: Path) -> Iterator[None]:
    """Print results that are in a file and draw them; tell last where they are.

    Where this ends early, as by an interruption, the file is named all the same.
    """
    with named(told):
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
