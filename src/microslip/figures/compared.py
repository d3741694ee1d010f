"""Several curves in one picture, to be compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.abscissa import abscissa, abscissa_name, over_decades, parted
from microslip.figures.amplitude import MARKERS, STEEP, highest, stretches
from microslip.figures.fitted import fitted
from microslip.figures.names import absolute, readable
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    from_nothing,
    headline,
    literal,
    plain_logarithmic,
    widened,
)
from microslip_mechanics.results.response_curve import ResponseCurve

MARKED = ("peak", "fold")
"""events that are marked"""
UNSTABLE = ":"
"""style of a line where the motion is"""
SHADES = "viridis", 0.0, 0.9
"""map of the colours of more curves than there are colours, from where to where"""
THICK = 2.0
"""width of the first line over that of the last one"""
ALONE, BESIDE, HIGH = 8.0, 14.0, 5.5
"""widths of a picture with one panel and with two, and its height [in]"""
NOTHING = 1e-15
"""energy [mJ] that rounding makes of zero, as in the table of a curve"""


def compared_figure(
    curves: Sequence[ResponseCurve], labels: Sequence[str], title: str
) -> Figure:
    """Draw the largest amplitude of each curve, and what its contacts take out.

    The latter has no panel where it is nothing. All curves go along the same quantity.
    """
    curves = [parted(each) for each in curves]
    drawn = [_amplitudes]
    if max(np.nanmax(_energy(each), initial=0.0) for each in curves) > NOTHING:
        drawn.append(_energies)
    size = (ALONE if len(drawn) == 1 else BESIDE, HIGH)
    figure = Figure(figsize=size, layout="constrained")
    panels = figure.subplots(1, len(drawn), squeeze=False)[0]
    decades = bool(curves[0].along) and over_decades(
        np.concatenate([abscissa(each) for each in curves])
    )
    for draw, axes in zip(drawn, panels, strict=True):
        draw(axes, curves, labels)
        if decades:
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
    _explain(figure, curves)
    fitted(figure)
    headline(figure, title)
    return figure


def _amplitudes(
    axes: Axes, curves: Sequence[ResponseCurve], labels: Sequence[str]
) -> None:
    """Draw the largest amplitude of a motion, and mark its peaks and folds."""
    _lines(axes, curves, labels, highest)
    for colour, curve in zip(_colours(len(curves)), curves, strict=True):
        events = np.array(curve.event)
        for kind in MARKED:
            at = events == kind
            places = abscissa(curve)[at], highest(curve)[at]
            axes.plot(*places, MARKERS[kind], color=colour, fillstyle="none")
    watched = {
        curve.probes[each] for curve in curves for each in absolute(curve.probes)
    }
    name = readable(*watched) if len(watched) == 1 else "the largest of all motions"
    framed(
        axes,
        x=abscissa_name(curves[0]),
        y="amplitude [mm]",
        title=f"First harmonic: {name}",
    )
    sizes = np.concatenate([highest(each) for each in curves])
    if np.nanmax(sizes) > STEEP * np.nanmin(sizes) > 0.0:
        axes.set_yscale("log")
    else:
        from_nothing(axes)


def _energies(
    axes: Axes, curves: Sequence[ResponseCurve], labels: Sequence[str]
) -> None:
    """Draw what friction and damping of the contacts take out per period."""
    _lines(axes, curves, labels, _energy)
    framed(
        axes,
        x=abscissa_name(curves[0]),
        y="energy [mJ]",
        title="Dissipated by the contacts per period",
    )
    widened(axes, NOTHING)
    from_nothing(axes)


def _lines(
    axes: Axes,
    curves: Sequence[ResponseCurve],
    labels: Sequence[str],
    values: Callable[[ResponseCurve], np.ndarray],
) -> None:
    """Draw a line for each curve, of another style where it is unstable.

    Of few the later ones are thinner: those that lie on one another are seen.
    """
    few = len(curves) <= len(COLOURS)
    widths = np.linspace(THICK if few else 1.0, 1.0, len(curves)) * 1.5 * WIDTH
    looks = zip(_colours(len(curves)), curves, labels, widths, strict=True)
    for colour, curve, label, width in looks:
        kept, unstable = stretches(curve)
        for style, shown, name in (("-", kept, label), (UNSTABLE, unstable, "")):
            axes.plot(
                abscissa(curve),
                np.where(shown, values(curve), np.nan),
                style,
                color=colour,
                linewidth=width,
                label=literal(name) if name else None,
            )


def _explain(figure: Figure, curves: Sequence[ResponseCurve]) -> None:
    """Put the legend of the curves, and of what marks on them mean.

    More of them than have a colour of their own stand beside the panels.
    """
    axes = figure.axes[0]
    events = {event for curve in curves for event in curve.event}
    styles = {kind: MARKERS[kind] for kind in MARKED if kind in events}
    if any((curve.unstable > 0).any() for curve in curves):
        styles["unstable"] = UNSTABLE
    for name, style in styles.items():
        axes.plot([], [], style, color="0.15", fillstyle="none", label=name)
    if len(curves) <= len(COLOURS):
        axes.legend(frameon=False)
        return
    figure.legend(
        *axes.get_legend_handles_labels(),
        loc="outside right upper",
        frameon=False,
        fontsize="small",
    )


def _energy(curve: ResponseCurve) -> np.ndarray:
    """Return what the contacts take out per period [mJ], shape (points,)."""
    return 1e3 * curve.contact_energy


def _colours(count: int) -> Sequence[object]:
    """Return a colour for each of so many curves."""
    if count <= len(COLOURS):
        return COLOURS[:count]
    name, first, last = SHADES
    return list(colormaps[name](np.linspace(first, last, count)))
