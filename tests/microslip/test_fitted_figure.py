"""Legends that cover no line, and titles that fit."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from microslip.figures.fitted import fitted

LONG = "the transverse displacement of the tip"


def _drawn(heights: np.ndarray, scale: str, label: str, count: int) -> Figure:
    """Return a picture of lines with a legend, fitted and laid out."""
    figure = Figure(figsize=(4.0, 3.0), layout="constrained")
    axes = figure.subplots()
    for number in range(count):
        axes.plot(heights * 0.99**number, label=f"{label} {number}")
    axes.set_yscale(scale)
    axes.legend(frameon=False)
    fitted(figure)
    figure.draw_without_rendering()
    return figure


@pytest.mark.parametrize("scale", ["linear", "log"])
@pytest.mark.parametrize(("label", "count"), [(LONG, 1), ("x", 6)])
def test_a_legend_covers_no_line(scale: str, label: str, count: int) -> None:
    zigzag = np.where(np.arange(60) % 2 == 0, 1.0, 100.0)

    figure = _drawn(zigzag, scale, label, count)

    (axes,) = figure.axes
    legend = axes.get_legend()
    assert legend is not None
    top = axes.transData.transform((0.0, 100.0))[1]
    assert legend.get_window_extent().y0 > top
    assert [text.get_text() for text in legend.get_texts()] == [
        f"{label} {number}" for number in range(count)
    ]


def test_where_there_is_room_an_axis_stays_as_it_is() -> None:
    figure = _drawn(np.linspace(0.0, 1.0, 9), "linear", "x", 1)

    assert figure.axes[0].get_ylim()[1] == pytest.approx(1.05)


def test_a_title_takes_as_many_lines_as_it_needs() -> None:
    figure = Figure(figsize=(8.0, 3.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.set_title(f"Amplitude of {LONG}, {LONG}", loc="left")
    right.set_title("Amplitude", loc="left")

    fitted(figure)

    assert "\n" in left.get_title(loc="left")
    assert right.get_title(loc="left") == "Amplitude"
