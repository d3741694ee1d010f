"""What a picture shows of nonlinear modes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median
from typing import TYPE_CHECKING

from microslip.figures.modes import ModeLine

if TYPE_CHECKING:
    from microslip.studies.modes import FollowedMode


def mode_lines(modes: Sequence[FollowedMode]) -> list[ModeLine]:
    """Return a line for each mode that has a point."""
    return [_line(mode) for mode in modes if mode.points]


def _line(mode: FollowedMode) -> ModeLine:
    """Return the line of a mode; some of its points may be hardly known."""
    hertz = [point.frequency / math.tau for point in mode.points]
    errors = [point.frequency_error for point in mode.points]
    return ModeLine(
        f"mode at {mode.linear.frequency / math.tau:.2f} Hz",
        [point.amplitude for point in mode.points],
        hertz,
        [point.damping for point in mode.points],
        median(errors) * max(hertz),
        mode.coarser,
        "" if mode.coarser is None else counted(mode.points[mode.coarser].harmonics),
    )


def counted(harmonics: int) -> str:
    """Return a number of harmonics in words."""
    return f"{harmonics} harmonic{'s' if harmonics > 1 else ''}"
