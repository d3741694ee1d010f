"""The picture of folds against a parameter."""

import pytest
from matplotlib.figure import Figure

from microslip.figures.folds import FoldLine, folds_figure


def test_a_short_fold_has_no_offset_beside_its_axes() -> None:
    few = range(3)
    fold = FoldLine(
        [1.0 + 0.1 * each for each in few],
        [6.0 + 1e-6 * each for each in few],
        [2.797e-4 + 1e-9 * each for each in few],
        [False for _ in few],
        ["" for _ in few],
    )

    figure = folds_figure([fold], "drive.y [N]", "short")

    assert offsets(figure) == [""] * 4


@pytest.mark.parametrize(("most", "scale"), [(1e3, "log"), (10.0, "linear")])
def test_folds_over_decades_have_an_axis_of_decades(most: float, scale: str) -> None:
    fold = FoldLine(
        [0.1, 1.0, most], [6.0, 7.0, 8.0], [1e-3] * 3, [False] * 3, [""] * 3
    )

    figure = folds_figure([fold], "drive.y [N]", "long")

    assert [axes.get_xscale() for axes in figure.axes] == [scale, scale]


def test_folds_are_named_by_their_colours() -> None:
    fold = FoldLine([1.0, 2.0], [6.0, 7.0], [1e-3] * 2, [False] * 2, [""] * 2)

    one, seven = (folds_figure([fold] * count, "", "").axes[1] for count in (1, 7))

    assert one.get_legend() is None
    legend = seven.get_legend()
    assert legend is not None
    names = [text.get_text() for text in legend.get_texts()]
    assert names == ["folds 1, 7", *(f"fold {place}" for place in range(2, 7))]
    colours = [line.get_color() for line in legend.get_lines()]
    assert colours == [line.get_color() for line in seven.lines[::4][:6]]


def offsets(figure: Figure) -> list[str]:
    """Return the texts beside all axes."""
    figure.draw_without_rendering()
    return [
        axis.get_offset_text().get_text()
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
    ]
