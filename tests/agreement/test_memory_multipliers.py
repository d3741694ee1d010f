"""Multipliers of contacts that remember: harmonic balance against shooting."""

from dataclasses import replace

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
from timedomain.shooting import ShootingOptions, periodic_orbit
from timedomain.start import on_orbit

JENKINS = PointLaw(
    friction=ELASTIC, dynamic=1.0, tangential=40.0, constant_load=True, load=0.3
)
DAHL = replace(JENKINS, friction=BRISTLE, static=1.0)
LUGRE = replace(DAHL, dynamic=0.7, stribeck=0.2, viscous=0.05)
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
        (SHOE, np.eye(3)[:, [1, 2, 0]], np.array([0.3, 0.1, 0.9])),
    ],
    ids=["jenkins", "dahl", "lugre", "lifting shoe", "lifting shoe, two tangents"],
)
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
        sizes = np.abs(orbit.multipliers)
        admitted = 1e-3 + orbit.multiplier_error[sizes.argmax()]
        assert np.abs(point.multipliers).max() == pytest.approx(
            sizes.max(), abs=admitted
        )
