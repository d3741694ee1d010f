"""What a mode says of itself on the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import decimal, even, hertz, span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from hbm.modes.modes import NonlinearMode
    from microslip.studies.modes import FollowedMode

HEADER = (
    "amplitude  frequency  damping   estimated error of\n"
    "     [mm]       [Hz]      [%]  frequency    damping"
)


ROUNDING = 1e-6
"""change of the damping ratio, relative, up to which no point is most damped"""


def mode_table(mode: FollowedMode, state: str) -> list[str]:
    """Return the table of one mode; ``state`` is that of its small motions."""
    from statistics import median

    from microslip.mode_lines import counted

    natural, percent = mode.linear.frequency / math.tau, 100.0 * mode.linear.damping
    rows = [
        f"mode at {hertz(natural, [natural])} Hz, damping ratio "
        f"{decimal(percent, percent, 4, 8).strip()} %, {state}",
    ]
    if not mode.points:
        return [*rows, f"it has no first point: {mode.ending}"]
    rows += [HEADER, *_point_rows(mode)]
    errors = [point.damping_error for point in mode.points]
    harmonics = span((point.harmonics for point in mode.points), "harmonic")
    samples = span((point.samples for point in mode.points), "sample")
    rows.append(
        f"{len(mode.points)} points with {harmonics} and {samples}; estimated "
        "error of the damping ratio: "
        f"{100.0 * median(errors):.2g} % in the median, above 5 % at "
        f"{sum(error > 0.05 for error in errors)} points"
    )
    if mode.apart:
        rows.append(
            f"where it begins, at {1e3 * mode.points[0].amplitude:.4g} mm, its "
            f"motion is another one than {state}, and may be that of another mode of "
            "nearly the same frequency, at amplitudes down to 1e-4 of that too: "
            "begin with smaller --amplitudes still, which helps unless the frequencies "
            "are equal"
        )
    if mode.coarser is not None:
        first = mode.points[mode.coarser]
        rows.append(
            f"from {1e3 * first.amplitude:.5g} mm on with {counted(first.harmonics)}: "
            "it does not go on with those that its error asks for, or not with the "
            "work granted (--effort)"
        )
    if broken(mode):
        rows.append(
            f"it ends at {1e3 * mode.points[-1].amplitude:.5g} mm: {mode.ending}"
        )
    return rows


def _point_rows(mode: FollowedMode) -> list[str]:
    """Return points as lines; the most damped is named if it is sure to be that."""
    from microslip.studies.modes import shown_points

    most_damped: NonlinearMode | None = mode.most_damped
    damping = [point.damping for point in mode.points]
    if broken(mode) and most_damped is mode.points[-1]:
        most_damped = None  # it may be damped more where it does not reach
    if max(damping) - min(damping) <= ROUNDING * max(damping):
        most_damped = None
    seen = [point.frequency / math.tau for point in mode.points]
    shown = shown_points(mode)
    amplitudes = even([1e3 * point.amplitude for point in shown], 5, 9)
    percents = even([100.0 * point.damping for point in shown], 4, 8)
    return [
        f"{amplitude} {hertz(point.frequency / math.tau, seen):>10} {percent} "
        f"{point.frequency_error:10.1e} {point.damping_error:10.1e}"
        f"{'  most damped' if point is most_damped else ''}"
        for amplitude, percent, point in zip(amplitudes, percents, shown, strict=True)
    ]


def ending_of(modes: Sequence[FollowedMode]) -> str:
    """Return how modes ended together: "complete", or which of them stop short."""
    short = [mode for mode in modes if broken(mode)]
    if not short:
        return "complete"
    if len(modes) == 1:
        return short[0].ending
    found = [mode.linear.frequency / math.tau for mode in short]
    places = ", ".join(hertz(each, found) for each in found)
    return (
        f"{len(short)} of {len(modes)} modes cannot be followed to the end, at "
        f"{places} Hz: their tables say why"
    )


def broken(mode: FollowedMode) -> bool:
    """Return whether something else than the user ended a mode early."""
    return mode.ending not in ("complete", "interrupted")
