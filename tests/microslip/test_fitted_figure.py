"""Legends that cover no line, titles that fit, and close-ups that are close."""

import dataclasses

import numpy as np
import pytest
from matplotlib.figure import Figure

from microslip.figures.close_up import worth
from microslip.figures.curve import curve_figure
from microslip.figures.fitted import fitted
from microslip_mechanics.results.response_curve import ResponseCurve

LONG = "the transverse displacement of the tip of the longest beam"


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
    left.set_title(f"Amplitude of {LONG}, and some more of it", loc="left")
    right.set_title("Amplitude", loc="left")

    fitted(figure)

    assert "\n" in left.get_title(loc="left")
    assert right.get_title(loc="left") == "Amplitude"


def test_a_close_up_of_everything_is_left_out(small_curve: ResponseCurve) -> None:
    hertz = np.linspace(2.0, 12.0, 41)
    curve = dataclasses.replace(
        small_curve,
        **{
            each.name: np.resize(value, (41, *value.shape[1:]))
            for each in dataclasses.fields(small_curve)
            if isinstance(value := getattr(small_curve, each.name), np.ndarray)
        },
        outcome=("converged",) * 41,
    )
    curve = dataclasses.replace(curve, frequency=2.0 * np.pi * hertz)
    every, few = ("fold",) * 41, ("",) * 19 + ("fold", "peak") + ("",) * 20

    whole = dataclasses.replace(curve, event=every)
    part = dataclasses.replace(curve, event=few)

    assert not worth(whole)
    assert worth(part)
    titles = [each.get_title(loc="left") for each in curve_figure(whole, "").axes]
    assert not any(title.startswith("Close-up") for title in titles)
