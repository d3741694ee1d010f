"""Pictures of envelopes, and the passes of sweeps through resonance."""

import dataclasses

import numpy as np
import pytest

from figure_checks import check_labels, legend
from microslip.figures.envelope import envelope_figure
from microslip.figures.passes import passes
from microslip.figures.result import result_figure
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory


def swept(hertz: np.ndarray, level: np.ndarray, small: Envelope) -> Envelope:
    """Return an envelope whose first probe swings by the frequency in micrometres."""
    cycles = len(hertz)
    made = {
        field.name: np.resize(getattr(small, field.name), (cycles, *shape[1:]))
        for field in dataclasses.fields(small)
        if len(shape := np.shape(getattr(small, field.name))) > 0
        and field.name not in ("probes", "contacts", "energies")
    }
    high = np.tile(1e-6 * hertz[:, None], (1, len(small.probes)))
    changed = {
        "time": np.cumsum(1.0 / hertz),
        "frequency": 2.0 * np.pi * hertz,
        "level": level,
        "highest": high,
        "lowest": -high,
    }
    return dataclasses.replace(small, **(made | changed))


def test_each_way_of_a_sweep_is_a_pass(small_envelope: Envelope) -> None:
    up = np.linspace(125.0, 145.0, 50)
    rest = np.full(20, 125.0)
    hertz = np.concatenate([rest, up, up[::-1], rest, up, up[::-1], rest])
    level = np.repeat([0.0, 0.5, 0.0, 2.0, 0.0], [20, 100, 20, 100, 20])

    ways = passes(swept(hertz, level, small_envelope))

    assert [(way.level, way.rises) for way in ways] == [
        (0.5, True),
        (0.5, False),
        (2.0, True),
        (2.0, False),
    ]
    for way in ways:
        assert 49 <= len(way.hertz) <= 51
        np.testing.assert_allclose(way.swing[:, 0], 1e-6 * way.hertz)


def test_steps_are_one_pass(small_envelope: Envelope) -> None:
    hertz = np.repeat(np.linspace(125.0, 145.0, 11), 20)

    (way,) = passes(swept(hertz, np.ones(220), small_envelope))

    assert way.rises
    assert len(way.hertz) == 220


def test_a_dwell_has_no_pass(small_envelope: Envelope) -> None:
    assert passes(swept(np.full(100, 130.0), np.ones(100), small_envelope)) == []


@pytest.mark.parametrize("driven", [19_940, 15_003], ids=["cut off", "let go"])
def test_passes_of_rows_are_those_of_the_drive(
    driven: int, small_history: TimeHistory
) -> None:
    time = np.arange(1, 19_941) * 1e-4
    hertz = np.linspace(50.0, 80.0, 19_940)
    phase = 2.0 * np.pi * np.cumsum(hertz) * 1e-4
    rows = np.ones((19_940, 4)) * np.sin(phase)[:, None]
    rows[driven:] += 5.0
    history = dataclasses.replace(
        small_history,
        time=time,
        displacement=rows,
        frequency=2.0 * np.pi * hertz,
        level=(np.arange(19_940) < driven).astype(float),
    )

    (way,) = passes(history)

    assert len(way.hertz) == pytest.approx(phase[driven - 1] / 2.0 / np.pi, abs=2)
    # 125 rows a cycle at most: the highest lies within half of one of them
    np.testing.assert_allclose(way.swing, 1.0, atol=4e-3)


def test_envelope_figure_has_a_labelled_panel_for_each_thing_to_see(
    small_envelope: Envelope,
) -> None:
    up = np.linspace(125.0, 145.0, 50)
    hertz, level = np.concatenate([up, up[::-1]]), np.ones(100)

    figure = envelope_figure(swept(hertz, level, small_envelope), "two-blades")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    # as those of a sweep, and the amplitude of both blades against frequency
    assert len(titles) == len(set(titles)) == 9
    assert legend(figure.axes[-1]) == ["up", "down"]


def test_march_without_rows_is_not_drawn(small_envelope: Envelope) -> None:
    none = swept(np.zeros(0), np.zeros(0), small_envelope)

    with pytest.raises(ValueError, match="no cycle is complete"):
        result_figure(none, "title")
