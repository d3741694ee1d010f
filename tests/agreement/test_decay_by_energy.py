"""Damping of a free decay by amplitude and by energy: closed forms, and the mode's."""

from collections.abc import Callable

import numpy as np
import pytest
import scipy.integrate
import scipy.interpolate
import scipy.optimize

from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import modes_in_range, nonlinear_mode
from microslip.commands.decay_tables import cycles
from microslip.scenes.experiments import March
from microslip.studies.decay import measured, released
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import cubic_oscillator
from timedomain.record.start import Start

SPRING, SLIDER, LIMIT = 1e4, 1e3, 1.0
"""k and k_t [N/m] and R [N], beside a mass of 1 kg"""
ONSET = LIMIT / SLIDER
"""amplitude at which the slider begins to slip [m]"""
DASHPOT = 0.02
"""c [N s/m] of a mass of 1 kg on the springs x + x³"""


def decay_of(problem: Problem, size: float, frequency: float, periods: int) -> RingDown:
    march = March(2.0 * np.pi / frequency / 2000, 20)
    start = Start(np.array([size]), np.zeros(1))
    blocks = released(problem, start, march, frequency=frequency, periods=periods)
    return measured(problem, joined(list(blocks), "complete"), 0)


def mode_damping(problem: Problem, decay: RingDown) -> tuple[Array, Array]:
    """Return damping ratios of the mode's points, and those by energy of the decay.

    The amplitude of a point is half of its swing; those beyond the decay are left out.
    """
    rest = static_equilibrium(problem)
    (linear,) = modes_in_range(problem, rest, 0.0, np.inf)
    least, most = decay.amplitude.min(), decay.amplitude.max()
    options = ModeOptions(0.5 * least, 2.0 * most, harmonics=15)
    points = list(nonlinear_mode(problem, rest, linear, options))
    phases = np.linspace(0.0, 2.0 * np.pi, 257)
    sizes = np.array(
        [0.5 * np.ptp([each.state(phase)[0][0] for phase in phases]) for each in points]
    )
    inside = (sizes > least) & (sizes < most)
    damping = np.array([point.damping for point in points])
    decayed = scipy.interpolate.PchipInterpolator(
        decay.amplitude[::-1], decay.energy_damping[::-1]
    )
    return damping[inside], decayed(sizes[inside])


def swing_after(swing: float) -> float:
    """Return half of the way from one extreme of the sliding mass to the next.

    Between two extremes p and q the spring loses k (p² − q²)/2, which friction takes in
    over the way that is left when the slider has turned over, R (p + q − 2 R/k_t).
    """

    def balance(after: float) -> float:
        lost = (2.0 - ONSET / swing - ONSET / after) * LIMIT / SPRING
        return swing - after - lost

    return float(scipy.optimize.brentq(balance, 0.5 * ONSET, swing))


def test_the_amplitude_of_a_sliding_mass_falls_faster_than_its_mode_says() -> None:
    element = Element(Jenkins(SLIDER, LIMIT), between=("x1", "ground"))
    problem = system(mass=[1.0], stiffness=[SPRING], elements=[element])

    whole = decay_of(problem, 12.0 * ONSET, np.sqrt(SPRING), 36)
    # the first row knows of the start, whose slider has not slipped
    told = slice(1, int(np.flatnonzero(whole.amplitude > 1.3 * ONSET)[-1]))
    decay = RingDown(
        *(whole.time[told], whole.amplitude[told], whole.frequency[told]),
        *(whole.damping[told], whole.energy_damping[told]),
    )
    sizes, seen, by_energy = decay.amplitude, decay.damping, decay.energy_damping
    assert sizes[-1] < 1.5 * ONSET < 10.0 * ONSET < sizes[0]

    # by amplitude: the closed form of swings a cycle apart
    swings = np.linspace(1.1, 14.0, 800) * ONSET
    after = np.array([swing_after(swing_after(each)) for each in swings])
    decrement = np.interp(sizes, np.sqrt(swings * after), np.log(swings / after))
    exact = decrement / np.hypot(2.0 * np.pi, decrement)
    np.testing.assert_allclose(seen, exact, rtol=1e-3)
    # by energy: W = 4 R (a − R/k_t), the area of the loop, over 2π m ω² a²
    turned = np.arccos(1.0 - 2.0 * ONSET / sizes)
    stiffness = SPRING + SLIDER / np.pi * (turned - 0.5 * np.sin(2.0 * turned))
    lost = 4.0 * LIMIT * (sizes - ONSET) / (2.0 * np.pi * stiffness * sizes**2)
    np.testing.assert_allclose(by_energy, lost, rtol=4e-3)
    np.testing.assert_allclose(*mode_damping(problem, decay), rtol=4e-3)
    # a slider that slips holds no more as the amplitude grows: it is the spring's alone
    np.testing.assert_allclose(seen / by_energy, stiffness / SPRING, rtol=4e-3)
    assert (seen / by_energy).max() > 1.07


def test_the_amplitude_on_a_hardening_spring_falls_slower_than_its_mode_says() -> None:
    problem = cubic_oscillator(damping=DASHPOT, drive=0.0)

    decay = decay_of(problem, 1.5, 1.0, 20)

    # J = ∮ ẋ dx / 2π falls by exp(−c t) over m, whatever the spring
    def action(size: float) -> float:
        def speed(angle: float) -> float:
            place = size * np.sin(angle)
            spring = size**2 - place**2 + 0.5 * (size**4 - place**4)
            return float(np.sqrt(spring) * size * np.cos(angle))

        return float(scipy.integrate.quad(speed, -0.5 * np.pi, 0.5 * np.pi)[0])

    rate = DASHPOT / slope(action, decay.amplitude)
    np.testing.assert_allclose(decay.damping * decay.frequency, rate, rtol=2e-3)
    lost = decay.energy_damping * decay.frequency
    np.testing.assert_allclose(lost, 0.5 * DASHPOT, rtol=1e-3)
    np.testing.assert_allclose(*mode_damping(problem, decay), rtol=2e-3)
    assert (decay.damping / decay.energy_damping).min() < 0.85


def slope(function: Callable[[float], float], places: Array) -> Array:
    """Return d log f / d log x at some places."""
    shift = 1e-4
    found: Array = np.array(
        [
            np.log(function(place * (1.0 + shift)) / function(place * (1.0 - shift)))
            for place in places
        ]
    )
    found /= np.log((1.0 + shift) / (1.0 - shift))
    return found


@pytest.mark.parametrize("rows", [13, 60])
def test_both_are_alike_in_a_linear_decay(rows: int) -> None:
    problem = system(mass=[2.0], stiffness=[300.0], damping_ratio=0.03)
    natural = np.sqrt(150.0)
    steps = 2000 // rows
    march = March(2.0 * np.pi / natural / (rows * steps), steps)

    start = Start(np.ones(1), np.zeros(1))
    blocks = released(problem, start, march, frequency=natural, periods=8)
    decay = measured(problem, joined(list(blocks), "complete"), 0)

    np.testing.assert_allclose(decay.energy_damping, 0.03, rtol=1e-2)


def test_beside_gyroscopic_forces_no_energy_is_told() -> None:
    across = [[0.0, -3.0], [3.0, 0.0]]
    problem = system(
        mass=[1.0, 1.0], stiffness=[100.0, 100.0], damping_ratio=0.02, gyroscopic=across
    )
    march = March(1e-3, 10)
    start = Start(np.array([1.0, 0.0]), np.zeros(2))

    blocks = list(released(problem, start, march, frequency=10.0, periods=9))
    decay = measured(problem, joined(blocks, "complete"), 0)

    assert decay.damping.size > 10
    assert decay.energy_damping.size == 0
    assert "energy" not in "".join(cycles(decay, "x1"))


def test_what_rounding_hides_of_a_long_decay_is_not_told() -> None:
    problem = system(mass=[2.0], stiffness=[300.0], damping_ratio=0.03)

    decay = decay_of(problem, 1.0, np.sqrt(150.0), 100)

    # a cycle loses 1e-16 of the energy that the march has added up
    told = np.isfinite(decay.energy_damping)
    assert decay.amplitude[-1] < 2e-8
    assert decay.amplitude[told].min() < 1e-4
    np.testing.assert_allclose(decay.energy_damping[told], 0.03, rtol=2e-3)
    assert not np.isfinite(decay.energy_damping[told.argmin() :]).any()
    lines = cycles(decay, "x1")
    assert lines[3].split()[-1] != lines[-1].split()[-1] == "-"
