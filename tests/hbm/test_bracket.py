"""Changes of sign: how exactly, and by how many values, they are found."""

from collections.abc import Callable

import numpy as np
import pytest

from hbm.continuation.bracket import bracketed

ZERO, LENGTH = 0.3712, 1.7
SMOOTH: dict[str, Callable[[float], float]] = {
    "bent": lambda place: np.exp(place) - np.exp(ZERO),
    "nearly straight": lambda place: place - ZERO + 0.05 * (place**2 - ZERO**2),
}
ROUGH: dict[str, Callable[[float], float]] = {
    "leap": lambda place: -1.0 if place < ZERO else 1e-3,
    "leap the other way": lambda place: 1.0 if place < ZERO else -1e-3,
    "root": lambda place: np.sign(place - ZERO) * np.sqrt(abs(place - ZERO)),
    "flat on one side": lambda place: place - ZERO if place > ZERO else -4e-6,
    "steep on one side": lambda place: (place - ZERO) * (1 if place < ZERO else 1e4),
}


def counted(function: Callable[[float], float], precision: float) -> tuple[float, int]:
    """Return the place that is found, and by how many values between the ends."""
    places = []

    def value(place: float) -> float:
        places.append(place)
        return function(place)

    root = bracketed(value, 0.0, LENGTH, xtol=precision * LENGTH, rtol=1e-12)
    return root, sum(0.0 < place < LENGTH for place in places)


@pytest.mark.parametrize("precision", [1e-2, 1e-3])
@pytest.mark.parametrize("function", [*SMOOTH.values(), *ROUGH.values()])
def test_a_change_of_sign_is_found_with_few_more_values_than_bisection_takes(
    function: Callable[[float], float], precision: float
) -> None:
    root, values = counted(function, precision)

    assert abs(root - ZERO) <= precision * LENGTH
    assert values <= np.ceil(np.log2(1.0 / precision)) + 1


@pytest.mark.parametrize("name", SMOOTH)
def test_smooth_functions_take_half_the_values_of_bisection(name: str) -> None:
    _, values = counted(SMOOTH[name], 1e-3)

    assert values <= 5


@pytest.mark.parametrize("name", SMOOTH)
def test_smooth_functions_are_interpolated_in_the_last_bracket(name: str) -> None:
    root, _ = counted(SMOOTH[name], 1e-2)

    assert abs(root - ZERO) <= 1e-3 * LENGTH
