"""Pictures of sweeps: the data that they show, labels with units."""

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes

from figure_checks import check_labels, check_lines, legend
from microslip.figures import curve as curves
from microslip.figures import march
from microslip.figures import sweep as sweeps
from microslip.figures.envelope import envelope_figure
from microslip.figures.names import foremost
from microslip.figures.passes import Pass, amplitude
from microslip.figures.style import alike, legend_beside, one_range
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory


def test_displacement_shows_one_probe_in_millimetres(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.displacement(axes, small_history, 1, "C0")

    moved = 1e3 * small_history.displacement[:, 1]
    check_lines(axes.lines, small_history.time, [moved])
    assert "follower blade" in axes.get_title(loc="left")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "displacement [mm]")


def test_relative_velocity_shows_one_probe(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.relative_velocity(axes, small_history, 3)

    check_lines(axes.lines, small_history.time, [small_history.velocity[:, 3]])
    assert "element to excited" in axes.get_title(loc="left")
    assert axes.get_ylabel() == "velocity [m/s]"


def test_normal_force_shows_the_points_of_one_face(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.normal_force(axes, small_history, "B", [0, 1])

    check_lines(axes.lines, small_history.time, [*small_history.normal_force.T[:2]])
    assert legend(axes) == ["B1", "B2"]
    assert axes.get_ylabel() == "force [N]"


def test_a_force_that_does_not_change_is_not_magnified(
    small_history: TimeHistory, small_envelope: Envelope
) -> None:
    contacts, cycles = len(small_history.contacts), len(small_envelope.time)
    steady = 1.06741573 + 1e-12 * np.linspace(-1.0, 1.0, 6)[:, None].repeat(contacts, 1)
    history = dataclasses.replace(small_history, normal_force=steady)
    envelope = dataclasses.replace(
        small_envelope,
        normal_smallest=steady[:cycles] - 1e-12,
        normal_largest=steady[:cycles],
    )

    for figure in (sweeps.sweep_figure(history, ""), envelope_figure(envelope, "")):
        figure.draw_without_rendering()
        pressed = [
            axes
            for axes in figure.axes
            if axes.get_title(loc="left").startswith("Normal forces")
        ]
        assert pressed
        for axes in pressed:
            assert np.ptp(axes.get_ylim()) > 1e-6
            assert axes.yaxis.get_offset_text().get_text() == ""


def test_forces_that_pull_are_not_called_normal(
    axes: Axes, small_history: TimeHistory
) -> None:
    pulled = small_history.normal_force - small_history.normal_force.mean(axis=0)
    history = dataclasses.replace(small_history, normal_force=pulled)

    sweeps.normal_force(axes, history, "B", [0, 1])

    assert axes.get_title(loc="left") == "Forces, face B"


def test_friction_power_is_shown_negative_as_in_the_paper(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.friction_power(axes, small_history)

    power = -small_history.friction_power
    check_lines(axes.lines, small_history.time, [power])
    assert axes.get_ylabel() == "power [W]"


def test_energies_show_all_flows_with_their_totals(
    axes: Axes, small_history: TimeHistory
) -> None:
    march.energies(axes, small_history)

    check_lines(axes.lines, small_history.time, [*small_history.energy.T[:4]])
    names = ("input", "friction", "normal damping", "structural damping")
    totals = small_history.energy[-1, :4]
    assert legend(axes) == [
        f"{name}: {total:.4g} J" for name, total in zip(names, totals, strict=True)
    ]
    assert axes.get_ylabel() == "energy [J]"
    closing = np.abs(small_history.closing_error).max()
    assert f"{closing:.1e} J" in axes.get_title(loc="left")


def test_sweep_figure_has_a_labelled_panel_for_each_thing_to_see(
    small_history: TimeHistory,
) -> None:
    figure = sweeps.sweep_figure(small_history, "two-blades")

    check_labels(figure)
    figure.draw_without_rendering()
    for axes in figure.axes:
        assert any(label.get_text() for label in axes.get_xticklabels())
        assert all(tick.label1.get_visible() for tick in axes.xaxis.get_major_ticks())
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    # two blades, one slip, two faces, power, energies
    assert len(titles) == len(set(titles)) == 7
    assert figure.get_suptitle() == "two-blades"


def test_what_a_scene_does_not_have_is_left_out_of_its_sweep_figure(
    small_history: TimeHistory,
) -> None:
    energy = small_history.energy.copy()
    energy[:, 1], energy[:, 2] = 0.0, 1e-18 * energy[:, 0]
    smooth = dataclasses.replace(
        small_history,
        energy=energy,
        friction_power=np.zeros_like(small_history.friction_power),
        normal_force=np.zeros_like(small_history.normal_force),
    )

    figure = sweeps.sweep_figure(smooth, "two-blades")

    # two blades, one slip, energies
    assert len(figure.axes) == 4
    flows = [text.split(":")[0] for text in legend(figure.axes[-1])]
    assert flows == ["input", "structural damping"]


def test_sweep_figure_shows_both_blades_on_one_scale(
    small_history: TimeHistory,
) -> None:
    figure = sweeps.sweep_figure(small_history, "two-blades")

    limits = [axes.get_ylim() for axes in figure.axes[:2]]
    shown = 1e3 * small_history.displacement[:, :2]
    low, high = min(float(shown.min()), 0.0), max(float(shown.max()), 0.0)
    room = 0.05 * (high - low)
    assert limits[0] == limits[1]
    assert limits[0] == pytest.approx((low - room, high + room))


@pytest.mark.parametrize(
    ("ends", "limits"),
    [
        ((-1.0, 2.0), (-2.1, 2.1)),
        ((-0.5, 2.0), (-0.625, 2.125)),
        ((0.2, 2.0), (-0.1, 2.1)),
        ((-2.0, -0.2), (-2.1, 0.1)),
        ((0.0, 0.0), (-1.05e-9, 1.05e-9)),
    ],
)
def test_motions_nearly_about_zero_have_it_in_the_middle(
    ends: tuple[float, float], limits: tuple[float, float]
) -> None:
    columns = [np.array(ends), np.array(ends) * 0.5]
    assert one_range(columns) == pytest.approx(limits)


@pytest.mark.parametrize(("begin", "above"), [(0.1, False), (0.9, True)])
def test_a_legend_covers_no_line_that_begins_high(
    begin: float, above: bool, axes: Axes
) -> None:
    line = np.linspace(begin, 1.0, 50)
    axes.plot(line, label="pad")
    axes.set_ylim(0.0, 1.0)

    legend_beside(axes, line[:, None])

    assert (axes.get_ylim()[1] > 1.1) == above


def test_the_three_largest_motions_have_panels_where_there_are_no_relative_ones(
    small_history: TimeHistory,
) -> None:
    sizes = np.array([1.0, 0.1, 3.0, 2.0])
    rows = np.multiply.outer(np.sin(small_history.time), sizes)
    rows[:, 1] += 10.0  # moves least, wherever it stands
    count = len(small_history.time)
    history = dataclasses.replace(
        small_history,
        probes=("x1", "x2", "x3", "x4"),
        displacement=rows,
        velocity=np.zeros((count, 4)),
    )

    figure = sweeps.sweep_figure(history, "a title")

    titles = [axes.get_title(loc="left") for axes in figure.axes]
    shown = [title for title in titles if title.startswith("Displacement")]
    assert shown == [f"Displacement, {name}" for name in ("x1", "x3", "x4")]


def test_what_rests_beside_what_moves_has_no_panel() -> None:
    assert foremost(("still", "x", "y"), np.array([1e-17, 1e-3, 1e-9])) == [1, 2]
    assert foremost(("x", "still"), np.array([1e-3, 0.0])) == [0]
    assert foremost(("x", "y"), np.zeros(2)) == [0, 1]
    assert foremost(("still", "x", "x-to-still"), np.array([0.0, 1.0, 1.0])) == [1]
    assert foremost(("x-to-y",), np.ones(1)) == []


@pytest.mark.parametrize("panel", ["sweep", "curve"])
def test_legend_of_energies_lies_above_their_lines(
    axes: Axes, panel: str, small_history: TimeHistory, small_curve: ResponseCurve
) -> None:
    if panel == "sweep":
        march.energies(axes, small_history)
    else:
        curves.dissipated_energy(axes, small_curve)

    axes.figure.draw_without_rendering()  # type: ignore[union-attr]
    shown = axes.get_legend()
    assert shown is not None
    below = axes.transData.inverted().transform(shown.get_window_extent())[0, 1]
    assert below > max(np.asarray(line.get_ydata()).max() for line in axes.lines)


def test_without_normal_forces_there_is_no_panel_of_them(
    small_history: TimeHistory,
) -> None:
    none = np.zeros_like(small_history.normal_force)

    pressed = sweeps.sweep_figure(small_history, "rig")
    free = sweeps.sweep_figure(
        dataclasses.replace(small_history, normal_force=none), "rig"
    )

    assert any("Normal" in each.get_title(loc="left") for each in pressed.axes)
    assert not any("Normal" in each.get_title(loc="left") for each in free.axes)


def test_curves_that_hide_one_another_are_one_with_both_names(
    axes: Axes, small_history: TimeHistory
) -> None:
    forces = small_history.normal_force.copy()
    forces[:, 1] = forces[:, 0]
    history = dataclasses.replace(small_history, normal_force=forces)

    sweeps.normal_force(axes, history, "B", [0, 1])

    check_lines(axes.lines, history.time, [forces[:, 0]])
    assert legend(axes) == ["B1, B2"]


def test_an_input_that_friction_takes_all_of_is_seen_beneath_it(
    axes: Axes, small_history: TimeHistory
) -> None:
    march.energies(axes, small_history)

    first, *others = axes.lines
    assert all(first.get_linewidth() >= 2.0 * each.get_linewidth() for each in others)
    assert first.get_zorder() <= min(each.get_zorder() for each in others)


@pytest.mark.parametrize("levels", [[1.0, 2.0], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]])
def test_legend_of_levels_lies_above_their_lines(
    axes: Axes, levels: list[float]
) -> None:
    hertz = np.linspace(4.0, 7.0, 9)
    ways = [
        Pass(level, rises, hertz, np.full((9, 1), 1e-3 * level))
        for level in levels
        for rises in (True, False)
    ]

    amplitude(axes, ways, 0, "x")

    axes.figure.draw_without_rendering()  # type: ignore[union-attr]
    shown = axes.get_legend()
    assert shown is not None
    box = axes.transData.inverted().transform(shown.get_window_extent())
    assert box[0, 1] > max(levels)
    assert axes.get_ylim()[0] == 0.0


def test_dense_curves_hide_one_another_where_their_ranges_are_alike() -> None:
    time = np.linspace(0.0, 1.0, 40_000)
    wave = np.sin(2.0 * np.pi * 2000.0 * time)
    columns = np.stack([wave, -wave, 0.9 * wave], axis=1)

    assert alike(columns, [0, 1, 2]) == [[0, 1], [2]]
    assert alike(columns[:1000], [0, 1, 2]) == [[0], [1], [2]]
