"""Blocks of one march as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any, TypeVar

import numpy as np

from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory

Block = TypeVar("Block", TimeHistory, Envelope)


def joined(blocks: Sequence[Block], ending: str) -> Block:
    """Return blocks of one march as one."""
    first = blocks[0]
    whole: dict[str, Any] = {
        each.name: np.concatenate([getattr(block, each.name) for block in blocks])
        for each in fields(first)
        if isinstance(getattr(first, each.name), np.ndarray)
    }
    return replace(
        first,
        **whole,
        iterations=sum(block.iterations for block in blocks),
        divided=sum(block.divided for block in blocks),
        ending=ending,
        checkpoint=blocks[-1].checkpoint,
    )
