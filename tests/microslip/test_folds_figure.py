"""The picture of folds against a parameter."""

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


def offsets(figure: Figure) -> list[str]:
    """Return the texts beside all axes."""
    figure.draw_without_rendering()
    return [
        axis.get_offset_text().get_text()
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
    ]
