"""The march of a decay, into a file or beside it."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from microslip.scenes.experiments import March
    from microslip.scenes.scene import Scene
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.checkpoint import Checkpoint
    from microslip_mechanics.results.time_history import TimeHistory


def recorded(
    options: argparse.Namespace,
    scene: Scene,
    problem: Problem,
    begin: tuple[Checkpoint, float],
    data: Path,
) -> TimeHistory:
    """March the decay into a file; return it, and in it how it ended."""
    from microslip.files.recording import Recording

    with Recording(data, scene.text, options.command) as recording:
        history = marched(
            options, scene.march, problem, begin, ("decay", recording.keep)
        )
        recording.end(history.ending)
    return history


def marched(
    options: argparse.Namespace,
    march: March,
    problem: Problem,
    begin: tuple[Checkpoint, float],
    shown: tuple[str, Callable[[TimeHistory], None]],
) -> TimeHistory:
    """Return a decay, or what there is of it, and in it how it ended.

    ``shown`` is what its bar says, and what takes its blocks as they come.
    """
    from microslip.commands.sweep import watched
    from microslip.studies.decay import released
    from microslip.studies.sweep import kept
    from microslip_mechanics.results.joined import joined

    (state, frequency), (name, also) = begin, shown
    blocks: list[TimeHistory] = []

    def keep(block: TimeHistory) -> None:
        also(block)
        blocks.append(block)

    marching = released(
        problem, state, march, frequency=frequency, periods=options.periods
    )
    length = math.tau / frequency * options.periods
    return joined(blocks, kept(watched(length, name)(marching), keep))
