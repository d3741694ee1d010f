"""A beam with a bolted lap joint: harmonic balance against shooting."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from lap_joint import lap_joint
from microslip_mechanics.static import static_equilibrium
from timedomain.record.start import on_orbit
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
    assert amplitude == pytest.approx(orbit.amplitude[0], rel=3e-3)
    means = [
        problem.interface.displacement @ (each.coefficients[0] - rest.displacement)
        for each in (response, orbit)
    ]
    # along the beam, where friction alone holds it
    slid = np.array(means)[:, 1::3]
    assert np.abs(slid).max() > 1e-8
    assert np.abs(slid[0] - slid[1]).max() < 0.05 * np.abs(slid[1]).max()


def test_a_curve_goes_through_the_resonance() -> None:
    problem = lap_joint(pairs=5, bolts=2e4, drive=0.5)
    options = CurveOptions(20.0 * TURN, 35.0 * TURN, error=1e-3)

    *_, last = frequency_response(problem, static_equilibrium(problem), options)

    assert last.frequency == pytest.approx(35.0 * TURN)
