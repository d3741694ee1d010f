"""Events between samples: Fourier coefficients against closed forms and quadrature."""

import dataclasses
import itertools
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from contact_tables import contact_points
from convergence import observed_order
from hbm.active import extended, moving, symmetric
from hbm.aft import AlternatingFrequencyTime
from hbm.fourier import FourierBasis, derivative, to_complex, to_real
from hbm.refinement import GAUSS_PLACES, GAUSS_WEIGHTS
from hbm.relative import RelativeProblem, relative_problem
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.law import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ContactPoints,
    contact_force,
)
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

pytestmark = pytest.mark.kernels

FREQUENCY, SPEED, LOAD, FRICTION = 11.0, 0.2, 1.7, 0.3
HARMONICS, SAMPLES = 5, 64
TURN = 2.0 * np.pi
PHASES = np.linspace(0.0, TURN / SAMPLES, 17)
"""of the motion: its events lie anywhere between two samples"""
RATIOS = [1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9]
"""of threshold and largest speed"""


@pytest.mark.parametrize("power", range(6))
def test_the_rule_between_events_is_exact_up_to_the_fifth_power(power: int) -> None:
    found = GAUSS_WEIGHTS @ GAUSS_PLACES**power

    assert found == pytest.approx(1.0 / (power + 1.0), rel=1e-14)


def sliding_point(threshold: float, **columns: float) -> ContactPoints:
    """Return a point with a constant normal load and no force across."""
    values = {"dynamic": FRICTION, "load": LOAD, "threshold": threshold} | columns
    return contact_points(1, stiffness=0.0, damping=0.0, constant_load=True, **values)


def motion(phase: float, *, mean: float = 0.0, across: float = 0.0) -> Array:
    """Return a motion with the sliding velocity V sin(θ − phase), (2H + 1, 3).

    The faces approach each other by mean + across · cos(θ − phase − 1).
    """
    moved = np.zeros((HARMONICS + 1, 3), complex)
    moved[1, 1] = -SPEED / FREQUENCY * np.exp(-1j * phase)
    moved[0, 0], moved[1, 0] = mean, across * np.exp(-1j * (phase + 1.0))
    return to_real(moved)


def coefficients(
    points: ContactPoints, moved: Array, samples: int = SAMPLES
) -> ComplexArray:
    """Return the force's amplitudes by orders, shape (H + 1, 3)."""
    fourier = FourierBasis(HARMONICS, samples)
    contact = AlternatingFrequencyTime(points, np.eye(3), fourier)
    return to_complex(contact(moved, FREQUENCY)[0])


def turned(amplitudes: ComplexArray, phase: float) -> ComplexArray:
    """Return amplitudes of what happens ``phase`` later."""
    orders = np.arange(len(amplitudes)).reshape(-1, *[1] * (amplitudes.ndim - 1))
    later: ComplexArray = amplitudes * np.exp(-1j * orders * phase)
    return later


def regularised_square_wave(ratio: float) -> ComplexArray:
    """Return the amplitudes of clip(sin θ / ratio, −1, 1), shape (H + 1,)."""
    angle, amplitudes = np.arcsin(ratio), np.zeros(HARMONICS + 1, complex)
    for order in range(1, HARMONICS + 1, 2):
        slides = np.cos(order * angle) / order
        if order == 1:
            sticks = (angle - np.sin(angle) * np.cos(angle)) / (2.0 * ratio)
        else:
            less, more = order - 1, order + 1
            sticks = (np.sin(less * angle) / less - np.sin(more * angle) / more) / (
                2.0 * ratio
            )
        amplitudes[order] = -1j * 4.0 / np.pi * (sticks + slides)
    return amplitudes


def plain(points: ContactPoints, moved: Array, samples: int) -> ComplexArray:
    """Return what equidistant samples alone make of the force, (H + 1, 3)."""
    phase = TURN * np.arange(samples) / samples
    turning = np.exp(1j * np.outer(phase, np.arange(HARMONICS + 1)))
    displacement = (turning @ to_complex(moved)).real
    velocity = FREQUENCY * (turning @ to_complex(derivative(moved))).real
    force, unused = np.zeros((samples, 3)), np.zeros((2, 3, 3))
    for place in range(samples):
        contact_force(
            points,
            0,
            displacement[place],
            velocity[place],
            force[place],
            unused[0],
            unused[1],
        )
    amplitudes = 2.0 * turning.conj().T @ force / samples
    amplitudes[0] /= 2.0
    return np.asarray(amplitudes)


def friction_errors(
    ratio: float,
    samples: int = SAMPLES,
    method: Callable[..., ComplexArray] = coefficients,
) -> Array:
    """Return the largest errors of a sliding point's amplitudes over µN, (H + 1,)."""
    points = sliding_point(ratio * SPEED)
    errors = [
        np.abs(
            method(points, motion(phase), samples)[:, 1] / (FRICTION * LOAD)
            - turned(regularised_square_wave(ratio), phase)
        )
        for phase in PHASES * SAMPLES / samples
    ]
    largest: Array = np.max(errors, axis=0)
    return largest


@pytest.mark.parametrize("ratio", RATIOS)
def test_sliding_friction_is_resolved_however_narrow_its_transition(
    ratio: float,
) -> None:
    errors = friction_errors(ratio)

    # Sharing a cell out to its ends errs by (k h)² / 12 of 4 / π k, and as much in the
    # cell of the turn: measured 1.03e-3 k.
    orders = np.arange(1, HARMONICS + 1)
    assert (errors[1:] < 1.1e-3 * orders).all()
    assert errors[0] < 1e-6


def test_the_error_of_narrow_transitions_does_not_depend_on_the_threshold() -> None:
    errors = [friction_errors(ratio).max() for ratio in RATIOS[2:]]

    assert max(errors) < 1.01 * min(errors)


@pytest.mark.parametrize("ratio", RATIOS[2:])
def test_samples_alone_err_many_times_as_much(ratio: float) -> None:
    gain = friction_errors(ratio, method=plain) / friction_errors(ratio)

    # Measured 53 at order 1 and 11 at order 5.
    assert gain[1] > 40.0
    assert gain[5] > 8.0


@pytest.mark.parametrize("ratio", [1e-1, 1e-3, 1e-9])
def test_located_events_err_with_second_order(ratio: float) -> None:
    samples = [32, 64, 128, 256]

    errors = [friction_errors(ratio, each).max() for each in samples]

    found = observed_order([1.0 / each for each in samples], errors)
    assert found == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize("mean", [0.003, -0.003, 0.012])
def test_the_mean_tangent_is_the_share_of_the_period_in_contact(mean: float) -> None:
    across, stiffness = 0.02, 7.0
    points = contact_points(
        friction=FRICTIONLESS, exponent=1.0, damping=0.0, stiffness=stiffness
    )
    contact = AlternatingFrequencyTime(
        points, np.eye(3), FourierBasis(HARMONICS, SAMPLES)
    )

    shares = []
    for phase in PHASES:
        contact(motion(phase, mean=mean, across=across), FREQUENCY)
        shares.append(contact.spectra(0)[0][0, 0, 0] / stiffness)

    # A place between two samples is off by an eighth of the cell's curvature: 2e-4.
    exact = np.arccos(-mean / across) / np.pi
    np.testing.assert_allclose(shares, exact, rtol=0.0, atol=4e-4)


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_mean_damping_is_the_share_of_the_period_that_sticks(ratio: float) -> None:
    points = sliding_point(ratio * SPEED)
    contact = AlternatingFrequencyTime(
        points, np.eye(3), FourierBasis(HARMONICS, SAMPLES)
    )

    shares = []
    for phase in PHASES:
        contact(motion(phase), FREQUENCY)
        damper = FRICTION * LOAD / (ratio * SPEED)
        shares.append(contact.spectra(0)[1][1, 1, 0] / damper)

    # The velocity is linear within a cell: its slope is off by (h / 2)² / 6, 4e-4.
    exact = 2.0 * np.arcsin(ratio) / np.pi
    np.testing.assert_allclose(shares, exact, rtol=2e-3)


def by_quadrature(
    points: ContactPoints, moved: Array, kinks: list[float]
) -> ComplexArray:
    """Return the force's amplitudes by adaptive quadrature between its kinks."""
    orders = np.arange(HARMONICS + 1)
    displacing, moving = to_complex(moved), to_complex(derivative(moved))
    force, unused = np.zeros(3), np.zeros((2, 3, 3))

    def at(phase: float) -> Array:
        turning = np.exp(1j * orders * phase)
        displacement = (turning @ displacing).real
        velocity = FREQUENCY * (turning @ moving).real
        contact_force(points, 0, displacement, velocity, force, unused[0], unused[1])
        return force

    places = sorted({0.0, TURN, *(kink % TURN for kink in kinks)})
    amplitudes = np.zeros((HARMONICS + 1, 3), complex)
    for axis in range(3):
        for order in orders:
            for start, end in itertools.pairwise(places):
                for part, wave in ((1.0, np.cos), (-1j, np.sin)):
                    value, _ = quad(
                        lambda x, a=axis, k=order, w=wave: at(x)[a] * w(k * x),
                        start,
                        end,
                        epsabs=1e-10,
                        epsrel=1e-10,
                        limit=200,
                    )
                    share = 1.0 if order == 0 else 2.0
                    amplitudes[order, axis] += share * part * value / TURN
    return amplitudes


def turns(threshold: float, phase: float, wide: float = 0.0) -> list[float]:
    """Return where V sin(θ − phase) passes ± the threshold, and a speed beyond."""
    angles = [np.arcsin(threshold / SPEED), np.arcsin(min(wide / SPEED, 1.0))]
    return [
        phase + half + sign * angle
        for angle in angles
        for half in (0.0, np.pi)
        for sign in (-1.0, 1.0)
    ]


@pytest.mark.parametrize(("threshold", "stribeck"), [(1e-3, 0.05), (1e-6, 0.01)])
def test_falling_friction_is_that_of_quadrature(
    threshold: float, stribeck: float
) -> None:
    points = sliding_point(
        threshold, friction=GENERAL_KINETIC, static=0.6, stribeck=stribeck
    )
    moved, errors = motion(0.037), []
    exact = by_quadrature(points, moved, turns(threshold, 0.037, 3.0 * stribeck))

    samples = [128, 256, 512]
    errors = [np.abs(coefficients(points, moved, n) - exact).max() for n in samples]

    # Twice the samples, a quarter of the error at least where they resolve the fall.
    assert errors[0] < 1e-2 * 0.6 * LOAD
    assert errors[2] < errors[0] / 10.0


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("law", [FRICTIONLESS, COULOMB])
def test_faces_that_separate_are_those_of_quadrature(law: int, exponent: float) -> None:
    mean, across, threshold = 0.003, 0.02, 1e-4
    points = contact_points(
        friction=law, exponent=exponent, stiffness=1e3, threshold=threshold
    )
    moved = motion(0.041, mean=mean, across=across)
    opens = [1.041 + sign * np.arccos(-mean / across) for sign in (-1.0, 1.0)]
    exact = by_quadrature(points, moved, [*opens, *turns(threshold, 0.041)])

    samples = [64, 128, 256, 512]
    errors = [np.abs(coefficients(points, moved, n) - exact).max() for n in samples]

    # The root of Hunt and Crossley's damping falls with order 3/2, all else with 2.
    assert errors[0] < 1e-2 * np.abs(exact).max()
    order = observed_order([1.0 / each for each in samples], errors)
    assert order > 1.4


def steps_of(
    points: ContactPoints, samples: int, *, mean: float = 0.0, across: float = 0.0
) -> Array:
    """Return how the amplitudes change while the motion's phase passes a sample.

    Relative to the force, over 2000 steps, seen from the motion: (steps,).
    """
    phases = np.linspace(0.0, TURN / samples, 2001)
    seen = np.array(
        [
            turned(
                coefficients(points, motion(phase, mean=mean, across=across), samples),
                -phase,
            )
            for phase in phases
        ]
    )
    away: Array = np.abs(np.diff(seen, axis=0)).max(axis=(1, 2)) / np.abs(seen).max()
    return away


@pytest.mark.parametrize("samples", [64, 128])
def test_sharp_turns_that_pass_a_sample_change_the_force_smoothly(samples: int) -> None:
    steps = steps_of(sliding_point(1e-7 * SPEED), samples)

    # Without location half a cell of friction would jump: 4 / samples.
    assert steps.max() < 1e-3 / samples
    assert steps.max() < 5.0 * np.median(steps)


@pytest.mark.parametrize("ratio", [0.05, 0.2])
def test_slow_turns_that_pass_a_sample_do_not_make_the_force_jump(
    ratio: float,
) -> None:
    points = sliding_point(ratio * SPEED)

    jumps = [steps_of(points, samples).max() for samples in (64, 128)]

    # A cell with an event adds what a cell without has, to third order: shares that are
    # not made up for linear sharing would jump by 8e-3.
    assert jumps[0] < 1e-6
    assert jumps[1] < jumps[0] / 8.0


@pytest.mark.parametrize(("exponent", "order"), [(1.5, 2.5), (2.0, 3.0)])
def test_kinks_that_pass_a_sample_make_small_jumps(
    exponent: float, order: float
) -> None:
    points = contact_points(friction=FRICTIONLESS, exponent=exponent, damping=0.0)

    jumps = [
        steps_of(points, samples, mean=0.003, across=0.02).max()
        for samples in (64, 128, 256)
    ]

    # What differs is a force of δ^p over a cell, order p + 1; a linear one is the same.
    assert jumps[0] < 3e-4
    assert observed_order([1.0, 0.5, 0.25], jumps) == pytest.approx(order, abs=0.3)


def test_a_linear_touch_that_passes_a_sample_does_not_make_the_force_jump() -> None:
    points = contact_points(friction=FRICTIONLESS, exponent=1.0, damping=0.0)

    assert steps_of(points, 64, mean=0.003, across=0.02).max() < 1e-7


def rig(
    **overrides: object,
) -> tuple[RelativeProblem, RelativeProblem, NDArray[np.bool_]]:
    """Return a rig by half periods and by whole ones, and what of it moves."""
    problem = rig_problem(**overrides)
    whole = relative_problem(problem, static_equilibrium(problem))
    active = moving(whole, FREQUENCY)
    kept, odd = symmetric(active)
    assert odd is not None
    half = whole.restricted(kept, odd)
    return half, dataclasses.replace(half, odd=None), active[:, kept]


@pytest.mark.parametrize("samples", [64, 66, 256])
@pytest.mark.parametrize("law", ["coulomb", "gkf"])
@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_half_a_period_says_all_of_the_rig(model: str, law: str, samples: int) -> None:
    half, whole, active = rig(model=model, friction__law=law)
    fourier, draw = FourierBasis(HARMONICS, samples), np.random.default_rng(7)
    one, other = half.contact(fourier), whole.contact(fourier)
    moves = extended(active, HARMONICS)

    for size in np.geomspace(1e-7, 1e-3, 40):
        moved = size * draw.standard_normal(moves.shape) * moves
        moved[0] = half.rest * draw.uniform(0.5, 1.5)
        force, by_frequency = one(moved, FREQUENCY)
        expected, expected_by_frequency = other(moved, FREQUENCY)

        unit = np.abs(expected).max()
        np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-11 * unit)
        unit = np.abs(expected_by_frequency).max()
        np.testing.assert_allclose(
            by_frequency, expected_by_frequency, rtol=0.0, atol=1e-11 * unit
        )
        for found, exact in zip(
            one.spectra(HARMONICS), other.spectra(HARMONICS), strict=True
        ):
            unit = np.abs(exact).max()
            np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-10 * unit)
        seen, cycle = (each.cycle(moved, FREQUENCY) for each in (one, other))
        assert seen.friction == pytest.approx(cycle.friction, rel=1e-9)


@pytest.mark.parametrize("share", [-0.9, -0.5, -0.1, 0.1, 0.5])
def test_a_turn_in_the_last_cell_of_half_a_period_is_shared_with_its_first(
    share: float,
) -> None:
    points, basis = sliding_point(1e-3 * SPEED), np.eye(3)[:, 1:2]
    phase = share * TURN / SAMPLES
    moved, fourier = motion(phase)[:, 1:2], FourierBasis(HARMONICS, SAMPLES)

    force, tangents = [], []
    for odd in (np.array([True]), None):
        contact = AlternatingFrequencyTime(points, basis, fourier, odd=odd)
        force.append(contact(moved, FREQUENCY)[0])
        tangents.append(contact.spectra(2 * HARMONICS)[1])

    np.testing.assert_allclose(force[0], force[1], rtol=0.0, atol=1e-14)
    unit = np.abs(tangents[1]).max()
    np.testing.assert_allclose(tangents[0], tangents[1], rtol=0.0, atol=1e-13 * unit)
