"""Time history: blocks joined, energies by name, the balance."""

from dataclasses import fields

import numpy as np
import pytest

from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory

ENERGIES = ("input", "kinetic", "elastic", "friction")


def block(start: int, times: int) -> TimeHistory:
    """Return a block whose every number tells where it stood in the march."""
    random = np.random.default_rng(start)
    return TimeHistory(
        time=np.arange(start, start + times) * 0.5,
        probes=("tip", "element"),
        displacement=random.normal(size=(times, 2)),
        velocity=random.normal(size=(times, 2)),
        contacts=("A", "B", "C"),
        normal_force=random.normal(size=(times, 3)),
        friction_power=random.normal(size=times),
        energies=ENERGIES,
        energy=random.normal(size=(times, len(ENERGIES))),
        stored_at_start=0.25 + start,
        time_step=0.5,
        iterations=10 * times,
        divided=times,
    )


def test_joined_blocks_follow_each_other_in_time() -> None:
    blocks = [block(0, 3), block(3, 4), block(7, 2)]

    whole = joined(blocks, "complete")

    np.testing.assert_array_equal(whole.time, 0.5 * np.arange(9))
    for first, last, part in [(0, 3, blocks[0]), (3, 7, blocks[1]), (7, 9, blocks[2])]:
        for name in ("displacement", "velocity", "normal_force", "friction_power"):
            np.testing.assert_array_equal(
                getattr(whole, name)[first:last], getattr(part, name)
            )
        np.testing.assert_array_equal(whole.energy[first:last], part.energy)


def test_joined_blocks_sum_the_work_and_keep_names_start_and_step() -> None:
    whole = joined([block(0, 3), block(3, 4)], "interrupted")

    assert (whole.iterations, whole.divided) == (70, 7)
    assert whole.ending == "interrupted"
    assert whole.stored_at_start == 0.25
    assert whole.time_step == 0.5
    assert (whole.probes, whole.contacts) == (("tip", "element"), ("A", "B", "C"))
    assert whole.energies == ENERGIES


def test_one_block_joined_is_that_block() -> None:
    alone = block(0, 5)

    whole = joined([alone], "complete")

    for field in fields(TimeHistory):
        np.testing.assert_array_equal(
            getattr(whole, field.name), getattr(alone, field.name)
        )


@pytest.mark.parametrize("name", ENERGIES)
def test_an_energy_is_found_by_its_name(name: str) -> None:
    history = block(0, 4)

    energy = history.of(name)

    np.testing.assert_array_equal(energy, history.energy[:, ENERGIES.index(name)])


def test_closing_error_is_input_plus_stored_at_start_less_all_that_became_of_it() -> (
    None
):
    history = block(0, 6)

    error = history.closing_error

    became = history.of("kinetic") + history.of("elastic") + history.of("friction")
    np.testing.assert_allclose(
        error, history.of("input") + 0.25 - became, rtol=0.0, atol=1e-14
    )
