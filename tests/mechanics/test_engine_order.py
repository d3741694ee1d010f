"""Engine orders against the closed form of a ring, and what is refused."""

import re

import numpy as np
import pytest

from microslip_mechanics.loads.engine_order import EngineOrder

BLADES = 12
NAMES = tuple(f"{node}.{way}" for node in range(BLADES) for way in ("x", "z"))
LOADED = [f"{blade}.z" for blade in range(BLADES)]


@pytest.mark.parametrize("order", [0, 1, 5, 6, 7, 13, -1])
def test_a_ring_answers_with_one_wave(order: int) -> None:
    spring, tie, mass, frequency = 900.0, 400.0, 1.5, 31.0
    ring = (spring + 2.0 * tie - frequency**2 * mass) * np.eye(BLADES)
    ring -= tie * (np.roll(np.eye(BLADES), 1, 0) + np.roll(np.eye(BLADES), -1, 0))

    load = EngineOrder(LOADED, order, 3.0).load(NAMES)[1::2]

    angle = 2.0 * np.pi * order / BLADES
    own = spring + 2.0 * tie * (1.0 - np.cos(angle)) - frequency**2 * mass
    wanted = 3.0 * np.exp(1j * angle * np.arange(BLADES)) / own
    np.testing.assert_allclose(np.linalg.solve(ring, load), wanted, atol=1e-12)


def test_orders_that_differ_by_the_number_of_blades_are_the_same_load() -> None:
    one, other = (EngineOrder(LOADED, order, 1.0).load(NAMES) for order in (5, 17))

    np.testing.assert_allclose(one, other, atol=1e-12)
    assert not one[::2].any()


@pytest.mark.parametrize("order", [0, BLADES // 2, 7 * BLADES, 10**4 * BLADES + 6])
def test_blades_in_phase_or_against_each_other_have_exactly_real_loads(
    order: int,
) -> None:
    load = EngineOrder(LOADED, order, 3.0).load(NAMES)[1::2]

    assert not load.imag.any()
    np.testing.assert_array_equal(np.abs(load), 3.0)


@pytest.mark.parametrize(
    ("blades", "message"),
    [
        (
            ["3.z", "4"],
            "engine order: blade '4' is 2 degrees of freedom: give one",
        ),
        (
            ["3.z", "3.z"],
            "engine order: blade '3.z' stands there twice: give each one once",
        ),
        (
            ["99.z"],
            "engine order: blades: no degree of freedom is called '99.z': did you mean "
            "9.z?",
        ),
    ],
)
def test_an_impossible_wave_is_refused(blades: list[str], message: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        EngineOrder(blades, 2, 1.0).load(NAMES)
