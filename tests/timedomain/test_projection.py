"""Steps with thresholds far below their changes of velocity: stuck, sliding, both."""

import numpy as np
import pytest

from contact_tables import FRICTION_LAWS
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from small_problems import from_rest, sliding_block
from timedomain.integrate import MarchOptions, integrate

FREQUENCY, PERIODS, STEPS = 9.0, 4, 400
LOAD, FRICTION = 1.7, 0.3


def block(*, threshold: float, drive: float, **changed: float) -> Problem:
    values = {"dynamic": FRICTION, "static": FRICTION, "stiffness": 300.0}
    return sliding_block(
        load=LOAD, threshold=threshold, drive=drive, **{**values, **changed}
    )


def marched(problem: Problem, steps: int = STEPS) -> TimeHistory:
    period = 2.0 * np.pi / FREQUENCY
    options = MarchOptions(period / steps, 1, method="reference", residual=1e-12)
    blocks = integrate(
        problem,
        Dwell(FREQUENCY, PERIODS * period),
        options,
        start=from_rest(problem),
    )
    return joined(list(blocks), "complete")


@pytest.mark.parametrize(
    ("threshold", "dynamic"), [(1e-9, FRICTION), (1e-12, FRICTION), (1e-3, 1e6)]
)
@pytest.mark.parametrize("law", ["coulomb", "gkf"])
def test_what_sticks_creeps_and_no_step_is_divided(
    law: str, threshold: float, dynamic: float
) -> None:
    drive = 0.5 * FRICTION * LOAD
    problem = block(
        threshold=threshold,
        drive=drive,
        dynamic=dynamic,
        static=dynamic,
        friction=FRICTION_LAWS[law],
    )

    history = marched(problem)

    # a dashpot µN/V_lim moves by this under the drive, and twice of it from rest
    creep = drive * threshold / (dynamic * LOAD * FREQUENCY)
    assert history.divided == 0
    assert np.abs(history.displacement).max() == pytest.approx(2.0 * creep, rel=0.02)


def pushed(drive: float, rows: int) -> Array:
    """Return the motion under rigid friction, by steps so short that any rule does.

    A step's friction stops the block if it can.
    """
    mass, stiffness, limit, fine = 2.0, 300.0, FRICTION * LOAD, 200
    step = PERIODS * 2.0 * np.pi / FREQUENCY / (rows * fine)
    moved, moving, found = 0.0, 0.0, []
    for number in range(rows * fine):
        force = drive * np.sin(FREQUENCY * (number + 0.5) * step)
        force -= stiffness * (moved + 0.5 * step * moving)
        free = moving + step * force / mass
        slowed = min(abs(free), step * limit / mass)
        after = free - np.copysign(slowed, free)
        moved, moving = moved + 0.5 * step * (moving + after), after
        if (number + 1) % fine == 0:
            found.append(moved)
    return np.array(found)


def test_what_sticks_and_slips_moves_as_rigid_friction_lets_it() -> None:
    problem, drive = block(threshold=1e-9, drive=3.0), 3.0
    exact = pushed(drive, PERIODS * STEPS)
    histories = [marched(problem, times * STEPS) for times in (1, 2)]

    errors = [
        np.abs(each.displacement[times - 1 :: times, 0] - exact).max()
        for times, each in enumerate(histories, 1)
    ]
    assert [each.divided for each in histories] == [0, 0]
    assert errors[1] < 0.65 * errors[0] < 0.65 * 2e-3 * np.abs(exact).max()
