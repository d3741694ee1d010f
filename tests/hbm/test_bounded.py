"""How far a response may grow along its curve."""

from collections.abc import Iterator

import numpy as np
import pytest

from hbm.continuation.correction import Correction, Outcome
from hbm.curves.bounded import LARGEST, bounded
from hbm.errors import UnboundedError
from microslip_mechanics.arrays import Array
from systems import Dense


def way(*sizes: float) -> Iterator[Correction]:
    """Yield points at 1, 2, … of one coordinate, whose vibration has these sizes."""
    for place, size in enumerate(sizes, start=1):
        point = np.array([7.0, size, 0.0, place])
        nothing = Dense(np.zeros((3, 4)))
        yield Correction(point, np.zeros(3), nothing, Outcome.CONVERGED, (0.0,))


def vibration(point: Array) -> float:
    return float(abs(point[1]))


def test_a_response_may_grow_by_what_damping_leaves() -> None:
    found = list(bounded(way(0.0, 1.0, 0.1, 0.05 * LARGEST, 2.0), 1, vibration))

    assert [each.point[-1] for each in found] == [1.0, 2.0, 3.0, 4.0, 5.0]


def test_where_a_response_grows_beyond_it_is_not_bounded() -> None:
    points = bounded(way(1.0, 0.1, 0.2 * LARGEST, 1.0), 1, vibration)

    found = [next(points), next(points)]

    assert len(found) == 2
    with pytest.raises(UnboundedError, match="not bounded") as caught:
        next(points)
    assert caught.value.parameter == 3.0


def test_a_slip_that_grows_alone_is_bounded() -> None:
    found = list(bounded(way(1e-3, 1e3 * LARGEST), 1, lambda _: 1.0))

    assert len(found) == 2
