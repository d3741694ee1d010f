"""How far amplitudes are not unique, in words and in a picture."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest
from matplotlib.axes import Axes

from figure_checks import legend, unique
from hbm.curves.residual_range import ResidualRange
from microslip.commands.residual_range import residual_range
from microslip.figures.amplitude import frequency_response
from microslip_mechanics.results.response_curve import ResponseCurve
from scene_texts import BETWEEN_FACES

Run: TypeAlias = Callable[..., tuple[int, str, str]]


def changed(curve: ResponseCurve, low: float, high: float) -> ResponseCurve:
    """Return a curve whose second point may change by these shares."""
    lowest, highest = curve.amplitude.copy(), curve.amplitude.copy()
    lowest[1] *= 1.0 + low
    highest[1] *= 1.0 + high
    return replace(curve, amplitude_lowest=lowest, amplitude_highest=highest)


def test_nothing_is_told_of_unique_amplitudes(small_curve: ResponseCurve) -> None:
    assert residual_range(unique(small_curve)) == []
    assert residual_range(changed(small_curve, -5e-4, 5e-4)) == []


def test_both_sides_are_told_with_their_place(small_curve: ResponseCurve) -> None:
    told = " ".join(residual_range(changed(small_curve, -0.125, 0.25)))

    assert "1 of 4 points" in told
    assert "-12.5 % at 131.0000 Hz and +25 % at 131.0000 Hz" in told


def test_large_changes_are_told_without_powers_of_ten(
    small_curve: ResponseCurve,
) -> None:
    told = " ".join(residual_range(changed(small_curve, -0.5, 36.04)))

    assert "-50 % at 131.0000 Hz and +3604 % at 131.0000 Hz" in told


def test_a_side_without_change_is_not_told(small_curve: ResponseCurve) -> None:
    told = " ".join(residual_range(changed(small_curve, 0.0, 0.25)))

    assert "by up to +25 % at 131.0000 Hz" in told


def test_along_a_parameter_its_value_is_told(small_curve: ResponseCurve) -> None:
    curve = replace(
        changed(small_curve, 0.0, 0.5),
        along="mu",
        parameter=np.array([0.1, 0.2, 0.3, 0.4]),
    )

    assert "+50 % at 0.2" in " ".join(residual_range(curve))


def test_points_that_are_left_out_are_counted(small_curve: ResponseCurve) -> None:
    curve = changed(small_curve, 0.0, 0.5)
    curve.amplitude_lowest[3] = curve.amplitude_highest[3] = np.nan

    first, second, *_ = residual_range(curve)

    assert "not sought at 1 of 4 points" in first
    assert "1 of 4 points, by up to +50 % at 131.0000 Hz" in second


def test_the_largest_amplitude_is_told_if_it_is_larger(
    small_curve: ResponseCurve,
) -> None:
    curve = changed(small_curve, 0.0, 9.0)
    highest = 1e3 * curve.amplitude_highest.max()

    *_, told = residual_range(curve)

    assert f"{highest:.6g} mm at 131.0000 Hz" in told
    assert f"in place of {1e3 * curve.amplitude.max():.6g} mm" in told


def test_verify_says_that_its_curve_is_one_of_many(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # the search for them takes longest, and is not what the command adds
    monkeypatch.setattr(ResidualRange, "at", lambda *_: np.array([[-0.1], [0.5]]))
    scene = tmp_path / "faces.toml"
    scene.write_text(BETWEEN_FACES, encoding="utf-8")
    few = "--frequencies", "2", "--slower"

    status, output, _ = run("verify", str(scene), *few, "-o", str(tmp_path / "faces"))

    assert status == 0
    assert "not unique: contacts that stick" in output
    assert "agree: largest difference" in output


def test_a_band_is_drawn_where_amplitudes_vary(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curve = changed(small_curve, -0.5, 0.5)

    frequency_response(axes, curve)

    assert legend(axes).count("by other residual tractions") == 1
    bands = [np.vstack([p.vertices for p in c.get_paths()]) for c in axes.collections]
    assert bands
    for band in bands:
        at = np.isclose(band[:, 0], 131.0)
        values = np.unique(np.round(band[at, 1], 12))
        assert values.max() / values.min() == pytest.approx(3.0)  # 1.5 and 0.5 times


def test_no_band_is_drawn_of_unique_amplitudes(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    frequency_response(axes, unique(small_curve))

    assert not axes.collections
    assert "by other residual tractions" not in legend(axes)
