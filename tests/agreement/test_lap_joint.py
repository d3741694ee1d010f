"""A beam with a bolted lap joint: harmonic balance against shooting."""

import numpy as np
import pytest

import microslip
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from lap_joint import lap_joint
from microslip_mechanics.static import static_equilibrium
from timedomain.record.start import on_orbit
from timedomain.shooting.comparison import compared
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

TURN = 2.0 * np.pi


def test_both_solvers_find_where_the_outer_half_settles() -> None:
    problem = lap_joint(pairs=5, bolts=2e4, drive=1.0)
    rest = static_equilibrium(problem)
    options = CurveOptions(26.9 * TURN, 27.0 * TURN, error=1e-3, events=False)
    response = next(iter(frequency_response(problem, rest, options)))
    begun = on_orbit(problem, response)
    shooting = ShootingOptions(steps=2048, error=1e-3)

    orbit = periodic_orbit(problem, response.frequency, start=begun, options=shooting)

    assert response.friction_energy > 1e-4
    assert orbit.stuck.any()
    assert not orbit.stuck.all()
    tip = problem.probes.rows
    amplitude = float(np.hypot(*(response.coefficients[1:3] @ tip.T))[0])
    assert amplitude == pytest.approx(orbit.amplitude[0], rel=2e-3)
    means = [
        problem.interface.displacement @ (each.coefficients[0] - rest.displacement)
        for each in (response, orbit)
    ]
    # along the beam, where friction alone holds it
    slid = np.array(means)[:, 1::3]
    assert np.abs(slid).max() > 1e-8
    assert np.abs(slid[0] - slid[1]).max() < 0.02 * np.abs(slid[1]).max()


@pytest.mark.parametrize("error", [1e-2, pytest.param(1e-3, marks=pytest.mark.long)])
def test_a_curve_goes_through_the_resonance(error: float) -> None:
    problem = lap_joint(pairs=5, bolts=2e4, drive=0.5)
    options = CurveOptions(20.0 * TURN, 35.0 * TURN, error=error)

    *_, last = frequency_response(problem, static_equilibrium(problem), options)

    assert last.frequency == pytest.approx(35.0 * TURN)


def test_its_mode_is_where_the_tip_is_a_quarter_period_behind() -> None:
    problem = lap_joint(pairs=3, bolts=2e4, drive=0.5)
    options = CurveOptions(
        26.65 * TURN, 26.7 * TURN, harmonics=15, samples=256, errors=False, events=False
    )
    curve = list(frequency_response(problem, static_equilibrium(problem), options))
    tip = problem.probes.rows[0]
    behind, ahead = np.array([each.coefficients[1:3] @ tip for each in curve]).T
    hertz = np.array([each.frequency for each in curve]) / TURN
    (place,) = np.flatnonzero(ahead[1:] * ahead[:-1] < 0.0)
    share = ahead[place] / (ahead[place] - ahead[place + 1])
    quarter = hertz[place] + share * (hertz[place + 1] - hertz[place])
    amplitude = abs(behind[place] + share * (behind[place + 1] - behind[place]))

    (mode,) = microslip.modes(problem, 20.0, 40.0, largest=2e-2, harmonics=15)

    sizes = [each.amplitude for each in mode.points]
    rates = [each.frequency / TURN for each in mode.points]
    sticking = rates[0]
    found = float(np.interp(amplitude, sizes, rates))
    assert sticking - found > 0.02  # it slips
    assert found == pytest.approx(quarter, abs=0.1 * (sticking - found))


def test_fast_motions_of_a_joint_do_not_make_it_unstable() -> None:
    # it turns at 100 kHz: by 256 steps of a period alone the multiplier was 31, but a
    # march of 262144 stays on the orbit
    problem = lap_joint(4, bolts=2000.0, drive=10.0)
    place = 2.0 * np.pi * 134.0
    options = CurveOptions(place, 1.001 * place, harmonics=63, samples=2048)

    found = next(
        iter(frequency_response(problem, static_equilibrium(problem), options))
    )
    shot = compared(problem, found)

    assert found.unstable == 0
    assert shot.multiplier == pytest.approx(shot.found_multiplier, abs=2e-3)
