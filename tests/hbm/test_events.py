"""What multipliers that are known in closed form do between two points of a curve."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import polynomial

from hbm.events import Events, Settled
from hbm.fourier import FourierBasis
from hbm.newton import Correction, Outcome
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array, ComplexArray
from systems import Dense

FOURIER = FourierBasis(1, 16)
INSIDE, OUTSIDE, SADDLE, FLIPPED = (1.6, 0.63), (2.2, 1.3), (2.1, 1.08), (-1.9, 0.88)
"""sum and product of two multipliers: 0.9 and 0.7, 1.1 ± 0.3 i, 1.2 and 0.9, −1.1 and
−0.8"""


class Line:
    """The curve x = a + 2 p, with what an adaptive balance has besides a residual."""

    fourier = settled = FOURIER

    def __init__(self, start: float) -> None:
        self.start = start

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        return np.array([point[0] - 2.0 * point[1] - self.start]), Dense([[1.0, -2.0]])

    def settle(self, correction: Correction, *_: object) -> Correction:
        """Return a point that needs nothing more."""
        return correction


class Known:
    """Multipliers along the parameter from 0 to 1, through given sums and products."""

    def __init__(self, *ways: tuple[float, float]) -> None:
        places = np.linspace(0.0, 1.0, len(ways))
        self.path = polynomial.polyfit(places, np.array(ways), len(ways) - 1)

    def at(self, point: Array, _: object = None) -> ComplexArray:
        """Return the multipliers at a point, the largest first."""
        total, product = polynomial.polyval(point[-1], self.path)
        found = np.roots([1.0, -total, product]).astype(complex)
        ordered: ComplexArray = found[np.argsort(-np.abs(found))]
        return ordered


def found(known: Known, start: float = 2.0) -> list[tuple[str, float]]:
    """Return the events between 0 and 1, and where they are."""
    line: Any = Line(start)
    resolution: Any = SimpleNamespace(amplitudes=lambda point: np.abs(point[:1]))
    multipliers: Any = known
    along = np.array([2.0, 1.0]) / np.sqrt(5.0)
    ends = []
    for parameter in (0.0, 1.0):
        point = np.array([start + 2.0 * parameter, parameter])
        residual, linearised = line(point)
        solved = Correction(
            point, residual, linearised, Outcome.CONVERGED, (0.0,), along
        )
        ends.append(Settled(solved, known.at(point), FOURIER))
    events = Events(line, resolution, StepControl(), multipliers, recalls=False)
    between = events.between(ends[0], ends[1], np.ones_like)
    return [(name, located.point[-1]) for located, name in between]


def crossing(known: Known, circle: Array) -> list[float]:
    """Return where a combination (1, sum, product) vanishes between 0 and 1."""
    combined = circle[1] * known.path[:, 0] + circle[2] * known.path[:, 1]
    combined[0] += circle[0]
    roots = polynomial.polyroots(combined)
    real = roots[np.abs(roots.imag) < 1e-12].real
    return sorted(real[(real > 0.0) & (real < 1.0)])


AT_ONE, AT_MINUS_ONE, ON_CIRCLE = np.array(
    [[1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 0.0, 1.0]]
)


@pytest.mark.parametrize(
    ("ways", "name", "circle"),
    [
        ((INSIDE, OUTSIDE), "Neimark-Sacker", ON_CIRCLE),
        ((OUTSIDE, INSIDE), "Neimark-Sacker", ON_CIRCLE),
        ((INSIDE, SADDLE), "branch point", AT_ONE),
        # a pair that has met on the real axis: one after the other
        ((OUTSIDE, SADDLE, INSIDE), "branch point", AT_ONE),
        ((INSIDE, SADDLE, OUTSIDE), "branch point", AT_ONE),
        # only one of them comes back
        ((OUTSIDE, SADDLE), "branch point", AT_ONE),
        ((INSIDE, FLIPPED), "period doubling", AT_MINUS_ONE),
    ],
)
def test_a_crossing_is_named_by_what_the_multiplier_is_there(
    ways: tuple[tuple[float, float], ...], name: str, circle: Array
) -> None:
    known = Known(*ways)
    places = crossing(known, circle)
    assert places

    events = found(known)

    assert [each for each, _ in events] == [name] * len(places)
    # located to a thousandth of the step
    np.testing.assert_allclose([place for _, place in events], places, atol=2e-3)


@pytest.mark.parametrize("start", [2.0, 0.0], ids=["moving", "from rest"])
def test_nothing_happens_where_multipliers_stay_inside(start: float) -> None:
    assert found(Known(INSIDE, (1.5, 0.6)), start) == []
