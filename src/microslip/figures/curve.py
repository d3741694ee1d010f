"""Pictures of a frequency response curve."""

from __future__ import annotations

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
}
"""for each event of a curve"""
FREQUENCY = "excitation frequency [Hz]"


def curve_figure(curve: ResponseCurve, title: str) -> Figure:
    """Draw amplitude, sliding velocity, dissipated energy and normal forces."""
    figure = Figure(figsize=(10.0, 7.0), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True)
    frequency_response(panels[0, 0], curve)
    sliding_velocity(panels[0, 1], curve)
    dissipated_energy(panels[1, 0], curve)
    normal_forces(panels[1, 1], curve)
    figure.suptitle(literal(title))
    return figure


def frequency_response(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the first-harmonic amplitude of each absolute motion."""
    lines = zip(COLOURS, STYLES, absolute(curve.probes), strict=False)
    for colour, style, place in lines:
        axes.plot(
            hertz(curve),
            1e3 * curve.amplitude[:, place],
            style,
            color=colour,
            linewidth=WIDTH * 2.0,
            label=readable(curve.probes[place]),
        )
    framed(axes, x=FREQUENCY, y="amplitude [mm]", title="First harmonic, along z")
    axes.set_ylim(bottom=0.0)
    _events(axes, curve)
    axes.legend(frameon=False)


def _events(axes: Axes, curve: ResponseCurve) -> None:
    """Mark unstable stretches and what was located on the curve."""
    watched = absolute(curve.probes)
    largest = 1e3 * curve.amplitude[:, watched].max(axis=1, initial=0.0)
    unstable = np.where(curve.unstable > 0, largest, np.nan)
    if (curve.unstable > 0).any():
        axes.plot(
            hertz(curve),
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
                hertz(curve)[places],
                largest[places],
                marker,
                color="0.15",
                markersize=6.0,
                fillstyle="none",
                label=kind,
            )


def sliding_velocity(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the largest relative velocity in time, logarithmically."""
    for colour, place in zip(COLOURS, relative(curve.probes), strict=False):
        axes.plot(
            hertz(curve),
            curve.velocity_peak[:, place],
            color=colour,
            linewidth=WIDTH * 1.5,
            label=readable(curve.probes[place]),
        )
    if (curve.velocity_peak[:, relative(curve.probes)] > 0.0).all():
        axes.set_yscale("log")
    framed(axes, x=FREQUENCY, y="velocity [m/s]", title="Largest relative velocity")
    axes.legend(frameon=False)


def dissipated_energy(axes: Axes, curve: ResponseCurve) -> None:
    """Draw what friction and contact damping take out per period."""
    for colour, name, energy in (
        (COLOURS[0], "friction", curve.friction_energy),
        (COLOURS[1], "normal contact damping", curve.damping_energy),
    ):
        axes.plot(
            hertz(curve), 1e3 * energy, color=colour, linewidth=WIDTH * 1.5, label=name
        )
    framed(axes, x=FREQUENCY, y="energy [mJ]", title="Dissipated per period")
    axes.legend(frameon=False, loc="upper left")


def normal_forces(axes: Axes, curve: ResponseCurve) -> None:
    """Draw the range of normal forces at the points of each face."""
    for colour, places in zip(COLOURS, faces(curve.contacts).values(), strict=False):
        for style, place in zip(STYLES, places, strict=False):
            low, high = curve.normal_smallest[:, place], curve.normal_largest[:, place]
            axes.fill_between(hertz(curve), low, high, color=colour, alpha=0.12, lw=0.0)
            axes.plot(
                hertz(curve),
                high,
                style,
                color=colour,
                linewidth=WIDTH,
                label=curve.contacts[place],
            )
    title = "Normal forces: range over a period, line at the largest"
    framed(axes, x=FREQUENCY, y="force [N]", title=title)
    low, high = (
        curve.normal_smallest.min(initial=0.0),
        curve.normal_largest.max(initial=0),
    )
    axes.set_ylim(low, 1.05 * high if high > 0.0 else None)
    axes.legend(frameon=False, ncols=2)


def hertz(curve: ResponseCurve) -> np.ndarray:
    """Return the excitation frequency [Hz]."""
    return curve.frequency / (2.0 * np.pi)
