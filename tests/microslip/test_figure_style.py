"""Axes of pictures: ticks of logarithmic ones, short and long."""

import pytest
from matplotlib.figure import Figure

from microslip.figures.style import plain_logarithmic


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (0.09, 2.1, ["0.1", "0.2", "0.5", "1", "2"]),
        (3.0, 30.0, ["5", "10", "20"]),
        (1e-6, 2.0, ["$\\mathdefault{10^{-6}}$", "$\\mathdefault{10^{0}}$"]),
    ],
)
def test_logarithmic_axes_have_a_few_readable_ticks(
    low: float, high: float, labels: list[str]
) -> None:
    axes = Figure().subplots()
    axes.set(xscale="log", xlim=(low, high))

    plain_logarithmic(axes.xaxis)

    ticks = zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
    shown = [label.get_text() for place, label in ticks if low <= place <= high]
    assert len(shown) <= 8
    assert not axes.get_xticks(minor=True).size
    assert [label for label in shown if label in labels] == labels
