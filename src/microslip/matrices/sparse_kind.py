"""Sparse matrices and sparse arrays, of which scipy's readers return either."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator


@contextlib.contextmanager
def either_kind() -> Iterator[None]:
    """Let scipy read a file without telling that it will return the other kind.

    It does from version 1.18 on; what is read becomes a sparse array in any case.
    """
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "(?s).*spmatrix", DeprecationWarning)
        yield
