"""The range of amplitudes by other residual tractions, as a band."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from microslip.figures.abscissa import abscissa, one_way
from microslip.figures.style import COLOURS
from microslip_mechanics.results.response_curve import ResponseCurve

SEEN = 1e-3
"""of an amplitude, from which on a band can be told from its line"""


def residual_range(axes: Axes, curve: ResponseCurve, shown: list[int]) -> None:
    """Fill what amplitudes may be by the residual tractions of contacts that stick.

    ``shown`` are the probes, in the order of colours.
    """
    at, label = abscissa(curve), "by other residual tractions"
    for colour, place in zip(COLOURS, shown, strict=False):
        low, high = (
            1e3 * each[:, place]
            for each in (curve.amplitude_lowest, curve.amplitude_highest)
        )
        if not np.nanmax(high - low, initial=0.0) > SEEN * np.nanmax(high, initial=0.0):
            continue
        for part in one_way(at):
            axes.fill_between(
                at[part], low[part], high[part],
                color=colour, alpha=0.18, lw=0.0, label=label,
            )  # fmt: skip
            label = "_"  # one entry of the legend for all
