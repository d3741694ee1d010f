"""Transitions between samples: against quadrature, and when they pass a sample."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from contact_tables import contact_points
from convergence import observed_order
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis, derivative, to_complex
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ContactPoints,
)
from sliding import (
    FREQUENCY,
    HARMONICS,
    LOAD,
    SPEED,
    TURN,
    coefficients,
    motion,
    sliding_point,
    turned,
)


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


@pytest.mark.kernels
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


@pytest.mark.kernels
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

    assert errors[0] < 1e-2 * np.abs(exact).max()
    order = observed_order([1.0 / each for each in samples], errors)
    assert order > 1.9


def steps_of(
    points: ContactPoints, samples: int, *, mean: float = 0.0, across: float = 0.0
) -> Array:
    """Return how the amplitudes change while the motion's phase passes a sample.

    Relative to the force, over 400 steps, seen from the motion: (steps,).
    """
    phases = np.linspace(0.0, TURN / samples, 401)
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


@pytest.mark.kernels
def test_a_linear_touch_that_passes_a_sample_does_not_make_the_force_jump() -> None:
    points = contact_points(friction=FRICTIONLESS, exponent=1.0, damping=0.0)

    assert steps_of(points, 64, mean=0.003, across=0.02).max() < 1e-7


@pytest.mark.parametrize("power", [0.2, 0.5])
def test_steep_damping_that_passes_a_sample_changes_the_force_smoothly(
    power: float,
) -> None:
    points = contact_points(
        friction=FRICTIONLESS, stiffness=0.0, damping_exponent=power
    )

    steps = [
        steps_of(points, samples, mean=0.003, across=0.02).max()
        for samples in (64, 128, 256)
    ]

    # A trapezoidal rule from the edge on errs by ζ(−q, a) h^(1 + q), a the share of a
    # cell at which the edge is: steps of 1e-3 at least.
    assert steps[0] < 4e-6
    assert observed_order([1.0, 0.5, 0.25], steps) > 1.3


@pytest.mark.kernels
@pytest.mark.parametrize("power", [0.25, 0.5, 0.75])
def test_steep_damping_is_that_of_quadrature(power: float) -> None:
    points = contact_points(
        friction=FRICTIONLESS, stiffness=0.0, damping_exponent=power
    )
    opens = [1.041 + sign * np.arccos(-0.003 / 0.02) for sign in (-1.0, 1.0)]
    moved = motion(0.041, mean=0.003, across=0.02)
    exact = by_quadrature(points, moved, opens)

    samples = [64, 128, 256, 512]
    errors = [np.abs(coefficients(points, moved, n) - exact).max() for n in samples]

    assert errors[0] < 2.5e-3 * np.abs(exact).max()
    order = observed_order([1.0 / each for each in samples], errors)
    assert order > 1.6


@pytest.mark.kernels
@pytest.mark.parametrize("power", [0.25, 0.35, 0.5])
def test_tangents_of_steep_damping_are_those_of_its_force(power: float) -> None:
    samples, step = 128, 1e-8
    points = contact_points(
        friction=FRICTIONLESS, stiffness=0.0, damping_exponent=power
    )
    fourier = FourierBasis(HARMONICS, samples)
    contact = AlternatingFrequencyTime(points, np.eye(3), fourier)

    off = []
    for phase in np.linspace(0.0, TURN / samples, 9):
        less, more = (
            coefficients(points, motion(phase, mean=mean, across=0.02), samples)[1, 0]
            for mean in (0.003 - step, 0.003 + step)
        )
        contact(motion(phase, mean=0.003, across=0.02), FREQUENCY)
        _, cosine, sine = contact.tangents.spectra(1)[0][0, 0]
        off.append(abs((more - less) / (2.0 * step) / (cosine - 1j * sine) - 1.0))

    # Products are interpolated linearly in those cells. At equidistant places the
    # tangent, infinite at the edge, is off by 2 to 18 per cent.
    assert max(off) < 2.0 * (TURN / samples) ** 2
