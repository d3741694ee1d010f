"""Picture of where swept sines jump, beside the folds of the curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.abscissa import FREQUENCY, abscissa, parted
from microslip.figures.amplitude import steady, stretches
from microslip.figures.fitted import fitted
from microslip.figures.names import readable
from microslip.figures.style import COLOURS, STYLES, WIDTH, framed, headline
from microslip.figures.swept_range import show_swept
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response_curve import ResponseCurve

BESIDE = 0.2
"""how much of the curve is shown beside the sweeps, over their range"""


@dataclass(frozen=True, slots=True)
class JumpLine:
    """Sweeps through one fold."""

    name: str
    fold: float
    """[Hz]"""
    rates: Array
    """[Hz/s], shape (rates,)"""
    late: Array
    """how far behind the fold each sweep jumps [Hz], shape (rates,)"""
    extrapolated: float
    """the same of an infinitely slow one [Hz]; NaN if it is not known"""
    error: float
    """its error [Hz]"""
    envelopes: Sequence[tuple[Array, Array]]
    """frequency [Hz] and largest deflection [m] of each cycle"""
    probe: int = 0
    """of which the deflection is"""


def jumps_figure(curve: ResponseCurve, jumps: Sequence[JumpLine], title: str) -> Figure:
    """Draw the curve with the envelopes of sweeps, and jumps against the rate."""
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    _envelopes(left, curve, jumps)
    for colour, jump in zip(COLOURS, jumps, strict=False):
        _late(right, jump, colour)
    framed(
        right,
        x="(sweep rate)^(2/3) [(Hz/s)^(2/3)]",
        y="jump behind the fold [Hz]",
        title="Delay of the jump, and what is left of it at no rate",
    )
    right.set_xlim(0.0, 1.05 * max(jump.rates.max() for jump in jumps) ** (2.0 / 3.0))
    right.axhline(0.0, color="k", linewidth=WIDTH)
    right.legend(frameon=False)
    fitted(figure)
    headline(figure, title)
    return figure


def _envelopes(axes: Axes, curve: ResponseCurve, jumps: Sequence[JumpLine]) -> None:
    whole, probes = parted(curve), sorted({jump.probe for jump in jumps})
    at, peaks = abscissa(whole), 1e3 * whole.peak[:, probes]
    for shown, style, name in zip(
        stretches(whole), STYLES, (steady(whole), "unstable"), strict=False
    ):
        if not shown.any():
            continue
        line = np.where(shown[:, None], peaks, np.nan)
        first, *_ = axes.plot(at, line, style, color="k", lw=2 * WIDTH)
        first.set_label(name)
    for colour, jump in zip(COLOURS, jumps, strict=False):
        for hertz, envelope in jump.envelopes:
            axes.plot(hertz, 1e3 * envelope, color=colour, lw=WIDTH)
        axes.axvline(jump.fold, color=colour, ls=":", lw=WIDTH)
    names = ", ".join(readable(curve.probes[probe]) for probe in probes)
    title = f"Curve, and envelopes of the sweeps, {names}"
    framed(axes, x=FREQUENCY, y="peak [mm]", title=title)
    axes.legend(frameon=False)
    swept = [(hertz, 1e3 * each) for jump in jumps for hertz, each in jump.envelopes]
    if swept:
        show_swept(axes, (at, peaks), swept, beside=BESIDE)


def _late(axes: Axes, jump: JumpLine, colour: str) -> None:
    scaled = jump.rates ** (2.0 / 3.0)
    axes.plot(scaled, jump.late, "o", color=colour, ms=4, label=jump.name)
    axes.errorbar(
        [0.0],
        [jump.extrapolated],
        yerr=[jump.error],
        fmt="D",
        color=colour,
        ms=4,
        capsize=4,
        clip_on=False,
    )
    order = np.argsort(scaled)
    line = np.append(jump.extrapolated, jump.late[order])
    axes.plot(np.append(0.0, scaled[order]), line, color=colour, lw=WIDTH, ls="--")
