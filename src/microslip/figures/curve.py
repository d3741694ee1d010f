"""Pictures of a frequency response curve."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.abscissa import (
    abscissa,
    abscissa_name,
    by_decades,
    one_way,
    parted,
)
from microslip.figures.amplitude import frequency_response, greatest, some
from microslip.figures.close_up import close_up, worth
from microslip.figures.fitted import fitted
from microslip.figures.names import (
    absolute,
    faces,
    force_kind,
    listed,
    listed_motion,
    relative,
)
from microslip.figures.style import (
    COLOURS,
    SHORT,
    STYLES,
    WIDTH,
    framed,
    from_nothing,
    headline,
    legend_above,
    plain_logarithmic,
    widened,
)
from microslip_mechanics.results.response_curve import ResponseCurve

ROWS = {2: (1, 1), 3: (1, 2), 4: (2, 2), 5: (2, 3), 6: (3, 3)}
"""for each number of panels how many the upper row has, and the lower one"""
WIDE = 4
"""panels up to which a picture has the usual width"""
SMALL = 1e-6
"""of the largest error, or velocity, below which they are not worth a look"""
FAINT = 1e-9
"""of what contacts take out, below which damping is nothing but rounding"""
STEADY = 1e-3
"""of the largest force, by which normal forces vary at least, if they are drawn"""
NOTHING = 1e-15
"""energy [mJ] that rounding makes of zero, as in the table of a curve"""


def curve_figure(curve: ResponseCurve, title: str) -> Figure:
    """Draw amplitude, sliding velocity, energy, normal forces and estimated error.

    What is located too closely together to be told apart has a close-up; what is
    nothing, or does not change, has no panel. A parameter that goes over decades has
    an axis of decades.
    """
    curve = parted(curve)
    drawn = [frequency_response, sliding_velocity]
    if worth(curve) and not by_decades(curve):
        drawn.insert(1, close_up)
    if (_largest(curve.friction_energy), _largest(curve.damping_energy)) != (0.0, 0.0):
        drawn.append(dissipated_energy)
    if _varies(curve):
        drawn.append(normal_forces)
    if _largest(curve.error) > 0.0:
        drawn.append(estimated_error)
    width = 10.0 if len(drawn) <= WIDE else 14.0
    figure = Figure(figsize=(width, 7.0), layout="constrained")
    for draw, axes in zip(drawn, _panels(figure, ROWS[len(drawn)]), strict=True):
        draw(axes, curve)
        if by_decades(curve):
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
    fitted(figure)
    headline(figure, title)
    return figure


def _panels(figure: Figure, rows: tuple[int, ...]) -> Iterator[Axes]:
    """Yield the panels of rows that share the width, each of its own number."""
    grid = figure.add_gridspec(len(rows), math.lcm(*rows))
    for row, count in enumerate(rows):
        width = grid.ncols // count
        for place in range(count):
            yield figure.add_subplot(grid[row, place * width : (place + 1) * width])


def _varies(curve: ResponseCurve) -> bool:
    """Return whether normal forces differ in time or from point to point."""
    if _largest(curve.normal_largest) == 0.0:
        return False
    low = np.nanmin(curve.normal_smallest, axis=0)
    high = np.nanmax(curve.normal_largest, axis=0)
    return float((high - low).max()) > STEADY * _largest(curve.normal_largest)


def _largest(values: np.ndarray) -> float:
    """Return the largest finite size of values, zero if there is none."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


def sliding_velocity(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the largest relative velocity in time, logarithmically.

    The largest velocity of the probes, where none of them is a relative motion. What
    does not move has none but rounding errors.
    """
    slips = relative(curve.probes)
    watched = slips or absolute(curve.probes)
    highest = np.nanmax(curve.velocity_peak, axis=0, initial=0.0)
    most = highest[watched].max(initial=0.0)
    moving = [place for place in watched if highest[place] >= SMALL * most]
    shown = greatest(moving, curve.velocity_peak, len(COLOURS))
    looks = zip(COLOURS, itertools.cycle(STYLES), shown, strict=False)
    for colour, style, place in looks:
        axes.plot(
            abscissa(curve),
            curve.velocity_peak[:, place],
            style,
            color=colour,
            linewidth=WIDTH * 1.5,
            label=listed_motion(curve.probes[place]),
        )
    seen = curve.velocity_peak[:, shown]
    if np.nanmax(seen, initial=0.0) > SHORT * np.nanmin(seen, initial=np.inf) > 0.0:
        axes.set_yscale("log")
        if np.nanmin(seen) < SMALL * most:
            axes.set_ylim(bottom=SMALL * most)
        plain_logarithmic(axes.yaxis)
    framed(
        axes,
        x=abscissa_name(curve),
        y="velocity [m/s]",
        title=f"Largest {'relative ' if slips else ''}velocity{some(shown, watched)}",
    )
    widened(axes)
    axes.legend(frameon=False)


def dissipated_energy(axes: Axes, curve: ResponseCurve) -> None:
    """Draw what friction and damping of the contacts take out per period."""
    damping = "element damping" if curve.pulls else "normal contact damping"
    for colour, name, energy, error in (
        (COLOURS[0], "friction", curve.friction_energy, curve.friction_energy_error),
        (COLOURS[1], damping, curve.damping_energy, curve.damping_energy_error),
    ):
        if not _largest(energy):
            continue
        at, middle, off = abscissa(curve), 1e3 * energy, 1e3 * error
        axes.plot(at, middle, color=colour, linewidth=WIDTH * 1.5, label=name)
        for part in one_way(at):
            low, high = (middle - off)[part], (middle + off)[part]
            axes.fill_between(at[part], low, high, color=colour, alpha=0.25, lw=0.0)
    framed(axes, x=abscissa_name(curve), y="energy [mJ]", title="Dissipated per period")
    widened(axes, NOTHING)
    legend_above(axes)


def estimated_error(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the estimated error at each point, where it is known.

    That of the amplitude, and those of energies over the largest on the curve.
    """
    drawn = {"amplitude": curve.error} | {
        name: error / _largest(energy)
        for name, energy, error in (
            ("friction", curve.friction_energy, curve.friction_energy_error),
            ("damping", curve.damping_energy, curve.damping_energy_error),
        )
        if _largest(energy) > FAINT * _largest(curve.contact_energy) and _largest(error)
    }
    known = [np.where(np.isfinite(each), each, np.nan) for each in drawn.values()]
    for colour, name, error in zip(COLOURS, drawn, known, strict=False):
        at = abscissa(curve)
        axes.plot(at, 100.0 * error, color=colour, linewidth=WIDTH * 1.5, label=name)
    least, most = np.nanmin(known), np.nanmax(known)
    varies = most > SHORT * least
    if varies:
        axes.set_yscale("log")
    alone = len(drawn) == 1
    what = " of amplitude" if alone else ", of energies over their largest"
    title = f"Estimated error{what}"
    framed(axes, x=abscissa_name(curve), y="error [%]", title=title)
    if not varies:
        from_nothing(axes)
    elif least < SMALL * most:
        axes.set_ylim(bottom=100.0 * SMALL * most)
    if not alone:
        legend_above(axes)


def normal_forces(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the range of normal forces at the points of each face."""
    styles, at = itertools.cycle(STYLES), abscissa(curve)
    parts = one_way(at)
    for colour, places in zip(COLOURS, faces(curve.contacts).values(), strict=False):
        pressed = [
            place for place in places if _largest(curve.normal_largest[:, place])
        ]
        for place, style in zip(pressed[: len(STYLES)], styles, strict=False):
            low, high = curve.normal_smallest[:, place], curve.normal_largest[:, place]
            for part in parts:
                axes.fill_between(
                    at[part], low[part], high[part], color=colour, alpha=0.12, lw=0.0
                )
            axes.plot(
                at,
                high,
                style,
                color=colour,
                linewidth=WIDTH,
                label=listed(curve.contacts[place]),
            )
    lowest = float(np.nanmin(curve.normal_smallest, initial=0.0))
    highest = float(np.nanmax(curve.normal_largest, initial=0.0))
    what = force_kind(curve.normal_smallest, curve.normal_largest)
    title = f"{what} over a period, line at the largest"
    framed(axes, x=abscissa_name(curve), y="force [N]", title=title)
    axes.set_ylim(1.05 * lowest, 1.05 * highest if highest > 0.0 else None)
    if curve.contacts:
        axes.legend(frameon=False, ncols=2)
