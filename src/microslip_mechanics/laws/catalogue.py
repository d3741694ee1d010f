"""The laws that there are; what stands here is known to scenes, explain and docs."""

from __future__ import annotations

from typing import Any

from microslip_mechanics.laws.area_contact import AreaContact
from microslip_mechanics.laws.bristles import Dahl, LuGre
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.dampers import LinearDamper, QuadraticDamper
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.gkf import GeneralKineticFriction
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.laws.iwan import Iwan
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.parameters import described
from microslip_mechanics.laws.polynomial_spring import CubicSpring, PolynomialSpring
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.laws.unilateral import UnilateralSpring

LAWS: dict[str, type[Any]] = {
    "polynomial-spring": PolynomialSpring,
    "cubic-spring": CubicSpring,
    "unilateral-spring": UnilateralSpring,
    "hunt-crossley": HuntCrossleyContact,
    "area-contact": AreaContact,
    "linear-damper": LinearDamper,
    "quadratic-damper": QuadraticDamper,
    "jenkins": Jenkins,
    "iwan": Iwan,
    "elastic-friction": ElasticFriction,
    "dahl": Dahl,
    "lugre": LuGre,
    "coulomb": RegularisedCoulomb,
    "rigid-coulomb": RigidCoulomb,
    "gkf": GeneralKineticFriction,
}
"""name in a scene, and class in Python, of each law"""

for _law in LAWS.values():  # what help(microslip.Jenkins) shows
    _law.__doc__ = described(_law)


def law_name(kind: type[Any]) -> str:
    """Return the name of a class of the catalogue."""
    return next(name for name, each in LAWS.items() if each is kind)
