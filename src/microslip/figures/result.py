"""The picture of whatever a result file holds."""

from __future__ import annotations

from matplotlib.figure import Figure

from microslip.figures.curve import curve_figure
from microslip.figures.envelope import envelope_figure
from microslip.figures.sweep import sweep_figure
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory


def result_figure(result: ResponseCurve | TimeHistory | Envelope, title: str) -> Figure:
    """Draw a curve, a march or the envelope of one.

    Raises
    ------
    ValueError
        If a march has not come far enough to have anything to draw.
    """
    if isinstance(result, ResponseCurve):
        return curve_figure(result, title)
    if not result.time.size:
        raise ValueError("no cycle is complete: there is nothing to draw yet")
    if isinstance(result, Envelope):
        return envelope_figure(result, title)
    return sweep_figure(result, title)
