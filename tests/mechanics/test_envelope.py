"""Envelopes: extremes of cycles, energies at their ends, cut anywhere all the same."""

import dataclasses
from collections.abc import Iterator

import numpy as np
import pytest

from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.loads.sine_test import SineTest, Tone
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.cycle_rows import enveloped, parted
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory

LOADS = SineTest(0.0, 0.0, (Tone(10.0, 30.0, 2.0), Tone(30.0, 10.0, 2.0, 3.0)), 0.0)
ROWS = 40_000


def history() -> TimeHistory:
    """Return a made-up march: the probes follow the drive, one with an offset."""
    time = np.arange(1, ROWS + 1) * LOADS.duration / ROWS
    drive = factors_over(LOADS.segments(), time)[:, 1]
    still = np.zeros((ROWS, 1))
    return TimeHistory(
        time=time,
        probes=("x", "y"),
        displacement=np.stack([drive, 5.0 - 2.0 * drive], axis=1),
        velocity=np.stack([drive, -4.0 * drive], axis=1),
        contacts=("A",),
        normal_force=1.0 + 0.5 * drive[:, None],
        friction_power=still[:, 0],
        energies=("input", "friction"),
        energy=np.stack([time, time - 0.25], axis=1),
        stored_at_start=0.0,
        time_step=1e-4,
        iterations=ROWS,
        divided=0,
        checkpoint=Checkpoint(still[0], still[0], np.array([7.0])),
    )


def estimated(whole: TimeHistory) -> TimeHistory:
    """Return the same with errors that grow from row to row."""
    grows = np.arange(1.0, ROWS + 1)
    return dataclasses.replace(
        whole, energy_error=grows, peak_error=2.0 * grows, work_difference=-grows
    )


def cut(whole: TimeHistory, edges: list[int]) -> Iterator[TimeHistory]:
    """Yield the rows between edges."""
    for first, last in zip([0, *edges], [*edges, ROWS], strict=True):
        rows = {
            field.name: getattr(whole, field.name)[first:last]
            for field in dataclasses.fields(whole)
            if len(np.shape(getattr(whole, field.name))) > 0
            and len(getattr(whole, field.name)) == ROWS
        }
        yield dataclasses.replace(whole, **rows, iterations=last - first)


def of(blocks: Iterator[TimeHistory]) -> Envelope:
    return joined(list(enveloped(blocks, LOADS.segments())), "complete")


def test_extremes_are_those_of_the_drive() -> None:
    envelope = of(cut(history(), []))

    # 2 x 2 s from 10 to 30 Hz: (30 - 10) / ln 3 x 2 turns each
    assert len(envelope.time) == int(np.ceil(2 * 2.0 * 20.0 / np.log(3.0)))
    level = np.where(envelope.time <= 2.0, 1.0, 3.0)
    np.testing.assert_array_equal(envelope.level, level)
    inside = np.ones(len(level), bool)
    inside[int(np.argmax(level > 1.0))] = inside[-1] = False  # change of level, end
    # at least 133 rows a cycle: the highest lies within half of one of them
    rough = 3.0 * (1.0 - np.cos(np.pi / 133.0))
    swing = np.stack([level, 2.0 * level], axis=1)[inside]
    np.testing.assert_allclose(envelope.swing[inside], swing, atol=2.0 * rough)
    middle = 0.5 * (envelope.highest + envelope.lowest)[inside]
    np.testing.assert_allclose(middle, [[0.0, 5.0]] * inside.sum(), atol=2.0 * rough)
    fastest = 4.0 * level[inside]
    np.testing.assert_allclose(envelope.fastest[inside, 1], fastest, atol=4.0 * rough)
    normal = 1.0 - 0.5 * level[inside]
    np.testing.assert_allclose(envelope.normal_smallest[inside, 0], normal, atol=rough)


def test_cycles_end_where_the_drive_goes_up_through_zero() -> None:
    envelope = of(cut(history(), []))

    time = envelope.time[:-1]
    turned = SweptSine(0.0, 0.0, 2.0, 2.0, 10.0, 30.0)
    upward = time[time < 1.99]
    phase = 2.0 * np.pi * 10.0 * np.expm1(turned.rate * upward) / turned.rate
    behind = -phase % (2.0 * np.pi)
    # the last row of a cycle, at most one row before its end
    assert behind.max() < 2.0 * np.pi * 30.0 * LOADS.duration / ROWS * 1.001
    np.testing.assert_allclose(
        envelope.frequency[: len(upward)],
        2.0 * np.pi * turned.frequency(upward),
        rtol=1e-12,
    )
    np.testing.assert_array_equal(envelope.of("input"), envelope.time)
    np.testing.assert_allclose(envelope.closing_error, 0.25)


@pytest.mark.parametrize("edges", [[1], [17, 18, 9000], list(range(500, ROWS, 500))])
def test_cuts_between_blocks_leave_no_trace(edges: list[int]) -> None:
    whole, parts = of(cut(history(), [])), of(cut(history(), edges))

    for field in dataclasses.fields(Envelope):
        if field.name != "checkpoint":
            np.testing.assert_array_equal(
                getattr(parts, field.name), getattr(whole, field.name), field.name
            )


def test_what_comes_before_the_end_of_the_first_cycle_comes_with_it() -> None:
    first, *rest = enveloped(cut(history(), [17, 18, 9000]), LOADS.segments())

    assert first.time.size > 1
    assert sum(each.iterations for each in (first, *rest)) == ROWS
    slow = SineTest(0.0, 0.0, (Tone(0.1, 0.1, 4.0),), 0.0).segments()
    (alone,) = enveloped(cut(history(), [17]), slow)
    assert (alone.time.size, alone.iterations) == (1, ROWS)


def test_a_stopped_envelope_goes_on() -> None:
    whole = of(cut(history(), []))
    before, after = list(cut(history(), [12_345]))
    first = next(enveloped(iter([before]), LOADS.segments()))
    assert first.checkpoint is not None

    own, begun = parted(first.checkpoint)
    rest = list(enveloped(iter([after]), LOADS.segments(), begun))

    np.testing.assert_array_equal(own.memory, [7.0])
    again = joined([first, *rest], "complete")
    for name in ("time", "highest", "lowest", "fastest", "normal_largest", "energy"):
        np.testing.assert_array_equal(getattr(again, name), getattr(whole, name))


def test_errors_are_those_at_the_ends_of_the_cycles() -> None:
    whole = estimated(history())

    envelope, bare = of(cut(whole, [777, 20_000])), of(cut(history(), [777]))

    rows = np.rint(envelope.time * ROWS / LOADS.duration)
    np.testing.assert_array_equal(envelope.energy_error, rows)
    np.testing.assert_array_equal(envelope.peak_error, 2.0 * rows)
    np.testing.assert_array_equal(envelope.work_difference, -rows)
    assert bare.peak_error.size == bare.energy_error.size == 0
    np.testing.assert_array_equal(envelope.energy, bare.energy)
