"""Responses that are gathered, of which some are taken back."""

import numpy as np

from microslip.studies.gathered import gathered
from microslip_mechanics.results.response import PeriodicResponse


def response(frequency: float, replaces: int = 0) -> PeriodicResponse:
    still, none = np.zeros((3, 1)), np.zeros(0)
    return PeriodicResponse(
        frequency,
        still,
        none,
        none,
        0.0,
        0.0,
        0.0,
        "converged",
        1,
        1,
        16,
        replaces=replaces,
    )


def test_what_is_taken_back_is_left_out_once() -> None:
    told = [response(1.0), response(2.0), response(3.0), response(2.5, replaces=2)]

    found, _ = gathered([*told, response(4.0)])
    again, ending = gathered(found)

    assert [each.frequency for each in found] == [1.0, 2.5, 4.0]
    assert [each.frequency for each in again] == [1.0, 2.5, 4.0]
    assert ending == "complete"
