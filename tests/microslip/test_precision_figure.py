"""What the picture of error against run time shows, and what it tells of that."""

import numpy as np
import pytest

from microslip.figures.precision import LOWEST, Line, precision_figure


def _told(errors: list[float], doubt: float) -> tuple[float, str]:
    """Return where the axis of errors begins, and the text below the panels."""
    shown = np.array([errors, errors]).T
    places = tuple(range(len(errors)))
    line = Line(1e-2 + np.arange(len(errors)), shown, (places, places), (np.nan,) * 2)
    figure = precision_figure(
        {"harmonic balance": line}, {"amplitude": doubt, "energy": doubt}, "a"
    )
    (legend,) = figure.legends
    return figure.axes[0].get_ylim()[0], legend.get_title().get_text()


@pytest.mark.parametrize("doubt", [2e-11, 1e-7])
def test_the_grey_is_in_the_picture(doubt: float) -> None:
    bottom, text = _told([1e-3, 1e-8], doubt)

    assert bottom < min(doubt, 1e-8)
    assert "grey" in text


def test_no_grey_is_explained_where_there_is_none() -> None:
    bottom, text = _told([1e-3, 1e-4], 1e-12)

    assert 1e-6 < bottom < 1e-4
    assert "grey" not in text


def test_a_run_without_error_has_a_mark_above_the_axis() -> None:
    bottom, text = _told([0.0, 0.0], 1e-13)

    assert bottom < LOWEST
    assert "Errors below 1e-12 are drawn there" in text
