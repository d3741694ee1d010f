"""The files of matrices that a scene names."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from microslip.matrices.source import MatrixSource
from microslip.scenes.file_content import digest
from microslip.scenes.systems.tables import Matrices


def matrix_digests(given: Matrices) -> Iterator[tuple[str, str]]:
    """Yield the key of each file, and what tells its content apart.

    What cannot be read is told where the matrices are.
    """
    for key in ("mass", "stiffness", "damping"):
        named = getattr(given, key)
        if isinstance(named, str):
            path = MatrixSource.of(named, given.folder).path
            with contextlib.suppress(OSError, ValueError):
                yield key, digest(path.read_bytes())
