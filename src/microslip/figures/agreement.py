"""Picture of how far harmonic balance and time integration agree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.abscissa import FREQUENCY, abscissa, parted
from microslip.figures.amplitude import frequency_response, greatest
from microslip.figures.fitted import fitted
from microslip.figures.names import absolute, readable
from microslip.figures.style import COLOURS, STYLES, WIDTH, framed, headline
from microslip.figures.swept_range import show_swept
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.moving_probe import moving_probe
from microslip_mechanics.results.response_curve import ResponseCurve

DOTS: dict[str, Any] = {"linestyle": "", "marker": "o", "ms": 4, "clip_on": False}
"""whole at the ends of the axes, too"""
SMALLEST = 1e-9
"""relative difference that is drawn"""


def agreement_figure(
    curve: ResponseCurve,
    found: tuple[Array, Array, Array, Array],
    sweeps: Sequence[tuple[str, Array, Array]],
    energies: tuple[Array, Array],
    title: str,
) -> Figure:
    """Draw curve and orbits, differences, envelopes of sweeps, and energy by duration.

    The last two are left out without sweeps, the last without friction, and differences
    where there is no orbit.

    Parameters
    ----------
    curve
        The frequency response curve.
    found
        Of each orbit found by shooting: frequency [Hz], amplitude [m] of each probe,
        shape ``(orbits, probes)``, relative difference, and what the estimated errors
        of both solvers admit.
    sweeps
        Name, frequency [Hz] and envelope [m] of each sweep, the latter of shape
        ``(cycles, probes)``, of which one that moves is drawn.
    energies
        How many times slower each sweep is, and its relative energy difference; empty
        without friction.
    title
        Of the figure.
    """
    rows = 2 if sweeps else 1
    figure = Figure(figsize=(10.0, 3.5 * rows), layout="constrained")
    panels = figure.subplots(rows, 2, squeeze=False)
    frequency_response(panels[0, 0], parted(curve))
    shown = greatest(absolute(curve.probes), curve.amplitude, len(STYLES))
    for place, colour in zip(shown, COLOURS, strict=False):
        panels[0, 0].plot(found[0], 1e3 * found[1][:, place], color=colour, **DOTS)
    panels[0, 0].set_title(
        "Curve, and orbits found by shooting (dots)", loc="left", fontsize="medium"
    )
    if found[0].size:
        _differences(panels[0, 1], found)
    else:
        panels[0, 1].remove()
    if sweeps:
        _envelopes(panels[1, 0], parted(curve), sweeps)
        if energies[0].size:
            _energy(panels[1, 1], energies)
        else:
            panels[1, 1].remove()
    fitted(figure)
    headline(figure, title)
    return figure


def _differences(axes: Axes, found: tuple[Array, Array, Array, Array]) -> None:
    """Draw differences as dots and what is admitted as a line; what fails in red."""
    order = np.argsort(found[0], kind="stable")
    hertz, _, difference, admitted = (each[order] for each in found)
    shown = 100.0 * np.maximum(difference, SMALLEST)
    fails = difference > admitted
    bars = {**DOTS, "marker": "_", "ms": 8}
    axes.semilogy(hertz, 100.0 * admitted, color="k", label="admitted", **bars)
    for which, colour, name in (
        (~fails, COLOURS[0], "difference"),
        (fails, COLOURS[1], "too much"),
    ):
        if which.any():
            axes.plot(hertz[which], shown[which], color=colour, label=name, **DOTS)
    framed(
        axes,
        x=FREQUENCY,
        y="of the largest amplitude [%]",
        title="Shooting against harmonic balance",
    )
    axes.legend(frameon=False)


def _envelopes(
    axes: Axes, curve: ResponseCurve, sweeps: Sequence[tuple[str, Array, Array]]
) -> None:
    """Draw the envelopes of a probe that moves in the sweeps, and its curve there."""
    probe = moving_probe(np.concatenate([each for _, _, each in sweeps]))
    drawn = [(hertz, 1e3 * envelope[:, probe]) for _, hertz, envelope in sweeps]
    for colour, (name, *_), line in zip(COLOURS[1:], sweeps, drawn, strict=False):
        axes.plot(*line, color=colour, lw=WIDTH, label=name)
    whole = abscissa(curve), 1e3 * curve.peak[:, probe]
    axes.plot(*whole, "k", lw=WIDTH * 1.5, label="curve")
    show_swept(axes, whole, drawn)
    title = f"Envelope of the sweeps, {readable(curve.probes[probe])}"
    framed(axes, x=FREQUENCY, y="peak [mm]", title=title)
    axes.legend(frameon=False)


def _energy(axes: Axes, energies: tuple[Array, Array]) -> None:
    """Draw the sizes of the differences as dots: their signs may change."""
    slower, error = energies
    axes.plot(slower, 100.0 * np.abs(error), color=COLOURS[0], **DOTS)
    if np.all(error != 0.0):
        axes.set(xscale="log", yscale="log")
    axes.set_xticks(slower, [f"{each:g}" for each in slower])
    axes.minorticks_off()
    axes.set_yticks(100.0 * np.abs(error), [f"{100 * each:.3g}" for each in abs(error)])
    axes.tick_params(axis="y", which="minor", left=False)
    framed(
        axes,
        x="sweep slower by",
        y="difference [%]",
        title="Energy of friction: sweep against curve",
    )
