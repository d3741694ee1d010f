"""All reference problems."""

from __future__ import annotations

from collections.abc import Iterator

from references import bilinear, duffing, friction
from references.finding import Finding

PROBLEMS = (duffing, bilinear, friction)


def findings() -> Iterator[Finding]:
    """Yield what is known of all of them."""
    for problem in PROBLEMS:
        yield from problem.findings()
