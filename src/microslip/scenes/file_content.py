"""What the files held that a scene names, as lines at the end of its text."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

MARK = "# file "
"""what begins such a line"""


def digest(content: bytes) -> str:
    """Return what tells files of different content apart."""
    return hashlib.sha256(content).hexdigest()[:16]


def with_files(text: str, found: Iterable[tuple[str, str]]) -> str:
    """Return a scene's text with the keys that name files, and their digests."""
    return text + "".join(f"\n{MARK}{key} {each}" for key, each in found)


def without_files(text: str) -> str:
    """Return a scene's text alone."""
    lines = text.splitlines()
    return "\n".join(each for each in lines if not each.startswith(MARK))
