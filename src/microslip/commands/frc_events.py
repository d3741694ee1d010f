"""What a frequency response says of what happens along it, and of its stability."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from microslip.commands.columns import about, decimal, hertz

if TYPE_CHECKING:
    from microslip_mechanics.results.response_curve import ResponseCurve

SECTOR = (
    "stability is not known: motions of one sector cannot break the symmetry of the "
    "disk; --set solve=disk tells it"
)
"""of the curve of one sector"""


def events(
    curve: ResponseCurve, *, sector: bool = False, doubt: float = math.inf
) -> str:
    """Return what was located on the curve, where it is missing and unstable.

    ``sector`` says that it is that of one sector, which stands for a disk; ``doubt`` is
    the error of the largest multiplier, if it is known.
    """
    from microslip.studies.gaps import lines as gap_lines

    lines, frequencies = [], curve.frequency / math.tau
    for place, name in enumerate(curve.event):
        if name:
            where = hertz(frequencies[place], frequencies, 6)
            largest = 1e3 * curve.amplitude[place].max()
            size = decimal(largest, largest, 6, 12)
            aside = about(curve.parameter_error[place] / math.tau)
            lines.append(
                f"{name:<16} {where:>12} Hz{aside:<10} {size} mm"
                f"{about(100.0 * curve.error[place], ' %')}"
            )
    lines += gap_lines(curve)
    lines += _beginnings(curve)
    if not curve.peak.any():
        lines.append("nothing moves at any frequency: the scene has no drive")
    lines.append(SECTOR if sector else _stability(curve, doubt))
    return "\n".join(lines)


def _beginnings(curve: ResponseCurve) -> list[str]:
    """Return why pieces begin that do not go on where the one before ended."""
    first, lines = curve.frequency[0], []
    places = [place for place, name in enumerate(curve.event) if name == "restart"]
    reached = curve.frequency[places[0] - 1] if places else first
    known = {first, reached}
    for place in places:
        here = curve.frequency[place]
        begins = f"what begins at {here / math.tau:.6f} Hz"
        if reached == first and here not in known:
            lines.append(
                f"{begins} is a curve of its own: the one before came back to "
                f"{first / math.tau:.6f} Hz"
            )
            known.add(here)
        elif here in known:
            lines.append(
                f"{begins} comes in from beyond the range: a response there besides "
                "the one before"
            )
    return lines


def _stability(curve: ResponseCurve, doubt: float) -> str:
    """Return where the curve is unstable, as far as that is known."""
    unstable = curve.unstable > 0
    if unstable.any():
        seen = curve.frequency / math.tau
        low, high = seen[unstable].min(), seen[unstable].max()
        return (
            f"unstable at {unstable.sum()} of {unstable.size} points, between "
            f"{hertz(low, seen)} and {hertz(high, seen)} Hz; largest Floquet "
            f"multiplier {_multiplier(float(curve.multiplier.max()))}{about(doubt)}"
            f"{_doubted(curve)}"
        )
    stable = curve.unstable == 0
    if stable.all():
        return "every point is stable"
    if stable.any():
        return (
            f"{stable.sum()} of {stable.size} points are stable, of the others the "
            "stability is not known"
        )
    return (
        "stability is not known: there are no Floquet multipliers of rigid friction, "
        "or of contacts that remember beside regularised friction or a body that "
        "nothing holds; microslip verify finds them by shooting"
    )


def _doubted(curve: ResponseCurve) -> str:
    """Return of how many points the stability is not known, if there are some."""
    unknown = int((curve.unstable < 0).sum())
    return f"; not known of {unknown}" if unknown else ""


def _multiplier(value: float) -> str:
    """Return one outside the unit circle with so many digits that it is not 1."""
    from microslip_mechanics.results.response import MARGIN

    digits = 1 - math.floor(math.log10(max(value - 1.0, MARGIN)))
    return f"{value:.{max(4, digits)}f}"


def barren(curve: ResponseCurve) -> list[float]:
    """Return the branch points at which no branch begins or ends [Hz]."""
    # a branch begins and ends with a copy of the point at which it does
    met, sought, found = Counter(curve.frequency), True, []
    for frequency, mark in zip(curve.frequency, curve.event, strict=True):
        if mark in ("branch", "detached"):  # what branches off branches is not sought
            sought = mark == "detached"
        if sought and mark == "branch point" and met[frequency] == 1:
            found.append(float(frequency) / math.tau)
    return found
