"""The amplitude of a curve, where it is stable, and what is located on it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

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
STEEP = 1e6
"""largest amplitude over the smallest, from which on a curve is nothing but a spike"""


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
            highest(curve),
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
    mark_unstable(axes, curve)
    mark_events(axes, curve)
    size = highest(curve)
    if np.nanmax(size) > STEEP * np.nanmin(size) > 0.0:
        axes.set_yscale("log")
    else:
        from_nothing(axes)
    axes.legend(frameon=False)


def greatest(places: list[int], values: np.ndarray, count: int) -> list[int]:
    """Return the columns of ``values`` that come highest, in their order."""
    largest = np.nanmax(values, axis=0, initial=0.0)
    return sorted(sorted(places, key=lambda place: -largest[place])[:count])


def some(shown: list[int], watched: list[int]) -> str:
    """Return what a title adds where not all motions are shown."""
    few = len(shown) < len(watched)
    return f": the greatest {len(shown)} of {len(watched)}" if few else ""


def highest(curve: ResponseCurve) -> np.ndarray:
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


def mark_unstable(axes: Axes, curve: ResponseCurve) -> None:
    """Draw over the unstable stretches."""
    _, unstable = stretches(curve)
    if not unstable.any():
        return
    axes.plot(
        abscissa(curve),
        np.where(unstable, highest(curve), np.nan),
        color="0.15",
        linewidth=WIDTH * 0.8,
        label="unstable",
    )


def mark_events(axes: Axes, curve: ResponseCurve) -> None:
    """Mark what was located on the curve."""
    events = np.array(curve.event)
    for kind, marker in MARKERS.items():
        places = events == kind
        if places.any():
            axes.plot(
                abscissa(curve)[places],
                highest(curve)[places],
                marker,
                color="0.15",
                markersize=6.0,
                fillstyle="none",
                label=kind,
            )
