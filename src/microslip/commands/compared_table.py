"""What is printed of several curves that are drawn together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from microslip.commands.columns import NOTHING, decimal, hertz

if TYPE_CHECKING:
    from microslip_mechanics.results.response_curve import ResponseCurve


def compared_table(curves: Sequence[ResponseCurve], labels: Sequence[str]) -> str:
    """Return a line for each curve: how large its largest amplitude is, and where.

    With its estimated error, the energy that the contacts take out per period there, if
    they do, and how many points of the curve are unstable.
    """
    from microslip.figures.amplitude import highest

    tops = [int(highest(each).argmax()) for each in curves]
    ends = list(zip(curves, tops, strict=True))
    sizes = [highest(curve)[top] for curve, top in ends]
    energies = [curve.contact_energy[top] for curve, top in ends]
    columns = {
        "largest [mm]": [decimal(each, max(sizes), 5) for each in sizes],
        "at" if curves[0].along else "at [Hz]": _places(ends),
        "error [%]": [_percent(curve.error[top]) for curve, top in ends],
        "[mJ/period]": [
            decimal(1e3 * each, 1e3 * max(energies), 6) for each in energies
        ],
        "unstable": [_unstable(curve) for curve in curves],
    }
    if 1e3 * max(energies) <= NOTHING:
        del columns["[mJ/period]"]
    return _table({"curve": list(labels)} | columns)


def _table(columns: dict[str, list[str]]) -> str:
    """Return the lines of columns below their heads, the first one left aligned."""
    texts = [[head, *column] for head, column in columns.items()]
    widths = [max(map(len, each)) for each in texts]
    texts[0] = [f"{each:<{widths[0]}}" for each in texts[0]]
    return "\n".join(
        "  ".join(f"{each:>{width}}" for each, width in zip(row, widths, strict=True))
        for row in zip(*texts, strict=True)
    )


def _places(ends: Sequence[tuple[ResponseCurve, int]]) -> list[str]:
    """Return where points of curves lie: frequencies [Hz], or what is followed."""
    if ends[0][0].along:
        return [f"{curve.parameter[top]:.6g}" for curve, top in ends]
    found = [float(curve.frequency[top]) / math.tau for curve, top in ends]
    return [hertz(each, found) for each in found]


def _percent(error: float) -> str:
    return f"{100.0 * error:.2g}" if math.isfinite(error) else "unknown"


def _unstable(curve: ResponseCurve) -> str:
    """Return how many points of a curve are unstable, if that is known of all."""
    if (curve.unstable < 0).any():
        return "unknown"
    return f"{(curve.unstable > 0).sum()} of {len(curve.unstable)}"
