"""A curve along a parameter does not leave the parameter's range."""

import math

import numpy as np
import pytest

from hbm.continuation.continuation import trace
from hbm.continuation.step_control import StepControl
from hbm.curves.parameter_curves import parameter_response
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from microslip.scenes.quantity import SceneError
from microslip.studies.gathered import gathered
from microslip.studies.parameter import parameter
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from systems import Dense

SLIDER = "element.slider.limit"
FREQUENCY = math.tau * 17.0


def limited(value: float) -> Problem:
    """Return the system whose slider has a limit [N] of 0 to 1."""
    if not 0.0 <= value <= 1.0:
        raise SceneError(f"{value}")
    return parameter("jenkins", (), SLIDER, "1", "0").problem_at(value)


@pytest.mark.parametrize(
    ("start", "end"),
    [(1.0, 0.0), (0.0, 1.0)],
)
@pytest.mark.long
def test_a_curve_ends_where_there_is_no_problem_any_more(
    start: float, end: float
) -> None:
    options = CurveOptions(start, end, harmonics=7, stability=False)

    curve = list(parameter_response(limited, FREQUENCY, options))

    assert curve[0].parameter == start
    assert curve[-1].parameter == end


@pytest.mark.parametrize("value", [-1e-24, 1.0 + 2e-16])
def test_rounding_may_leave_the_range(value: float) -> None:
    path = AlongParameter(limited, FREQUENCY, 1.0, 0.0)
    fourier = FourierBasis(1, 64)
    point = np.append(np.zeros(fourier.coefficients * path.rank), value)

    balance, inner = path.balance(fourier).at_frequency(point)

    assert np.isfinite(balance.residual(inner)).all()
    assert path.motions(value).mass.size


def test_what_is_traced_before_there_is_no_problem_is_kept() -> None:
    def broken(value: float) -> Problem:
        if 0.01 < value < 0.3:
            raise ValueError("the limit is broken")
        return limited(value)

    options = CurveOptions(1.0, 0.0, harmonics=3, stability=False)
    curve, ending = gathered(parameter_response(broken, FREQUENCY, options))

    assert curve[0].parameter == 1.0
    assert ending.startswith("there is no problem at parameter 0.")
    assert ending.endswith(": the limit is broken")


@pytest.mark.parametrize("value", [-0.02, 0.0, 0.3, 1.0, 1.02])
def test_the_derivatives_are_those_of_the_residual_beyond_the_range_too(
    value: float,
) -> None:
    path = AlongParameter(limited, FREQUENCY, 1.0, 0.0)
    fourier = FourierBasis(5, 256)
    balance = path.balance(fourier)
    shape = (fourier.coefficients, path.rank)
    draw = np.random.default_rng(4)
    point = np.append(1e-3 * draw.normal(size=shape).ravel(), value)

    _, linearised = balance(point)
    step = draw.normal(size=point.size) * np.append(np.full(point.size - 1, 1e-3), 1.0)
    ahead, behind = (point + sign * 1e-5 * step for sign in (1.0, -1.0))
    change = (balance.residual(ahead) - balance.residual(behind)) / 2e-5

    unknowns = np.flatnonzero(path.mask(fourier.harmonics))
    found = linearised.jacobian @ step[unknowns] + linearised.slope * step[-1]
    scale = np.abs(found).max()
    np.testing.assert_allclose(found, change[unknowns], rtol=0.0, atol=2e-3 * scale)


class Rounded(Dense):
    """A Jacobian whose solutions are off by rounding."""

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [rows; normal] d = right, but for rounding."""
        return super().solve(normal, right) + 1e-20


def test_a_curve_to_zero_ends_at_zero() -> None:
    def straight(point: Array) -> tuple[Array, Rounded]:
        return np.array([point[0] ** 2 - point[1] - 1.0]), Rounded(
            [[2.0 * point[0], -1.0]]
        )

    *_, last = trace(
        straight,
        np.array([1.3, 0.7]),
        0.0,
        metric=np.ones_like,
        control=StepControl(tolerance=1e-12),
    )

    assert last.point[-1] == 0.0
    assert last.point[0] == pytest.approx(1.0, abs=1e-12)


def test_a_curve_to_no_drive_is_not_traced_twice() -> None:
    driven = parameter("jenkins", (), "drive.x", "0.5", "0").problem_at
    options = CurveOptions(0.5, 0.0, harmonics=3, samples=256)

    found = [each.parameter for each in parameter_response(driven, FREQUENCY, options)]

    assert found[-1] == 0.0
    assert found == sorted(found, reverse=True)
