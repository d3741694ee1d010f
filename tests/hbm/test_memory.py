"""Friction that remembers, in harmonic balance: loops with closed forms, tangents."""

import numpy as np
import pytest

from hbm.continuation.newton import correct
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from memory_problems import JENKINS, LIMIT, SHOE, STIFFNESS, masses
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import BRISTLE, ELASTIC, PointLaw, contact_table
from microslip_mechanics.static import static_equilibrium

FREQUENCY = 7.0
TANGENT = np.eye(3)[:, 1:2]
EVERY = np.eye(3)


def contact(
    law: PointLaw, basis: Array, *, harmonics: int = 5, samples: int = 1024
) -> AlternatingFrequencyTime:
    return AlternatingFrequencyTime(
        contact_table([law]), basis, FourierBasis(harmonics, samples)
    )


def sine(amplitude: float, mean: float = 0.0) -> Array:
    coefficients = np.zeros((11, 1))
    coefficients[0], coefficients[2] = mean, amplitude
    return coefficients


@pytest.mark.parametrize("times", [1.2, 2.0, 5.0, 40.0])
def test_loop_of_jenkins_has_its_closed_form(times: float) -> None:
    # energy per period 4 µN (A − µN/k), Jenkins 1962
    amplitude = times * LIMIT / STIFFNESS
    cycle = contact(JENKINS, TANGENT).cycle(sine(amplitude), FREQUENCY)
    area = 4.0 * LIMIT * (amplitude - LIMIT / STIFFNESS)
    assert cycle.friction == pytest.approx(area, rel=2e-4)


@pytest.mark.parametrize("times", [1.2, 2.0, 5.0, 40.0])
def test_first_harmonic_of_jenkins_is_that_of_the_describing_function(
    times: float,
) -> None:
    amplitude = times * LIMIT / STIFFNESS
    force = contact(JENKINS, TANGENT)(sine(amplitude), FREQUENCY)
    turn = np.arccos(1.0 - 2.0 / times)
    in_phase = STIFFNESS * amplitude / np.pi * (turn - 0.5 * np.sin(2.0 * turn))
    out_of_phase = 4.0 * LIMIT / np.pi * (1.0 - 1.0 / times)
    assert force[2, 0] == pytest.approx(in_phase, rel=1e-4)
    assert force[1, 0] == pytest.approx(out_of_phase, rel=1e-4)


def test_stuck_slider_is_a_spring_that_carries_no_mean_force() -> None:
    force = contact(JENKINS, TANGENT)(sine(0.9 * LIMIT / STIFFNESS, 3.0), FREQUENCY)
    expected = np.zeros(11)
    expected[2] = 0.9 * LIMIT
    assert force[:, 0] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.9])
def test_separated_contact_has_no_traction_and_sticks_where_it_touches(
    part: float,
) -> None:
    law = PointLaw(
        stiffness=100.0, friction=ELASTIC, dynamic=10.0, tangential=STIFFNESS
    )
    points = contact(law, EVERY[:, :2])
    early = 2.0 * np.pi * part / 1024  # it touches within the last step
    coefficients = np.zeros((11, 2))
    coefficients[1:3, 0] = np.sin(early), np.cos(early)
    coefficients[1, 1], coefficients[2, 1] = 1.0, 1.0
    points(coefficients, FREQUENCY)
    points.cycle(coefficients, FREQUENCY)
    traction = points._traces.regular.force[1]
    phase = 2.0 * np.pi * np.arange(1024) / 1024
    touch = np.cos(-early) + np.sin(-early)
    closed = STIFFNESS * (np.cos(phase) + np.sin(phase) - touch)
    assert traction[512:1023] == pytest.approx(np.zeros(511), abs=1e-12)
    # the slip limit is far away but near both ends
    assert traction[20:450] == pytest.approx(closed[20:450], abs=1e-5 * STIFFNESS)


@pytest.mark.parametrize("frequency", [7.5, 8.0])
def test_errors_of_a_shoe_that_touches_fall_with_the_square_of_the_samples(
    frequency: float,
) -> None:
    # where it sticks as it touches; where it slips the touch is no matter
    problem = masses(SHOE, EVERY[:, [1, 0]], np.array([0.3, 0.6]))
    path = along_frequency(problem, static_equilibrium(problem), 5.0, 9.0)
    made = PathResolution(path, problem.probes.rows, marched=True)
    start = np.zeros(FourierBasis(7, 64).coefficients * path.rank + 1)
    upright = np.append(start[:-1], 1.0)
    start[-1] = frequency

    def amplitudes(samples: int) -> Array:
        system = made.at(FourierBasis(7, samples))
        found = correct(system, start, upright, tolerance=1e-12)
        (sizes,) = made.amplitudes((found.point,))
        return np.ravel(sizes)

    exact = amplitudes(16384)
    errors = [np.abs(amplitudes(n) / exact - 1.0).max() for n in (128, 1024)]

    assert errors[0] < 1.5e-3
    assert errors[1] < 1e-5


def test_loop_of_dahl_has_its_closed_form() -> None:
    law = PointLaw(
        friction=BRISTLE,
        dynamic=1.0,
        static=1.0,
        tangential=STIFFNESS,
        constant_load=True,
        load=LIMIT,
    )
    amplitude = 60.0 * LIMIT / STIFFNESS
    cycle = contact(law, TANGENT, samples=16384).cycle(sine(amplitude), FREQUENCY)
    # after a turn T = µN (1 − 2 exp(−k w/µN)), by 2 (µN)²/k less work than rigid
    area = 4.0 * LIMIT * amplitude - 2.0 * 2.0 * LIMIT**2 / STIFFNESS
    assert cycle.friction == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize("kind", [ELASTIC, BRISTLE], ids=["elastic", "bristles"])
@pytest.mark.parametrize("constant", [True, False], ids=["constant load", "variable"])
def test_tangents_agree_with_differences(kind: int, constant: bool) -> None:
    law = PointLaw(
        stiffness=5.0,
        gap=-0.8,
        friction=kind,
        dynamic=0.4,
        static=0.4 if kind == ELASTIC else 0.7,
        stribeck=0.5,
        tangential=8.0,
        constant_load=constant,
        load=0.9,
    )
    points = contact(law, EVERY, harmonics=3, samples=256)
    random = np.random.default_rng(4)
    coefficients = 0.25 * random.normal(size=(7, 3))
    force = points(coefficients, FREQUENCY)
    change = points.by_frequency()
    remembered = np.zeros((21, 21))
    points.add_remembered(np.arange(21).reshape(7, 3), remembered)
    assert np.abs(force[:, 1:]).max() > 0.05
    step = 1e-7
    for place in ((0, 0), (3, 1), (6, 2)):
        moved = np.zeros_like(coefficients)
        moved[place] = step
        forward = points(coefficients + moved, FREQUENCY)
        backward = points(coefficients - moved, FREQUENCY)
        slope = (forward - backward)[:, 1:] / (2.0 * step)
        known = remembered.reshape(7, 3, 7, 3)[:, 1:, *place]
        assert known == pytest.approx(slope, abs=2e-5 * np.abs(slope).max())
    # rounding of the forces is a ten-millionth of this difference
    faster = points(coefficients, FREQUENCY * (1.0 + 1e-5))
    slower = points(coefficients, FREQUENCY * (1.0 - 1e-5))
    by_frequency = (faster - slower) / (2e-5 * FREQUENCY)
    assert change == pytest.approx(by_frequency, abs=1e-6 * np.abs(by_frequency).max())
