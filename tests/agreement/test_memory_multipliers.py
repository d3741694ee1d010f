"""Multipliers of contacts that remember: harmonic balance against shooting."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from memory_problems import CONTACTS, masses
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.static import static_equilibrium
from timedomain.record.start import on_orbit
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit


@pytest.mark.parametrize(("law", "seen", "drive"), CONTACTS)
def test_both_solvers_find_the_same_multipliers(
    law: PointLaw, seen: Array, drive: Array
) -> None:
    problem = masses(law, seen, drive)
    rest = static_equilibrium(problem)
    options = CurveOptions(4.0, 9.5, harmonics=15, samples=1024, errors=False)
    curve = list(frequency_response(problem, rest, options))
    shooting = ShootingOptions(steps=2048, error=1.0, most=4096)
    passing = [
        here
        for before, here, after in zip(curve, curve[1:], curve[2:], strict=False)
        if abs(after.frequency - before.frequency) > 1e-2  # at folds orbits end
    ]
    slid = sorted(passing, key=lambda point: -point.friction_energy)
    for point in (slid[0], slid[len(slid) // 3], curve[0]):
        orbit = periodic_orbit(
            problem, point.frequency, start=on_orbit(problem, point), options=shooting
        )
        largest = np.abs(orbit.multipliers).argmax()
        away = np.abs(point.multipliers - orbit.multipliers[largest]).min()
        assert away < 1e-3 + orbit.multiplier_error[largest]
