"""Pictures of curves: the data that they show, labels with units."""

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figure_checks import check_labels, check_lines, legend, unmarked
from microslip.figures import curve as curves
from microslip_mechanics.response import ResponseCurve


def test_unstable_stretches_and_events_are_marked_on_the_largest_amplitude(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.frequency_response(axes, small_curve)

    largest = 1e3 * small_curve.amplitude[:, :3].max(axis=1)
    unstable, *marks = axes.lines[3:]
    drawn = np.asarray(unstable.get_ydata(), dtype=float)
    np.testing.assert_allclose(drawn[2:], largest[2:])
    assert np.isnan(drawn[:2]).all()
    seen = {
        str(mark.get_label()): (mark.get_xdata()[0], mark.get_ydata()[0])  # type: ignore[index]
        for mark in marks
    }
    hertz = curves.abscissa(small_curve)
    assert seen == {
        "peak": (hertz[1], largest[1]),
        "fold": (hertz[2], largest[2]),
    }


def test_frequency_response_shows_absolute_motions_in_millimetres(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve = unmarked(small_curve)

    curves.frequency_response(axes, small_curve)

    hertz = [130.0, 131.0, 133.0, 134.0]
    check_lines(axes.lines, hertz, [*1e3 * small_curve.amplitude.T[:3]])
    assert legend(axes) == ["excited blade", "follower blade", "element"]
    assert axes.get_xlabel() == "excitation frequency [Hz]"
    assert axes.get_ylabel() == "amplitude [mm]"
    assert axes.get_ylim()[0] == 0.0


def test_sliding_velocity_shows_relative_motions(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.sliding_velocity(axes, small_curve)

    hertz = curves.abscissa(small_curve)
    check_lines(axes.lines, hertz, [small_curve.velocity_peak[:, 3]])
    assert legend(axes) == ["element to excited"]
    assert axes.get_ylabel() == "velocity [m/s]"
    assert axes.get_yscale() == "log"


def test_dissipated_energy_shows_friction_and_contact_damping_in_millijoules(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.dissipated_energy(axes, small_curve)

    energies = [1e3 * small_curve.friction_energy, 1e3 * small_curve.damping_energy]
    check_lines(axes.lines, curves.abscissa(small_curve), energies)
    assert legend(axes) == ["friction", "normal contact damping"]
    assert axes.get_ylabel() == "energy [mJ]"


def test_normal_forces_show_the_range_of_every_point(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.normal_forces(axes, small_curve)

    hertz = curves.abscissa(small_curve)
    check_lines(axes.lines, hertz, [*small_curve.normal_largest.T])
    assert legend(axes) == ["B1", "B2", "A1"]
    assert axes.get_ylabel() == "force [N]"
    low = small_curve.normal_smallest
    for place, band in enumerate(axes.collections):
        (path,) = band.get_paths()
        shown = np.asarray(path.vertices)
        assert shown[:, 1].min() == pytest.approx(low[:, place].min())
        assert shown[:, 1].max() == pytest.approx(
            small_curve.normal_largest[:, place].max()
        )


def test_curve_figure_has_four_labelled_panels(small_curve: ResponseCurve) -> None:
    figure = curves.curve_figure(small_curve, "two-blades, model=A")

    check_labels(figure)
    assert len(figure.axes) == 4
    assert figure.get_suptitle() == "two-blades, model=A"


def test_curve_that_folds_back_is_drawn_as_it_was_traced(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve.frequency[:] = 2.0 * np.pi * np.array([130.0, 132.0, 131.0, 133.0])

    curves.frequency_response(axes, small_curve)

    shown = np.asarray(axes.lines[0].get_xdata())
    np.testing.assert_allclose(shown, [130.0, 132.0, 131.0, 133.0])


def test_what_is_nothing_everywhere_has_no_panel(small_curve: ResponseCurve) -> None:
    none = np.zeros_like(small_curve.normal_largest)
    curve = dataclasses.replace(
        small_curve,
        normal_smallest=none,
        normal_largest=none,
        friction_energy=none[:, 0],
        damping_energy=none[:, 0],
        error=none[:, 0],
    )

    figure = curves.curve_figure(curve, "linear")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles == ["First harmonic", "Largest relative velocity"]


def test_without_normal_forces_the_error_takes_their_place(
    small_curve: ResponseCurve,
) -> None:
    none = np.zeros_like(small_curve.normal_largest)
    curve = dataclasses.replace(
        small_curve,
        normal_smallest=none,
        normal_largest=none,
        damping_energy=none[:, 0],
    )

    figure = curves.curve_figure(curve, "duffing")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles[-1] == "Estimated error of amplitude"
    assert legend(figure.axes[2]) == ["friction"]
    known = np.isfinite(curve.error)
    drawn = np.asarray(figure.axes[3].lines[0].get_ydata())
    assert drawn[known] == pytest.approx(100.0 * curve.error[known])


def test_of_many_motions_the_greatest_are_drawn(small_curve: ResponseCurve) -> None:
    sizes = np.array([3.0, 1.0, 9.0, 2.0, 8.0, 7.0])
    curve = dataclasses.replace(
        small_curve,
        probes=tuple(f"tip-{place}" for place in range(6)),
        amplitude=np.tile(sizes, (4, 1)),
    )
    axes = Figure().subplots()

    curves.frequency_response(axes, curve)

    labels = [line.get_label() for line in axes.lines]
    assert labels[:5] == ["tip 0", "tip 2", "tip 4", "tip 5", "largest"]
    assert axes.get_title(loc="left") == "First harmonic: the greatest 4 of 6"
    assert axes.get_ylim()[1] > 9e3


def test_springs_that_pull_are_not_called_normal(small_curve: ResponseCurve) -> None:
    pulling = dataclasses.replace(
        small_curve, normal_smallest=-small_curve.normal_largest
    )
    damped = dataclasses.replace(
        small_curve, normal_smallest=-0.01 * small_curve.normal_largest
    )
    axes = Figure().subplots()

    curves.normal_forces(axes, pulling)

    assert axes.get_title(loc="left").startswith("Spring forces")
    assert axes.get_ylim()[0] < pulling.normal_smallest.min()
    assert not damped.pulls


def test_curves_that_lie_on_one_another_have_different_dashes(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.normal_forces(axes, small_curve)
    forces = [line.get_linestyle() for line in axes.lines]
    axes.clear()
    curves.sliding_velocity(axes, small_curve)
    slips = [line.get_linestyle() for line in axes.lines]

    assert len(forces) > 1
    assert len(set(forces)) == min(4, len(forces))
    assert len(set(slips)) == min(4, len(slips))
