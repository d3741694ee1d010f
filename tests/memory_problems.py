"""Masses on springs that one contact with friction that remembers sees."""

from dataclasses import replace

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import BRISTLE, ELASTIC, PointLaw, contact_table
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.structure import Structure

STIFFNESS, LIMIT = 40.0, 0.3
JENKINS = PointLaw(
    friction=ELASTIC,
    dynamic=1.0,
    tangential=STIFFNESS,
    constant_load=True,
    load=LIMIT,
)
DAHL = replace(JENKINS, friction=BRISTLE, static=1.0)
LUGRE = replace(DAHL, dynamic=0.7, stribeck=0.2, viscous=0.05)
SHOE = PointLaw(
    stiffness=60.0, gap=-0.01, friction=ELASTIC, dynamic=0.4, tangential=40.0
)
CONTACTS = (
    pytest.param(JENKINS, np.eye(3)[:, 1:2], np.array([0.35]), id="jenkins"),
    pytest.param(
        DAHL,
        np.eye(3)[:, 1:2],
        np.array([0.35]),
        id="dahl",  # the law of bristles of the next, without its falling friction
        marks=pytest.mark.long,
    ),
    pytest.param(LUGRE, np.eye(3)[:, 1:2], np.array([0.35]), id="lugre"),
    pytest.param(SHOE, np.eye(3)[:, [1, 0]], np.array([0.3, 0.6]), id="lifting shoe"),
    pytest.param(
        SHOE,
        np.eye(3)[:, [1, 2, 0]],
        np.array([0.3, 0.1, 0.9]),
        id="lifting shoe, two tangents",
        marks=pytest.mark.long,
    ),
)
"""law, what the contact sees of the masses, and the drive [N]"""


def masses(law: PointLaw, seen: Array, drive: Array) -> Problem:
    """Return masses on springs, each of 1 kg, that one contact sees."""
    dofs = seen.shape[1]
    stiffness = np.diag([30.0, 45.0, 60.0][:dofs])
    names = ("x", "y", "z")[:dofs]
    return Problem(
        Structure(np.eye(dofs), 4e-3 * stiffness, stiffness, names),
        Interface(contact_table([law]), seen, ("shoe",)),
        np.zeros(dofs),
        drive,
        Probes(names, np.eye(dofs)),
    )
