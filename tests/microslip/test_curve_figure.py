"""Pictures of curves: the data that they show, labels with units."""

import dataclasses
import itertools

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figure_checks import check_labels, check_lines, legend
from microslip.figures import curve as curves
from microslip.figures.abscissa import abscissa
from microslip_mechanics.results.energies import worded
from microslip_mechanics.results.response_curve import ResponseCurve, pulling


def test_sliding_velocity_shows_relative_motions(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.sliding_velocity(axes, small_curve)

    hertz = abscissa(small_curve)
    check_lines(axes.lines, hertz, [small_curve.velocity_peak[:, 3]])
    assert legend(axes) == ["element to excited"]
    assert axes.get_ylabel() == "velocity [m/s]"
    assert axes.get_yscale() == "log"


def test_velocities_of_rounding_errors_do_not_stretch_the_axis(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    moves, rests = np.array([1e-2, 0.3, 0.1, 1e-12]), np.full(4, 1e-17)
    velocity = np.stack([rests, moves, rests], axis=1)
    probes = ("still", "mass", "other")
    curve = dataclasses.replace(small_curve, probes=probes, velocity_peak=velocity)

    curves.sliding_velocity(axes, curve)

    check_lines(axes.lines, abscissa(curve), [moves])
    assert axes.get_ylim()[0] == pytest.approx(0.3e-6)
    assert axes.get_title(loc="left") == "Largest velocity: the greatest 1 of 3"


def test_dissipated_energy_shows_friction_and_contact_damping_in_millijoules(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.dissipated_energy(axes, small_curve)

    energies = [1e3 * small_curve.friction_energy, 1e3 * small_curve.damping_energy]
    check_lines(axes.lines, abscissa(small_curve), energies)
    assert legend(axes) == ["friction", "normal contact damping"]
    assert axes.get_ylabel() == "energy [mJ]"


@pytest.mark.parametrize("panel", ["dissipated_energy", "sliding_velocity"])
def test_what_only_rounding_moves_has_no_axis_of_rounding(
    axes: Axes, small_curve: ResponseCurve, panel: str
) -> None:
    steady = 0.63 + 1e-9 * small_curve.friction_energy / small_curve.friction_energy[0]
    curve = dataclasses.replace(
        small_curve,
        friction_energy=steady,
        damping_energy=np.zeros(4),
        velocity_peak=np.tile(steady[:, None], len(small_curve.probes)),
    )

    getattr(curves, panel)(axes, curve)

    axes.get_tightbbox()
    assert np.ptp(axes.get_ylim()) > 1e-7
    assert axes.yaxis.get_offset_text().get_text() == ""


def test_energy_of_friction_that_there_is_not_is_not_drawn(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curve = dataclasses.replace(small_curve, friction_energy=np.zeros(4))

    curves.dissipated_energy(axes, curve)

    assert legend(axes) == ["normal contact damping"]


def test_energy_of_contacts_that_stick_throughout_has_no_axis_of_rounding(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    rounding = 1e-22 * np.array([1.0, -1.0, 1.0, 0.0])
    curve = dataclasses.replace(
        small_curve, friction_energy=rounding, damping_energy=np.zeros(4)
    )

    curves.dissipated_energy(axes, curve)

    assert np.ptp(axes.get_ylim()) > 1e3 * np.ptp(1e3 * rounding)


def test_normal_forces_show_the_range_of_every_point(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.normal_forces(axes, small_curve)

    hertz = abscissa(small_curve)
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


def test_a_band_of_forces_does_not_cancel_itself_where_a_curve_turns_back(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    hertz = np.array([130.0, 132.0, 133.0, 131.0])
    folded = dataclasses.replace(small_curve, frequency=2.0 * np.pi * hertz)

    curves.normal_forces(axes, folded)

    spans = [band.get_paths()[0].get_extents() for band in axes.collections]
    ways = [130.0, 133.0, 131.0, 133.0] * len(folded.contacts)
    assert [x for span in spans for x in (span.x0, span.x1)] == pytest.approx(ways)


def test_curve_figure_has_a_labelled_panel_for_each_quantity(
    small_curve: ResponseCurve,
) -> None:
    figure = curves.curve_figure(small_curve, "two-blades, model=A")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles == [
        "First harmonic",
        "Largest relative velocity",
        "Dissipated per period",
        "Normal forces over a period, line at the largest",
        "Estimated error, of energies over their largest",
    ]
    assert figure.get_suptitle() == "two-blades, model=A"


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


def test_normal_forces_that_never_change_have_no_panel(
    small_curve: ResponseCurve,
) -> None:
    steady = np.tile([0.5, 1.0, 2.0], (4, 1))
    curve = dataclasses.replace(
        small_curve, normal_smallest=steady, normal_largest=steady * (1.0 + 1e-6)
    )

    figure = curves.curve_figure(curve, "model=A")

    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert not any(title.startswith("Normal forces") for title in titles)


def test_a_crowd_of_events_has_a_panel_and_all_panels_fit(
    small_curve: ResponseCurve,
) -> None:
    small_curve.frequency[1:3] = 2.0 * np.pi * np.array([131.0, 131.01])
    small_curve.amplitude[1:3] = 1e-3

    figure = curves.curve_figure(small_curve, "two-blades")

    check_labels(figure)
    assert len(figure.axes) == 6
    assert figure.axes[1].get_title(loc="left").startswith("Close-up")
    boxes = [axes.get_position() for axes in figure.axes]
    assert not any(
        one.overlaps(other) for one, other in itertools.combinations(boxes, 2)
    )


def without_energies(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve whose energies have no told errors, as of an earlier version."""
    none = np.full(curve.frequency.size, np.nan)
    return dataclasses.replace(
        curve, friction_energy_error=none, damping_energy_error=none
    )


def test_errors_of_energies_are_drawn_over_their_largest_and_as_bands(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.estimated_error(axes, small_curve)

    assert legend(axes) == ["amplitude", "friction", "damping"]
    drawn = np.asarray(axes.lines[1].get_ydata())
    share = small_curve.friction_energy_error / small_curve.friction_energy.max()
    assert drawn == pytest.approx(100.0 * share)


def test_energies_have_the_band_of_their_errors(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.dissipated_energy(axes, small_curve)

    friction, damping = axes.collections[0], axes.collections[-1]
    for band, energy, error in (
        (friction, small_curve.friction_energy, small_curve.friction_energy_error),
        (damping, small_curve.damping_energy, small_curve.damping_energy_error),
    ):
        span = band.get_paths()[0].get_extents()
        assert span.y0 == pytest.approx(1e3 * (energy - error).min())
        assert span.y1 == pytest.approx(1e3 * (energy + error).max())


def test_errors_far_below_the_largest_are_cut_off(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curve = dataclasses.replace(small_curve, error=np.array([1e-3, 1e-4, 1e-14, 1e-5]))

    curves.estimated_error(axes, without_energies(curve))

    assert axes.get_ylim()[0] == pytest.approx(1e-7)  # of 0.1 %


def test_errors_that_hardly_differ_are_drawn_from_nothing(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    error = np.array([1.0976e-6, 1.098e-6, 1.0985e-6, 1.099e-6])

    curve = dataclasses.replace(small_curve, error=error)
    curves.estimated_error(axes, without_energies(curve))

    assert axes.get_yscale() == "linear"
    assert axes.get_ylim() == pytest.approx((0.0, 1.04 * 1.099e-4))


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

    figure = curves.curve_figure(without_energies(curve), "duffing")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert titles[-1] == "Estimated error of amplitude"
    assert legend(figure.axes[2]) == ["friction"]
    known = np.isfinite(curve.error)
    drawn = np.asarray(figure.axes[3].lines[0].get_ydata())
    assert drawn[known] == pytest.approx(100.0 * curve.error[known])


def test_springs_that_pull_are_not_called_normal(small_curve: ResponseCurve) -> None:
    pulling = dataclasses.replace(
        small_curve, normal_smallest=-small_curve.normal_largest
    )
    damped = dataclasses.replace(
        small_curve, normal_smallest=-0.01 * small_curve.normal_largest
    )
    axes = Figure().subplots()

    curves.normal_forces(axes, pulling)

    assert axes.get_title(loc="left").startswith("Forces over ")
    assert axes.get_ylim()[0] < pulling.normal_smallest.min()
    assert not damped.pulls


def test_what_pulls_is_told_beside_a_contact_that_is_pressed_harder() -> None:
    smallest, largest = np.array([[0.0, -1.0]]), np.array([[1e3, 1.0]])

    assert pulling(smallest, largest)
    assert not pulling(smallest[:, :1], largest[:, :1])
    assert worded("normal_damping", pulls=True) == "element damping"
    assert worded("normal_damping", pulls=False) == "normal damping"


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


@pytest.mark.parametrize(("most", "scale"), [(1e9, "log"), (2e3, "linear")])
def test_a_parameter_over_decades_has_an_axis_of_decades(
    small_curve: ResponseCurve, most: float, scale: str
) -> None:
    curve = dataclasses.replace(
        small_curve, parameter=np.geomspace(1e3, most, 4), along="stiffness [N/m]"
    )

    figure = curves.curve_figure(curve, "")

    figure.draw_without_rendering()
    for axes in figure.axes:
        assert axes.get_xscale() == scale
        assert axes.get_xlim() == pytest.approx((1e3, most))
    check_labels(figure)
