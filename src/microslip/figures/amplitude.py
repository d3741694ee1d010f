"""The amplitude of a curve, what is located on it, and a close-up of that."""

from __future__ import annotations

import itertools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from microslip.figures.abscissa import abscissa, abscissa_name
from microslip.figures.names import absolute, listed_motion
from microslip.figures.residual_range import residual_range
from microslip.figures.style import COLOURS, STYLES, WIDTH, framed, from_nothing
from microslip_mechanics.results.response_curve import ResponseCurve

MARKERS = {
    "peak": "^",
    "fold": "s",
    "branch point": "o",
    "Neimark-Sacker": "*",
    "period doubling": "D",
    "branch": "P",
    "detached": "p",
    "restart": "x",
}
"""for each event of a curve"""
CHANGES = ("fold", "branch point", "Neimark-Sacker", "period doubling")
"""events at which stability may change"""
NEAR = 0.07
"""of both axes, by which what is located is apart at least, to be told apart well"""
FLAT = 1e-3
"""of an amplitude, that a close-up of it shows above and below at least"""
STEEP = 1e6
"""largest amplitude over the smallest, from which on a curve is nothing but a spike"""
BESIDE = 0.5
"""of what is located, that a close-up shows to either side of it"""


def frequency_response(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the first-harmonic amplitude of each absolute motion."""
    watched = absolute(curve.probes)
    shown = greatest(watched, curve.amplitude, len(STYLES))
    for colour, style, place in zip(COLOURS, STYLES, shown, strict=False):
        axes.plot(
            abscissa(curve),
            1e3 * curve.amplitude[:, place],
            style,
            color=colour,
            linewidth=WIDTH * 2.0,
            label=listed_motion(curve.probes[place]),
        )
    if len(shown) < len(watched):
        axes.plot(
            abscissa(curve),
            _highest(curve),
            color="0.6",
            linewidth=WIDTH,
            label="largest",
        )
    framed(
        axes,
        x=abscissa_name(curve),
        y="amplitude [mm]",
        title=f"First harmonic{some(shown, watched)}",
    )
    residual_range(axes, curve, shown)
    _unstable(axes, curve)
    _events(axes, curve)
    highest = _highest(curve)
    if np.nanmax(highest) > STEEP * np.nanmin(highest) > 0.0:
        axes.set_yscale("log")
    else:
        from_nothing(axes)
    axes.legend(frameon=False)


def greatest(places: list[int], values: np.ndarray, count: int) -> list[int]:
    """Return the columns of ``values`` that come highest, in their order."""
    highest = np.nanmax(values, axis=0, initial=0.0)
    return sorted(sorted(places, key=lambda place: -highest[place])[:count])


def some(shown: list[int], watched: list[int]) -> str:
    """Return what a title adds where not all motions are shown."""
    few = len(shown) < len(watched)
    return f": the greatest {len(shown)} of {len(watched)}" if few else ""


def close_up(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the largest amplitude, and each point, where a crowd of events is."""
    low, high = _window(curve)
    at, size = abscissa(curve), _highest(curve)
    stable, _ = stretches(curve)
    line = np.where(stable, size, np.nan)
    axes.plot(at, line, color=COLOURS[0], linewidth=WIDTH * 1.5, label=steady(curve))
    axes.plot(at, size, ".", color=COLOURS[0], markersize=4.0, label="point")
    _unstable(axes, curve)
    _events(axes, curve)
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
    at, size = abscissa(curve), _highest(curve)
    width, height = NEAR * np.ptp(at[np.isfinite(at)]), NEAR * np.nanmax(size)
    near = {
        place
        for one, other in itertools.pairwise(sorted(places, key=lambda i: at[i]))
        if abs(at[one] - at[other]) < width and abs(size[one] - size[other]) < height
        for place in (one, other)
    }
    return sorted(near)


def _window(curve: ResponseCurve) -> tuple[float, float]:
    """Return the ends of a close-up: all that is located beside the crowd is in it."""
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
    return float(inside.min()) - room, float(inside.max()) + room


def _highest(curve: ResponseCurve) -> np.ndarray:
    """Return the largest amplitude of the absolute motions [mm], shape (points,)."""
    watched = absolute(curve.probes)
    found: np.ndarray = 1e3 * curve.amplitude[:, watched].max(axis=1, initial=0.0)
    return found


def stretches(curve: ResponseCurve) -> tuple[np.ndarray, np.ndarray]:
    """Return which points the stable line has, and which the unstable one.

    A piece between two points is unstable if one of them is; where one turns into the
    other is on both.
    """
    unstable = (curve.unstable > 0) & ~np.isin(np.array(curve.event), CHANGES)
    reached = unstable.copy()
    reached[:-1] |= unstable[1:]
    reached[1:] |= unstable[:-1]
    return ~unstable, reached


def steady(curve: ResponseCurve) -> str:
    """Return the name of what is not unstable: stable, if the stability is known."""
    return "curve" if (curve.unstable < 0).any() else "stable"


def _unstable(axes: Axes, curve: ResponseCurve) -> None:
    """Draw over the unstable stretches."""
    _, unstable = stretches(curve)
    if not unstable.any():
        return
    axes.plot(
        abscissa(curve),
        np.where(unstable, _highest(curve), np.nan),
        color="0.15",
        linewidth=WIDTH * 0.8,
        label="unstable",
    )


def _events(axes: Axes, curve: ResponseCurve) -> None:
    """Mark what was located on the curve."""
    events = np.array(curve.event)
    for kind, marker in MARKERS.items():
        places = events == kind
        if places.any():
            axes.plot(
                abscissa(curve)[places],
                _highest(curve)[places],
                marker,
                color="0.15",
                markersize=6.0,
                fillstyle="none",
                label=kind,
            )
