"""Nonlinear modes against closed forms, and against free decay in time."""

import math

import numpy as np
import pytest
import scipy.integrate
import scipy.linalg
import scipy.optimize
import scipy.special

from contact_tables import contact_points
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import NonlinearMode, modes_in_range, nonlinear_mode
from microslip_mechanics.contact.points import FRICTIONLESS
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import (
    NORMAL,
    cantilever,
    cubic_oscillator,
    mass_on_contact,
    sliding_block,
)

EVERYTHING = (1.0, 1e6)
"""frequencies [rad/s]"""


def grown(
    problem: Problem,
    smallest: float,
    largest: float,
    *,
    frequencies: tuple[float, float] = EVERYTHING,
    harmonics: int,
) -> list[NonlinearMode]:
    """Return the lowest mode from one amplitude to another."""
    rest = static_equilibrium(problem)
    linear = modes_in_range(problem, rest, *frequencies)[0]
    options = ModeOptions(smallest, largest, 1e-2, harmonics, 1e-9)
    return list(nonlinear_mode(problem, rest, linear, options))


def test_friction_damps_a_mass_from_sticking_to_sliding_as_its_closed_form() -> None:
    stiffness, mass, force, threshold = 300.0, 2.0, 0.3 * 1.7, 0.1
    block = sliding_block(stiffness=stiffness, threshold=threshold, load=1.7)

    modes = grown(block, 1e-3, 10.0, harmonics=1)
    # within a cell of the 128 samples the motion is taken as linear
    interpolation = (2.0 * math.pi / modes[0].samples) ** 2 / 6.0

    for mode in modes:
        # first harmonic of a saturated dashpot
        share = min(1.0, threshold / (mode.frequency * mode.amplitude))
        filled = math.asin(share) + share * math.sqrt(1.0 - share**2)
        dashpot = 2.0 / math.pi * filled * force / threshold
        expected = dashpot / (2.0 * math.sqrt(stiffness * mass))
        assert mode.damping == pytest.approx(expected, rel=interpolation)
        assert mode.frequency == pytest.approx(math.sqrt(stiffness / mass), rel=1e-5)
    last = modes[-1]
    dry = 2.0 * force / (math.pi * stiffness * last.amplitude)
    assert last.damping == pytest.approx(dry, rel=1e-3)


def test_a_linear_structure_has_its_eigenvalues_at_every_amplitude() -> None:
    beam = cantilever(mass_damping=20.0, stiffness_damping=2e-4)
    structure = beam.structure
    none, one = np.zeros_like(structure.mass), np.eye(structure.dofs)
    exact = scipy.linalg.eigvals(
        np.block([[none, one], [-structure.stiffness, -structure.damping]]),
        np.block([[one, none], [none, structure.mass]]),
    )

    for mode in grown(beam, 1e-6, 1.0, harmonics=3):
        assert np.abs(exact - mode.pole).min() < 1e-8 * mode.frequency
        first = mode.coefficients[1] - 1j * mode.coefficients[2]
        displacement, velocity = mode.state(0.7)
        turned = first * np.exp(0.7j)
        assert displacement == pytest.approx(turned.real, rel=1e-9, abs=1e-15)
        assert velocity == pytest.approx((mode.pole * turned).real, rel=1e-9, abs=1e-12)


def test_friction_below_its_threshold_velocity_is_an_exact_dashpot() -> None:
    # 0.51 N over 0.1 m/s on 2 kg and 300 N/m: a damping ratio of a tenth
    block = sliding_block(stiffness=300.0, threshold=0.1, load=1.7)
    ratio = 5.1 / (2.0 * math.sqrt(300.0 * 2.0))

    for mode in grown(block, 1e-5, 1e-3, harmonics=3):
        assert mode.damping == pytest.approx(ratio, rel=1e-9)
        assert mode.frequency == pytest.approx(math.sqrt(150.0), rel=1e-9)


def test_a_preloaded_contact_softens_as_the_conservative_orbit_does() -> None:
    points = contact_points(
        stiffness=1e6, exponent=2.0, damping=0.0, friction=FRICTIONLESS
    )
    mass, preload = 2.0, 100.0
    problem = mass_on_contact(points, direction=NORMAL, mass=mass, preload=preload)
    depth = math.sqrt(preload / 1e6)

    modes = grown(problem, 1e-2 * depth, 0.9 * depth, harmonics=15)

    assert modes[-1].frequency < 0.97 * modes[0].frequency
    for mode in modes[:: len(modes) // 4]:
        displacement, velocity = mode.state(0.0)
        period = orbit_period(displacement[0], velocity[0], mass, preload, 1e6)
        assert mode.frequency == pytest.approx(2.0 * math.pi / period, rel=1e-6)
        assert abs(mode.damping) < 1e-9


def orbit_period(
    place: float, speed: float, mass: float, preload: float, stiffness: float
) -> float:
    """Return the time until a mass on a quadratic spring is back, by Runge–Kutta."""

    def motion(_: float, state: np.ndarray) -> list[float]:
        spring = stiffness * max(state[0], 0.0) ** 2
        return [state[1], (preload - spring) / mass]

    rest = math.sqrt(preload / stiffness)

    def passes(_: float, state: np.ndarray) -> float:
        return float(state[0] - rest)

    passes.direction = 1.0  # type: ignore[attr-defined]
    found = scipy.integrate.solve_ivp(
        motion, (0.0, 1.0), [place, speed], events=passes, rtol=1e-11, atol=1e-14
    )
    assert found.t_events is not None
    return float(found.t_events[0][1] - found.t_events[0][0])


@pytest.mark.parametrize("harmonics", [None, 1, 3, 7])
def test_a_frequency_errs_by_no_more_than_is_told(harmonics: int | None) -> None:
    spring = cubic_oscillator(damping=2e-7)
    rest = static_equilibrium(spring)
    (linear,) = modes_in_range(spring, rest, 0.5, 2.0)

    options = ModeOptions(1e-2, 1e2, harmonics=harmonics)
    points = list(nonlinear_mode(spring, rest, linear, options))

    true = np.array(
        [abs(each.frequency / cubic(each.amplitude) - 1) for each in points]
    )
    told = np.array([each.frequency_error for each in points])
    known = true > 1e-9  # else it is rounding
    assert known.sum() >= 20
    assert np.mean(true[known] <= told[known]) >= 0.95
    if harmonics is None:
        assert told.max() <= 1e-4
    else:
        assert np.median(told[known] / true[known]) <= 2.0


def cubic(first: float) -> float:
    """Return the frequency of ẍ + x + x³ = 0 whose first harmonic has an amplitude.

    x = A cn(u | m), of which the Fourier series is known by the nome q.
    """

    def elliptic(swing: float) -> tuple[float, float]:
        modulus = swing**2 / (2.0 * (1.0 + swing**2))
        quarter = scipy.special.ellipk(modulus)
        nome = math.exp(-math.pi * scipy.special.ellipk(1.0 - modulus) / quarter)
        share = 2.0 * math.pi / (math.sqrt(modulus) * quarter)
        share *= math.sqrt(nome) / (1.0 + nome)
        return math.pi / 2.0 * math.sqrt(1.0 + swing**2) / quarter, swing * share

    swing = scipy.optimize.brentq(
        lambda each: elliptic(each)[1] - first, 0.5 * first, 2.0 * first, xtol=1e-13
    )
    return elliptic(swing)[0]


@pytest.mark.parametrize("model", ["A", "B"])
def test_small_motions_of_the_rig_are_those_of_its_stuck_contacts(model: str) -> None:
    problem = rig_problem(model=model)
    rest = static_equilibrium(problem)
    linear = modes_in_range(problem, rest, 700.0, 1000.0)[0]

    first = next(nonlinear_mode(problem, rest, linear, ModeOptions(1e-6, 1e-2)))

    assert first.pole == pytest.approx(linear.pole, rel=1e-10)


def test_without_friction_the_blades_keep_frequency_and_damping() -> None:
    # nothing couples the blades to the friction element along their vibration
    problem = rig_problem(model="A", friction__law="none")

    modes = grown(problem, 1e-5, 1e-2, frequencies=(800.0, 900.0), harmonics=3)

    poles = np.array([mode.pole for mode in modes])
    assert np.abs(poles - poles[0]).max() < 1e-7 * abs(poles[0])


def test_the_rig_goes_from_its_stuck_to_its_sliding_frequency() -> None:
    sliding = rig_problem(model="A", friction__law="none")
    free = modes_in_range(sliding, static_equilibrium(sliding), 800.0, 900.0)[0]

    modes = grown(
        rig_problem(model="A"), 1e-4, 2e-2, frequencies=(800.0, 900.0), harmonics=7
    )

    damping = [mode.damping for mode in modes]
    assert modes[-1].frequency == pytest.approx(free.frequency, rel=1e-4)
    assert max(damping) > 5.0 * damping[0]
    assert damping[-1] < 0.3 * max(damping)
