"""Rigid Coulomb friction in harmonic balance, against closed forms."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hbm.balance.relative import RelativeProblem
from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.balance.rigid import with_pushes
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.curves.parameter_curves import fold_curve
from hbm.curves.periodic_response import periodic_response
from hbm.forces.equivalent import equivalent_contact
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.structure.tractions import PushedStructure
from law_examples import NAMES, PRESSED, SLIDING, driven
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system

ALONG_X: dict[str, Any] = {"tangents": [("x", "ground")]}


def block(
    *limits: float, stiffness: float = 1.0, damping: float = 0.0, preload: float = 0.0
) -> Problem:
    """Return 1 kg on a spring, driven by 1 N, with sliders of these limits."""
    return system(
        mass=[1.0],
        stiffness=[[stiffness]],
        damping=[[damping]],
        names=("x",),
        elements=[
            Element(RigidCoulomb(mu=0.5, load=2.0 * limit), **ALONG_X)
            for limit in limits
        ],
        drive={"x": 1.0},
        preload={"x": preload},
    )


def response(
    problem: Problem, frequency: float, harmonics: int = 31, samples: int = 512
) -> PeriodicResponse:
    options = CurveOptions(
        frequency, 1.001 * frequency, harmonics=harmonics, samples=samples
    )
    return next(frequency_response(problem, static_equilibrium(problem), options))


def highest(found: PeriodicResponse) -> float:
    """Return the largest deflection."""
    phase = 2.0 * np.pi * np.arange(8192) / 8192
    return float(found.at(phase)[0][:, 0].max())


def den_hartog(frequency: float, limit: float) -> tuple[float, complex]:
    """Return peak and first harmonic without stops (Den Hartog, 1931).

    Of 1 kg on 1 N/m under 1 N that goes with the sine.
    """
    answer, turn = 1.0 / (1.0 - frequency**2), np.pi / frequency
    loss = limit * np.sin(turn) / (frequency * (1.0 + np.cos(turn)))
    peak = np.sqrt(answer**2 - loss**2)
    ahead = (peak - 1j * loss) / answer  # of the drive before the peak
    square = 4j / np.pi * limit  # friction, a quarter of a period before the peak
    return float(peak), complex(-1j * answer * (1.0 - square / ahead))


@pytest.mark.parametrize("frequency", [0.7, 1.3, 1.6])
@pytest.mark.parametrize("limit", [0.2, 0.5])
def test_motion_without_stops_is_den_hartogs(frequency: float, limit: float) -> None:
    peak, first = den_hartog(frequency, limit)
    found = response(block(limit), frequency)
    cosine, sine = found.coefficients[1:3, 0]

    assert highest(found) == pytest.approx(peak, rel=2e-4)
    assert abs(cosine - 1j * sine - first) < 2e-4 * abs(first)
    assert found.friction_energy == pytest.approx(4.0 * limit * peak, rel=3e-4)
    # stability is not known
    assert found.unstable == -1


def test_den_hartogs_amplitude_is_approached_with_the_square_of_the_order() -> None:
    peak, _ = den_hartog(1.3, 0.5)
    errors = [
        abs(highest(response(block(0.5), 1.3, harmonics, 4096)) / peak - 1.0)
        for harmonics in (3, 7, 15, 31)
    ]
    assert errors[0] < 2e-3
    assert np.all(np.diff(np.log2(errors)) < -1.7), errors


def test_samples_are_of_second_order() -> None:
    amplitude = [
        np.hypot(*response(block(0.5), 1.3, 7, count).coefficients[1:3, 0])
        for count in (32, 64, 128, 4096)
    ]
    errors = np.abs(np.array(amplitude[:3]) / amplitude[3] - 1.0)
    assert errors[0] < 1e-2
    assert np.all(np.diff(np.log2(errors)) < -1.5), errors


def test_too_small_a_drive_moves_nothing_and_leaves_the_mean_to_the_preload() -> None:
    found = response(block(1.3, stiffness=4.0, preload=0.8), 0.7)
    assert np.hypot(*found.coefficients[1:3, 0]) < 1e-8
    assert found.friction_energy < 1e-8
    # the rule: a contact that never slides carries no mean force
    assert found.coefficients[0, 0] == pytest.approx(0.8 / 4.0, rel=1e-6)


def test_a_slider_that_slips_both_ways_has_no_free_position() -> None:
    found = response(block(0.5, stiffness=4.0, preload=0.8), 0.7)
    assert found.friction_energy > 0.1
    assert found.coefficients[0, 0] == pytest.approx(0.8 / 4.0, rel=1e-6)


@pytest.mark.parametrize("limit", [0.3, 0.9])
def test_circular_sliding_has_its_closed_form(limit: float) -> None:
    problem = system(
        mass=[1.0, 1.0],
        stiffness=np.diag([3.0, 3.0]).tolist(),
        names=("x", "y"),
        elements=[Element(RigidCoulomb(mu=1.0, load=limit), **SLIDING)],
        drive={"x": 1.0},
    )
    round_about = replace(problem, drive=np.array([1.0, 1j]))
    found = response(round_about, 0.9, 3, 256)
    radius = np.sqrt(1.0 - limit**2) / (3.0 - 0.9**2)
    amplitude = np.hypot(*found.coefficients[1:3])
    assert amplitude == pytest.approx([radius, radius], rel=2e-4)
    assert found.friction_energy == pytest.approx(
        2.0 * np.pi * radius * limit, rel=2e-4
    )


def test_a_heavy_second_tangent_costs_no_accuracy() -> None:
    heavy = 1e3
    problem = system(
        mass=[1.0, heavy],
        stiffness=[[1.0, 0.0], [0.0, heavy]],
        damping=[[0.02, 0.0], [0.0, 0.02 * heavy]],
        names=("x", "y"),
        elements=[
            Element(
                RigidCoulomb(mu=0.5, load=0.6),
                tangents=[("x", "ground"), ("y", "ground")],
            )
        ],
        drive={"x": (1.0, 0.0), "y": (3.0, 1.2)},
    )

    few, many = (
        response(problem, 0.8, harmonics, 64 * harmonics).coefficients[1:3]
        for harmonics in (7, 63)
    )

    # with the heavier one's mass 5e-3
    assert np.abs(few - many).max() < 5e-4 * np.abs(many).max()


def test_two_sliders_side_by_side_are_one_of_both_limits() -> None:
    for frequency in (0.4, 1.3):
        one = response(block(0.6, damping=0.04), frequency)
        two = response(block(0.45, 0.15, damping=0.04), frequency)
        np.testing.assert_allclose(two.coefficients, one.coefficients, atol=1e-6)


def weighted(problem: Problem, weight: float, fourier: FourierBasis) -> Array:
    """Return the amplitudes with other sliding masses in the time domain."""
    frequency = 6.5
    relative = relative_problem(problem, static_equilibrium(problem))
    balance = HarmonicBalance(
        _weighted(with_pushes(relative, frequency), weight), fourier
    )
    still = balance.point(balance.problem.rest[None, :], frequency)
    normal = np.eye(still.size)[-1]
    found = correct(balance, still, normal, tolerance=1e-9, max_iterations=60)
    assert found.outcome is Outcome.CONVERGED
    motion = balance.motion(found.point)
    amplitudes: Array = np.hypot(motion[1], motion[2])
    return amplitudes


def _weighted(pushes: RelativeProblem, weight: float) -> RelativeProblem:
    """Return a problem whose sliding masses are so many times as heavy."""
    own, structure = pushes.tractions, pushes.condensed
    assert own is not None
    assert isinstance(structure, PushedStructure)
    other = replace(own, scale=weight * own.scale, mass=weight * own.mass)
    table = pushes.points._replace(tangential=weight * pushes.points.tangential)
    condensed = PushedStructure(structure.inner, other)
    return replace(pushes, points=table, condensed=condensed, tractions=other)


def test_the_sliding_mass_is_a_numerical_parameter() -> None:
    problem = driven("rigid coulomb")
    apart = []
    for fourier in (FourierBasis(7, 512), FourierBasis(31, 2048)):
        own, light, heavy = (
            weighted(problem, weight, fourier) for weight in (1.0, 0.5, 2.0)
        )
        apart.append(max(np.abs(other - own).max() for other in (light, heavy)))
        apart[-1] /= own.max()
    assert apart[0] < 2e-2
    assert apart[1] < 2e-3
    assert apart[1] < 0.35 * apart[0]


@pytest.mark.parametrize(
    ("law", "directions"),
    [
        (RigidCoulomb(mu=0.3, load=2.0), ALONG_X),
        (RigidCoulomb(mu=0.3, load=2.0), SLIDING),
        (RigidCoulomb(mu=0.3, normal_stiffness=30.0, preload=8.0), PRESSED),
    ],
    ids=["one tangent", "two tangents", "variable load"],
)
def test_jacobian_is_that_of_differences(
    law: RigidCoulomb, directions: dict[str, Any]
) -> None:
    problem = system(
        mass=[1.0, 1.1, 0.9],
        stiffness=[[60.0, -4.0, 0.0], [-4.0, 66.0, -3.0], [0.0, -3.0, 70.0]],
        damping_ratio=0.03,
        names=NAMES,
        elements=[Element(law, **directions)],
        drive={"x": 1.5, "y": 0.4, "z": 0.6},
    )
    relative = relative_problem(problem, static_equilibrium(problem))
    balance = HarmonicBalance(with_pushes(relative, 8.0), FourierBasis(4, 128))
    point = balance.point(balance.problem.rest[None, :], 7.0)
    point[:-1] += 0.03 * np.random.default_rng(1).normal(size=point.size - 1)
    _, linearised = balance(point)
    exact = np.column_stack([linearised.jacobian, linearised.slope])
    sliding = balance.contact.moved[0]
    assert np.abs(sliding[1]).max() * balance.contact.points.tangential[0] > 0.6
    scale = np.abs(exact).max()
    for column in range(point.size):
        step = np.zeros(point.size)
        step[column] = 1e-6
        high = balance.residual(point + step)
        low = balance.residual(point - step)
        slope = (high - low) / 2e-6
        np.testing.assert_allclose(exact[:, column], slope, atol=1e-6 * scale)


def test_a_response_is_found_again_with_more_harmonics() -> None:
    problem = driven("rigid coulomb, variable load")
    coarse = response(problem, 6.5, 7, 256)
    fine = periodic_response(
        problem, static_equilibrium(problem), coarse, harmonics=15, samples=512
    )
    near = np.abs(fine.coefficients[:3] - coarse.coefficients[:3]).max()
    assert near < 2e-3 * np.abs(coarse.coefficients[1:3]).max()


def test_what_needs_a_force_of_the_motion_refuses_rigid_friction() -> None:
    problem = block(0.5)
    with pytest.raises(MicroslipError, match="threshold_velocity"):
        equivalent_contact(problem, response(problem, 1.3))


def rubbing_duffing(drive: float) -> Problem:
    """Return a cubic oscillator on a slider without elasticity."""
    return system(
        mass=[1.0],
        stiffness=[[1e3]],
        damping_ratio=0.005,
        names=("x",),
        elements=[
            Element(CubicSpring(cubic=5e7), between=("x", "ground")),
            Element(RigidCoulomb(mu=0.5, load=0.05), **ALONG_X),
        ],
        drive={"x": drive},
    )


@pytest.mark.long
@pytest.mark.parametrize("error", [1e-2, 1e-3])
def test_folds_of_rigid_friction_are_found_and_followed(error: float) -> None:
    hertz = 2.0 * np.pi
    problem = rubbing_duffing(0.1)
    options = CurveOptions(4.0 * hertz, 8.0 * hertz, error=error)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    folds = [point for point in curve if point.event == "fold"]
    found = [point.frequency / hertz for point in folds]
    # with a tolerance of 1e-4
    assert found == pytest.approx([6.951767, 5.343105], rel=10.0 * error**2)

    along = CurveOptions(0.1, 0.12, harmonics=15)
    last = list(fold_curve(rubbing_duffing, folds[0], along))[-1]

    # of the curve at 0.12 N
    assert last.response.frequency / hertz == pytest.approx(7.593278, rel=1e-4)
    assert last.unstable == -1
