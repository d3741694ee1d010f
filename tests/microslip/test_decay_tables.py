"""What is told of a free decay: digits, rounding, errors."""

import dataclasses

import numpy as np
import pytest

from microslip.commands.decay_tables import cycles, errors
from microslip_mechanics.results.ring_down import RingDown


@pytest.mark.parametrize(("damping", "told"), [(1e-14, False), (1e-4, True)])
def test_what_grows_by_rounding_is_not_told(damping: float, *, told: bool) -> None:
    still = np.ones(4)
    rises = damping * np.array([1, -1, 1, -1])
    decay = RingDown(np.arange(4.0), still, still, rises, rises)

    lines = cycles(decay, "x")

    assert ("the amplitude grows in 2 of 4 cycles" in "".join(lines)) == told


def test_damping_that_rounding_hides_has_an_absolute_error() -> None:
    still = np.ones(3)
    rounding = 1e-11 * np.array([-1, 1, -2])
    undamped = RingDown(np.arange(3.0), still, still, rounding, rounding)
    damped = dataclasses.replace(undamped, damping=0.01 * still)

    assert "-0.0000" not in "".join(cycles(undamped, "x"))
    assert errors(undamped, 1e-6, 700.0) == (
        "frequency 1.0e-06 of the largest; no damping can be measured, its ratio is "
        "off by up to 1.4e-06 %"
    )
    assert errors(damped, 1e-6, 1e-3) == (
        "frequency 1.0e-06, damping 1.0e-03, of the largest"
    )


def test_damping_of_most_cycles_is_known_though_some_beat() -> None:
    still = np.ones(9)
    decay = RingDown(np.arange(9.0), still, still, 0.01 * still)

    told = errors(decay, 1.0, 1.5, 2e-4)

    assert told.startswith(
        "frequency 1.0e+00 of the largest; damping ratio 2.0e-02 % in the median"
    )
    assert "no damping can be measured" in errors(decay, 1.0, 1.5, 5e-3)


def test_small_damping_keeps_its_digits() -> None:
    still = np.ones(2)

    few = 8.153e-7 * still, 7.2e-8 * still
    lines = cycles(RingDown(np.arange(2.0), still, still, *few), "x")

    assert lines[-1].endswith(" 8.153e-05   7.200e-06")


def test_times_of_a_fast_decay_keep_their_digits() -> None:
    still = np.ones(2)

    lines = cycles(RingDown(1e-6 * np.arange(1.0, 3.0), *[still] * 4), "x")

    assert [line.split()[0] for line in lines[3:5]] == ["1.000e-06", "2.000e-06"]
