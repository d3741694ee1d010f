"""What an orbit of harmonic balance and one by shooting say of each other."""

from dataclasses import replace

import numpy as np
import pytest

from small_problems import prescribed, sliding_block
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.comparison import (
    FLOOR,
    MULTIPLIER_FLOOR,
    Comparison,
    compared,
)
from timedomain.shooting.shooting import ShootingOptions


def comparison(
    *,
    amplitudes: tuple[float, float] = (1.0, 1.0),
    errors: tuple[float, float] = (0.0, 0.0),
    multipliers: tuple[float, float] = (0.5, 0.5),
    multiplier_error: float = 0.0,
) -> Comparison:
    """Return one of a single probe, by harmonic balance and by shooting."""
    predicted, found = (np.array([each]) for each in amplitudes)
    return Comparison(
        prescribed(1.0),
        predicted,
        found,
        *errors,
        np.array([0.0, 3e-3, 0.0, 2e-2, 1e-3]),
        *multipliers,
        multiplier_error,
        1024,
    )


@pytest.mark.parametrize(
    ("balance", "shot", "error", "alike"),
    [
        (0.9, 0.5, 0.0, True),
        (1.1, 1.5, 0.0, True),
        (0.9, 1.1, 0.1, False),
        (1.1, 0.9, 0.1, False),
        # on two sides of 1, nearer to each other than shooting can tell
        (0.99, 1.02, 0.04, True),
        (1.02, 0.99, 0.04, True),
        (1.0 - 0.4 * MULTIPLIER_FLOOR, 1.0 + 0.4 * MULTIPLIER_FLOOR, 0.0, True),
        (1.0 - 0.6 * MULTIPLIER_FLOOR, 1.0 + 0.6 * MULTIPLIER_FLOOR, 0.0, False),
        (0.0, 1.5, 0.0, True),  # harmonic balance does not know
    ],
)
def test_both_say_the_same_of_the_stability(
    balance: float, shot: float, error: float, alike: bool
) -> None:
    found = comparison(multipliers=(balance, shot), multiplier_error=error)

    assert found.as_stable is alike


@pytest.mark.parametrize(
    ("apart", "estimated", "agrees"),
    [
        # estimates of 0.01 and 0.02, the first of which may be three times too small
        (0.029, True, True),
        (0.031, False, True),
        (0.049, False, True),
        (0.051, False, False),
    ],
)
def test_amplitudes_agree_within_both_estimates(
    apart: float, estimated: bool, agrees: bool
) -> None:
    for sign in (-1.0, 1.0):
        amplitudes = (3.0 * (1.0 + sign * apart), 3.0)
        found = comparison(amplitudes=amplitudes, errors=(0.01, 0.02))

        assert found.difference == pytest.approx(apart)
        assert (found.as_estimated, found.agrees) == (estimated, agrees)
    assert comparison(amplitudes=(1.0 + 0.9 * FLOOR, 1.0)).as_estimated


def test_the_worst_orders_are_those_that_differ_most() -> None:
    found = comparison()
    more, few = (
        replace(found, harmonics=np.array(differences))
        for differences in ([1e-4, 3e-3, 2e-4, 2e-2, 1e-3], [0.0, 1e-3, 0.0])
    )

    assert more.worst() == [3, 1, 4]
    assert few.worst() == [1]  # the others do not differ


@pytest.mark.parametrize(
    ("enough", "lost", "tried"),
    [
        (1024, 0, [512]),
        (4096, 0, [512, 1024, 2048]),
        (8192, 0, [512, 1024, 2048]),  # that is the most
        (4096, 1024, [512, 1024]),
    ],
)
def test_shorter_steps_are_tried_while_both_differ_on_stability(
    enough: int, lost: int, tried: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []

    def made(_: object, __: object, options: ShootingOptions) -> Comparison:
        asked.append(options.steps)
        if options.steps == lost:
            raise ShootingError("no orbit")
        finer = 2 * options.steps
        by_shooting = 0.6 if finer >= enough else 1.5
        return replace(comparison(multipliers=(0.5, by_shooting)), steps=finer)

    monkeypatch.setattr("timedomain.shooting.comparison._compared", made)
    problem, options = sliding_block(), ShootingOptions(steps=512, most=4096)

    found = compared(problem, prescribed(1.0), options)

    assert asked == tried
    assert found.as_stable == (enough <= 4096 and not lost)
