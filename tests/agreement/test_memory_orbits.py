"""Orbits with friction that remembers: harmonic balance against a march."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import (
    BRISTLE,
    ELASTIC,
    PointLaw,
    contact_table,
)
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structure import Structure
from timedomain.verify import agreement, march_periods

JENKINS = PointLaw(
    friction=ELASTIC, dynamic=1.0, tangential=40.0, constant_load=True, load=0.3
)
DAHL = PointLaw(
    friction=BRISTLE,
    dynamic=1.0,
    static=1.0,
    tangential=40.0,
    constant_load=True,
    load=0.3,
)
LUGRE = PointLaw(
    friction=BRISTLE,
    dynamic=0.7,
    static=1.0,
    stribeck=0.2,
    viscous=0.05,
    tangential=40.0,
    constant_load=True,
    load=0.3,
)
SHOE = PointLaw(
    stiffness=60.0, gap=-0.01, friction=ELASTIC, dynamic=0.4, tangential=40.0
)


def masses(law: PointLaw, seen: Array, drive: Array) -> Problem:
    """Return masses on springs, each of 1 kg, that one contact sees."""
    dofs = seen.shape[1]
    stiffness = np.diag([30.0, 45.0, 60.0][:dofs])
    names = ("x", "y", "z")[:dofs]
    return Problem(
        Structure(np.eye(dofs), 0.004 * stiffness, stiffness, names),
        Interface(contact_table([law]), seen, ("shoe",)),
        np.zeros(dofs),
        drive,
        Probes(names, np.eye(dofs)),
    )


@pytest.mark.parametrize(
    ("law", "seen", "drive"),
    [
        (JENKINS, np.eye(3)[:, 1:2], np.array([0.35])),
        (DAHL, np.eye(3)[:, 1:2], np.array([0.35])),
        (LUGRE, np.eye(3)[:, 1:2], np.array([0.35])),
        (SHOE, np.eye(3)[:, [1, 0]], np.array([0.3, 0.6])),
        (SHOE, np.eye(3)[:, [1, 2, 0]], np.array([0.3, 0.3j, 0.9]).real + 0.0),
    ],
    ids=["jenkins", "dahl", "lugre", "lifting shoe", "lifting shoe, two tangents"],
)
def test_march_stays_on_the_orbit(law: PointLaw, seen: Array, drive: Array) -> None:
    problem = masses(law, seen, drive)
    rest = static_equilibrium(problem)
    options = CurveOptions(4.0, 9.5, harmonics=25, samples=2048, stability=False)
    curve = list(frequency_response(problem, rest, options))
    assert max(point.friction_energy for point in curve) > 0.01
    slid = sorted(curve, key=lambda point: -point.friction_energy)
    for point in (slid[0], slid[len(slid) // 3]):
        blocks = list(march_periods(problem, point, periods=30, steps_per_period=2400))
        found = agreement(problem, point, blocks)
        assert found.deviation.max() < 5e-3
        assert found.last_distance < 5e-3
