"""Orbits with friction that remembers: harmonic balance against a march."""

import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from memory_problems import CONTACTS, masses
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.static import static_equilibrium
from timedomain.verify import agreement, march_periods


@pytest.mark.parametrize(("law", "seen", "drive"), CONTACTS)
def test_march_stays_on_the_orbit(law: PointLaw, seen: Array, drive: Array) -> None:
    problem = masses(law, seen, drive)
    rest = static_equilibrium(problem)
    options = CurveOptions(
        4.0, 9.5, harmonics=25, samples=2048, errors=False, stability=False
    )
    curve = list(frequency_response(problem, rest, options))
    assert max(point.friction_energy for point in curve) > 0.01
    slid = sorted(curve, key=lambda point: -point.friction_energy)
    for point in (slid[0], slid[len(slid) // 3]):
        blocks = list(march_periods(problem, point, periods=30, steps_per_period=2400))
        found = agreement(problem, point, blocks)
        assert found.deviation.max() < 5e-3
        assert found.last_distance < 5e-3
