"""A step to more harmonics begins at the last point as these have it."""

import itertools
from collections.abc import Sequence

import numpy as np
import pytest

from bending_mass import bending_mass
from hbm.continuation.lifted import lifted
from hbm.continuation.linearised import System
from hbm.continuation.predictor import Predictor
from hbm.continuation.settler import Unsettled
from hbm.continuation.step_control import StepControl
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from systems import Dense

SPRINGS = (
    (-603.0, 22790.7, 0.03406, 0.80695),
    (118.68, 5600.7, 0.006856, 1.06714),
    (415.21, 4218.8, 0.03487, 2.16993),
)
CONTROL = StepControl(initial=0.1, largest=0.2, tolerance=1e-10)


def curve(spring: Sequence[float], error: float) -> list[PeriodicResponse]:
    """Return the curve about half of the natural frequency, which has no fold there."""
    problem = bending_mass(*spring)
    options = CurveOptions(4.0, 25.0, error=error, stability=False)
    points = frequency_response(problem, static_equilibrium(problem), options)
    return list(itertools.takewhile(lambda each: each.frequency < 5.6, points))


@pytest.mark.parametrize("error", [2e-2, 5e-3, 1e-3])
@pytest.mark.parametrize("spring", SPRINGS)
def test_a_resonance_of_the_second_harmonic_is_passed_at_the_usual_pace(
    spring: Sequence[float], error: float
) -> None:
    # with one harmonic there is none: with three the curve seems to turn sharply
    finest = curve(spring, 1e-6)

    found = curve(spring, error)

    assert (np.diff([each.frequency for each in found if not each.event]) > 0.0).all()
    assert len(found) <= len(finest) + 4
    assert [each.event for each in found if each.event] == ["peak"]
    (peak,), (exact,) = (
        [each for each in made if each.event] for made in (found, finest)
    )
    assert abs(peak.frequency - exact.frequency) <= peak.parameter_error


class Finer(Unsettled):
    """What has become finer since the last point kept."""

    finer = True
    held = False

    def hold(self) -> None:
        """Note that it is asked to."""
        self.held = True


def past() -> Predictor:
    """Return that of a point at the origin which goes along the parameter."""
    made = Predictor()
    made.append(np.zeros(2), np.array([0.0, 1.0]), np.ones(2), 0.0)
    return made


def line(aside: float, slope: float) -> System:
    """Return the line x = aside + slope p of points (x, p)."""

    def system(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        return np.array([x - aside - slope * parameter]), Dense([[1.0, -slope]])

    return system


def test_the_last_point_moves_across_and_has_another_tangent() -> None:
    known, settler = past(), Finer()

    assert lifted(line(0.1, 3.0), known, CONTROL, settler)

    assert settler.held
    np.testing.assert_allclose(known.point, [0.1, 0.0], atol=1e-12)
    np.testing.assert_allclose(known.tangent, np.array([3.0, 1.0]) / np.sqrt(10.0))
    step = np.array([0.1, 0.0]) + 0.2 * known.tangent
    np.testing.assert_allclose(known.predict(0.2), step)


def test_a_point_that_would_be_another_branch_stays() -> None:
    known, settler = past(), Finer()

    assert not lifted(line(0.3, 0.0), known, CONTROL, settler)

    assert not settler.held
    np.testing.assert_array_equal(known.point, [0.0, 0.0])


def test_a_system_that_is_not_finer_has_the_point_as_it_is() -> None:
    assert not lifted(line(0.1, 3.0), past(), CONTROL, Unsettled())
