"""The map of small motions over steps, beside a Padé approximation of all rows."""

import numpy as np
import pytest

from hbm.stability.carried import carried
from hbm.stability.carried_step import (
    FACTOR,
    ROOT,
    STICKING_FACTOR,
    STICKING_ROOT,
    CarriedStructure,
)
from microslip_mechanics.arrays import Array

pytestmark = pytest.mark.kernels


def matrices(rank: int, modes: int) -> tuple[Array, Array, Array]:
    """Return mass, damping and stiffness of y and modes, the latter not symmetric."""
    random = np.random.default_rng(rank + 10 * modes)
    count = rank + modes
    mass = np.eye(count)
    mass[:rank, :rank] *= 2.0
    mass[:rank, rank:] = 0.3 * random.standard_normal((rank, modes)) / count
    mass[rank:, :rank] = mass[:rank, rank:].T
    damping = 0.1 * random.standard_normal((count, count))
    stiffness = np.zeros((count, count))
    stiffness[:rank, :rank] = 4.0 * np.eye(rank)
    stiffness[range(rank, count), range(rank, count)] = random.uniform(1.0, 9.0, modes)
    return mass, damping, stiffness


@pytest.mark.parametrize(("rank", "modes"), [(3, 4), (1, 1), (2, 0), (0, 2)])
def test_steps_are_those_of_the_whole_system(rank: int, modes: int) -> None:
    random = np.random.default_rng(1)
    mass, damping, stiffness = matrices(rank, modes)
    lengths = np.array([0.1, 0.1, 0.02, 0.02, 0.3])
    sticks = np.array([False, False, True, False, False])
    elastic, viscous = random.uniform(0.0, 50.0, (2, lengths.size, rank, rank))
    structure = CarriedStructure(
        np.ascontiguousarray(mass[:rank]),
        np.ascontiguousarray(mass[rank:, :rank]),
        damping,
        np.ascontiguousarray(stiffness[:rank, :rank]),
        stiffness.diagonal()[rank:].copy(),
    )

    found = carried(structure, elastic, viscous, lengths, sticks)

    count = rank + modes
    expected, inverse = np.eye(2 * count), np.linalg.inv(mass)
    for place, length in enumerate(lengths):
        held, damped = stiffness.copy(), damping.copy()
        held[:rank, :rank] += elastic[place]
        damped[:rank, :rank] += viscous[place]
        system = np.block(
            [
                [np.zeros((count, count)), np.eye(count)],
                [-inverse @ held, -inverse @ damped],
            ]
        )
        root = STICKING_ROOT if sticks[place] else ROOT
        factor = STICKING_FACTOR if sticks[place] else FACTOR
        stage = np.linalg.solve(length * system - root * np.eye(2 * count), expected)
        kept = 0.0 if sticks[place] else 1.0
        expected = kept * expected + 2.0 * (factor * stage).real
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-11)
