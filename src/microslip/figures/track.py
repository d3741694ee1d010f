"""Pictures of how peaks and bifurcations move with a parameter."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from microslip.figures.curve import MARKERS
from microslip.figures.style import COLOURS, WIDTH, framed, literal
from microslip.studies.track import Tracked

MANY = 10
"""values up to which each has its own tick"""


def track_figure(
    found: Sequence[Tracked], values: Sequence[float], key: str, title: str
) -> Figure:
    """Draw amplitude and frequency of the highest peak, and the other events.

    ``values`` are those of the parameter as numbers, one for each of ``found``.
    """
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    peaks = [(value, each.peak) for value, each in zip(values, found, strict=True)]
    known = [(value, peak) for value, peak in peaks if peak is not None]
    places = [value for value, _ in known]
    left.plot(
        places,
        [1e3 * peak.amplitude for _, peak in known],
        "-^",
        color=COLOURS[0],
        linewidth=WIDTH,
    )
    right.plot(
        places,
        [peak.frequency / (2.0 * np.pi) for _, peak in known],
        "-^",
        color=COLOURS[0],
        linewidth=WIDTH,
        label="highest peak",
    )
    for kind, marker in MARKERS.items():
        seen = [
            (value, event.frequency / (2.0 * np.pi))
            for value, each in zip(values, found, strict=True)
            for event in each.events
            if event.name == kind and event is not each.peak
        ]
        if seen:
            right.plot(
                *zip(*seen, strict=True),
                marker,
                color="0.15",
                fillstyle="none",
                label=kind,
            )
    for axes in (left, right):
        if min(values) > 0.0 and max(values) > 10.0 * min(values):
            axes.set_xscale("log")
        if len(values) <= MANY:
            axes.set_xticks(list(values), [f"{value:g}" for value in values])
            axes.set_xticks([], minor=True)
    framed(left, x=literal(key), y="amplitude [mm]", title="Highest peak")
    left.set_ylim(bottom=0.0)
    framed(right, x=literal(key), y="frequency [Hz]", title="Where it happens")
    right.legend(frameon=False)
    for axes in (left, right):
        axes.margins(x=0.04)
    figure.suptitle(literal(title))
    return figure
