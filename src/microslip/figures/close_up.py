"""A close-up of a curve where what is located on it is crowded."""

from __future__ import annotations

import itertools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from microslip.figures.abscissa import abscissa, abscissa_name
from microslip.figures.amplitude import (
    MARKERS,
    highest,
    mark_events,
    mark_unstable,
    steady,
    stretches,
)
from microslip.figures.names import absolute
from microslip.figures.style import COLOURS, WIDTH, framed
from microslip_mechanics.results.response_curve import ResponseCurve

NEAR = 0.07
"""of both axes, by which what is located is apart at least, to be told apart well"""
FLAT = 1e-3
"""of an amplitude, that a close-up of it shows above and below at least"""
BESIDE = 0.5
"""of what is located, that a close-up shows to either side of it"""
CLOSE = 0.6
"""of the whole range, that a close-up is narrower than"""


def worth(curve: ResponseCurve) -> bool:
    """Return whether a close-up shows more than the picture of the whole curve.

    What lies at one place, as a branch does with its point, none would tell apart.
    """
    if not crowd(curve):
        return False
    low, high = _window(curve)
    at = abscissa(curve)
    return 0.0 < high - low < CLOSE * float(np.ptp(at[np.isfinite(at)]))


def close_up(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the largest amplitude, and each point, where a crowd of events is."""
    low, high = _window(curve)
    at, size = abscissa(curve), highest(curve)
    stable, _ = stretches(curve)
    line = np.where(stable, size, np.nan)
    axes.plot(at, line, color=COLOURS[0], linewidth=WIDTH * 1.5, label=steady(curve))
    axes.plot(at, size, ".", color=COLOURS[0], markersize=4.0, label="point")
    mark_unstable(axes, curve)
    mark_events(axes, curve)
    inside = (at >= low) & (at <= high)
    stretch = np.cumsum(~inside)  # the same for all points from coming in to leaving
    shown = size[inside & np.isin(stretch, stretch[crowd(curve)])]
    room = max(0.1 * float(np.ptp(shown)), FLAT * float(shown.max()))
    of_several = ", largest of probes" if len(absolute(curve.probes)) > 1 else ""
    framed(
        axes,
        x=abscissa_name(curve),
        y="amplitude [mm]",
        title=f"Close-up of the first harmonic{of_several}",
    )
    axes.set_xlim(low, high)
    axes.set_ylim(shown.min() - room, shown.max() + room)
    axes.ticklabel_format(useOffset=False)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.legend(frameon=False)


def crowd(curve: ResponseCurve) -> list[int]:
    """Return the points that are located too closely together to be told apart."""
    places = [i for i, event in enumerate(curve.event) if event in MARKERS]
    if not places:
        return []
    at, size = abscissa(curve), highest(curve)
    width, height = NEAR * np.ptp(at[np.isfinite(at)]), NEAR * np.nanmax(size)
    near = {
        place
        for one, other in itertools.pairwise(sorted(places, key=lambda i: at[i]))
        if abs(at[one] - at[other]) < width and abs(size[one] - size[other]) < height
        for place in (one, other)
    }
    return sorted(near)


def _window(curve: ResponseCurve) -> tuple[float, float]:
    """Return the ends of a close-up: all that is located beside the crowd is in it.

    It does not go beyond those of the curve.
    """
    at = abscissa(curve)
    located = [i for i, event in enumerate(curve.event) if event in MARKERS]
    width = NEAR * np.ptp(at[np.isfinite(at)])
    inside = at[crowd(curve)]
    while True:
        low, high = inside.min() - width, inside.max() + width
        wider = at[[i for i in located if low <= at[i] <= high]]
        if len(wider) == len(inside):
            break
        inside = wider
    room = BESIDE * float(np.ptp(inside))
    low, high = max(inside.min() - room, np.nanmin(at)), inside.max() + room
    return float(low), float(min(high, np.nanmax(at)))
