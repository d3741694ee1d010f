"""What a notebook offers to be typed, and shows of what was typed."""

import numpy as np

import microslip
from microslip_mechanics.results.response import PeriodicResponse


def test_laws_are_among_the_names_that_are_offered() -> None:
    laws = {law.__name__ for law in microslip.LAWS.values()}

    assert laws <= set(dir(microslip))
    assert laws <= set(microslip.__all__)


def test_a_periodic_response_is_told_in_a_line() -> None:
    none = np.zeros(1)
    response = PeriodicResponse(
        2.0 * np.pi, np.ones((7, 1)), none, none, 0.0, 0.0, 0.0, "converged", 3, 3
    )

    assert repr(response) == "<PeriodicResponse: 1 Hz, 3 harmonics; converged>"
