"""Picture of how far harmonic balance and time integration agree."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.curve import FREQUENCY, abscissa, frequency_response
from microslip.figures.style import COLOURS, WIDTH, absolute, framed, literal, readable
from microslip_mechanics.arrays import Array
from microslip_mechanics.response import ResponseCurve


def agreement_figure(
    curve: ResponseCurve,
    marched: tuple[Array, Array, Array],
    sweeps: Sequence[tuple[str, Array, Array]],
    energies: tuple[Array, Array],
    title: str,
) -> Figure:
    """Draw curve and march, deviation, envelopes of sweeps, and energy by duration.

    Without sweeps the latter two are left out.

    Parameters
    ----------
    curve
        The frequency response curve.
    marched
        Frequency [Hz], marched amplitude [m] of each absolute probe and relative
        deviation of each orbit.
    sweeps
        Name, frequency [Hz] and envelope [m] of the first probe, of each sweep.
    energies
        How many times slower each sweep is, and its relative energy difference.
    title
        Of the figure.
    """
    lines = 2 if sweeps else 1
    figure = Figure(figsize=(10.0, 3.6 * lines), layout="constrained")
    panels = figure.subplots(lines, 2, squeeze=False)
    frequency_response(panels[0, 0], curve)
    for place, colour in zip(absolute(curve.probes), COLOURS, strict=False):
        panels[0, 0].plot(
            marched[0], 1e3 * marched[1][:, place], "o", color=colour, ms=4
        )
    panels[0, 0].set_title(
        "Curve, and the march on its orbits (dots)", loc="left", fontsize="medium"
    )
    _deviation(panels[0, 1], marched)
    if sweeps:
        _envelopes(panels[1, 0], curve, sweeps)
        _energy(panels[1, 1], energies)
    figure.suptitle(literal(title))
    return figure


def _deviation(axes: Axes, marched: tuple[Array, Array, Array]) -> None:
    axes.semilogy(
        marched[0], 100.0 * marched[2], "o-", color=COLOURS[0], lw=WIDTH, ms=4
    )
    framed(
        axes,
        x=FREQUENCY,
        y="deviation [%]",
        title="Amplitude after the march, deviation",
    )


def _envelopes(
    axes: Axes, curve: ResponseCurve, sweeps: Sequence[tuple[str, Array, Array]]
) -> None:
    for colour, (name, frequency, envelope) in zip(COLOURS[1:], sweeps, strict=False):
        axes.plot(frequency, 1e3 * envelope, color=colour, lw=WIDTH, label=name)
    axes.plot(
        abscissa(curve), 1e3 * curve.peak[:, 0], "k", lw=WIDTH * 1.5, label="curve"
    )
    title = f"Envelope of the sweeps, {readable(curve.probes[0])}"
    framed(axes, x=FREQUENCY, y="peak [mm]", title=title)
    axes.legend(frameon=False)


def _energy(axes: Axes, energies: tuple[Array, Array]) -> None:
    slower, error = energies
    axes.plot(slower, 100.0 * np.abs(error), "o-", color=COLOURS[0], lw=WIDTH, ms=4)
    if slower.size and np.all(error != 0.0):
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
