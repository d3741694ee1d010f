"""Pictures of a frequency response curve."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.style import (
    COLOURS,
    STYLES,
    WIDTH,
    absolute,
    faces,
    framed,
    headline,
    legend_above,
    literal,
    readable,
    relative,
)
from microslip_mechanics.response import ResponseCurve

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
FREQUENCY = "excitation frequency [Hz]"
LAYOUTS = {
    2: ((2, 1, 1), (2, 1, 2)),
    3: ((2, 1, 1), (2, 2, 3), (2, 2, 4)),
    4: ((2, 2, 1), (2, 2, 2), (2, 2, 3), (2, 2, 4)),
}
"""for each number of panels their rows, columns and places"""
BEGINNINGS = ("branch", "detached", "restart")
"""events at which a line does not go on from the point before"""


def curve_figure(curve: ResponseCurve, title: str) -> Figure:
    """Draw amplitude, sliding velocity, dissipated energy and normal forces.

    Where one of the last two is nothing, the estimated error takes its place; without
    any of them the amplitude has all of the width.
    """
    curve = parted(curve)
    drawn = [frequency_response, sliding_velocity]
    if (largest(curve.friction_energy), largest(curve.damping_energy)) != (0.0, 0.0):
        drawn.append(dissipated_energy)
    if largest(curve.normal_largest) > 0.0:
        drawn.append(normal_forces)
    if len(drawn) < max(LAYOUTS) and largest(curve.error) > 0.0:
        drawn.append(estimated_error)
    figure = Figure(figsize=(10.0, 7.0), layout="constrained")
    for draw, place in zip(drawn, LAYOUTS[len(drawn)], strict=True):
        draw(figure.add_subplot(*place), curve)
    headline(figure, title)
    return figure


def largest(values: np.ndarray) -> float:
    """Return the largest finite size of values, zero if there is none."""
    return float(np.abs(values[np.isfinite(values)]).max(initial=0.0))


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
            label=readable(curve.probes[place]),
        )
    if len(shown) < len(watched):
        highest = 1e3 * curve.amplitude[:, watched].max(axis=1)
        axes.plot(
            abscissa(curve), highest, color="0.6", linewidth=WIDTH, label="largest"
        )
    framed(
        axes,
        x=abscissa_name(curve),
        y="amplitude [mm]",
        title=f"First harmonic{some(shown, watched)}",
    )
    _events(axes, curve)
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False)


def greatest(places: list[int], values: np.ndarray, count: int) -> list[int]:
    """Return the columns of ``values`` that come highest, in their order."""
    highest = np.nanmax(values, axis=0, initial=0.0)
    return sorted(sorted(places, key=lambda place: -highest[place])[:count])


def some(shown: list[int], watched: list[int]) -> str:
    """Return what a title adds where not all motions are shown."""
    few = len(shown) < len(watched)
    return f": the greatest {len(shown)} of {len(watched)}" if few else ""


def _events(axes: Axes, curve: ResponseCurve) -> None:
    """Mark unstable stretches and what was located on the curve."""
    watched = absolute(curve.probes)
    largest = 1e3 * curve.amplitude[:, watched].max(axis=1, initial=0.0)
    unstable = np.where(curve.unstable > 0, largest, np.nan)
    if (curve.unstable > 0).any():
        axes.plot(
            abscissa(curve),
            unstable,
            color="0.15",
            linewidth=WIDTH * 0.8,
            label="unstable",
        )
    events = np.array(curve.event)
    for kind, marker in MARKERS.items():
        places = events == kind
        if places.any():
            axes.plot(
                abscissa(curve)[places],
                largest[places],
                marker,
                color="0.15",
                markersize=6.0,
                fillstyle="none",
                label=kind,
            )


def sliding_velocity(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the largest relative velocity in time, logarithmically.

    The largest velocity of the probes, where none of them is a relative motion.
    """
    slips = relative(curve.probes)
    watched = slips or absolute(curve.probes)
    shown = greatest(watched, curve.velocity_peak, len(COLOURS))
    looks = zip(COLOURS, itertools.cycle(STYLES), shown, strict=False)
    for colour, style, place in looks:
        axes.plot(
            abscissa(curve),
            curve.velocity_peak[:, place],
            style,
            color=colour,
            linewidth=WIDTH * 1.5,
            label=readable(curve.probes[place]),
        )
    if not (curve.velocity_peak[:, shown] <= 0.0).any():
        axes.set_yscale("log")
    framed(
        axes,
        x=abscissa_name(curve),
        y="velocity [m/s]",
        title=f"Largest {'relative ' if slips else ''}velocity{some(shown, watched)}",
    )
    axes.legend(frameon=False)


def dissipated_energy(axes: Axes, curve: ResponseCurve) -> None:
    """Draw what friction and contact damping take out per period."""
    for colour, name, energy in (
        (COLOURS[0], "friction", curve.friction_energy),
        (COLOURS[1], "normal contact damping", curve.damping_energy),
    ):
        if name != "friction" and not np.nanmax(energy, initial=0.0) > 0.0:
            continue
        axes.plot(
            abscissa(curve),
            1e3 * energy,
            color=colour,
            linewidth=WIDTH * 1.5,
            label=name,
        )
    framed(axes, x=abscissa_name(curve), y="energy [mJ]", title="Dissipated per period")
    legend_above(axes)


def estimated_error(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the estimated error of the amplitude at each point, where it is known."""
    known = np.where(np.isfinite(curve.error), curve.error, np.nan)
    axes.plot(abscissa(curve), 100.0 * known, color=COLOURS[0], linewidth=WIDTH * 1.5)
    if (known > 0.0).any():
        axes.set_yscale("log")
    framed(
        axes,
        x=abscissa_name(curve),
        y="error [%]",
        title="Estimated error of amplitude",
    )


def normal_forces(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the range of normal forces at the points of each face."""
    styles = itertools.cycle(STYLES)
    for colour, places in zip(COLOURS, faces(curve.contacts).values(), strict=False):
        pressed = [place for place in places if largest(curve.normal_largest[:, place])]
        for place, style in zip(pressed[: len(STYLES)], styles, strict=False):
            low, high = curve.normal_smallest[:, place], curve.normal_largest[:, place]
            axes.fill_between(
                abscissa(curve), low, high, color=colour, alpha=0.12, lw=0.0
            )
            axes.plot(
                abscissa(curve),
                high,
                style,
                color=colour,
                linewidth=WIDTH,
                label=curve.contacts[place],
            )
    lowest = float(np.nanmin(curve.normal_smallest, initial=0.0))
    highest = float(np.nanmax(curve.normal_largest, initial=0.0))
    what = "Spring forces" if curve.pulls else "Normal forces"
    title = f"{what}: range over a period, line at the largest"
    framed(axes, x=abscissa_name(curve), y="force [N]", title=title)
    axes.set_ylim(1.05 * lowest, 1.05 * highest if highest > 0.0 else None)
    if curve.contacts:
        axes.legend(frameon=False, ncols=2)


def abscissa(curve: ResponseCurve) -> np.ndarray:
    """Return the excitation frequency [Hz], or the parameter that is followed."""
    return curve.parameter if curve.along else curve.frequency / (2.0 * np.pi)


def abscissa_name(curve: ResponseCurve) -> str:
    """Return what stands below the axis."""
    return literal(curve.along) if curve.along else FREQUENCY


def parted(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve with an empty point before each at which a line begins anew."""
    places = [i for i, name in enumerate(curve.event) if i and name in BEGINNINGS]
    if not places:
        return curve
    changed: dict[str, object] = {}
    for field in dataclasses.fields(curve):
        value = getattr(curve, field.name)
        if isinstance(value, np.ndarray):
            changed[field.name] = np.insert(value, places, np.nan, axis=0)
    for name in ("event", "outcome"):
        texts = np.insert(np.array(getattr(curve, name), dtype=object), places, "")
        changed[name] = tuple(texts)
    return dataclasses.replace(curve, **changed)  # type: ignore[arg-type]
