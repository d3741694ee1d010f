"""microslip: nonlinear forced response with friction and contact.

The names load on first use, so that ``import microslip`` takes no time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from microslip.api.curve import curve
    from microslip.api.follow import follow
    from microslip.api.modes import modes
    from microslip.api.results import figure, load, save
    from microslip.api.scene import scene
    from microslip.api.sweep import sweep
    from microslip_mechanics.element import Element
    from microslip_mechanics.errors import MicroslipError
    from microslip_mechanics.laws.area_contact import AreaContact
    from microslip_mechanics.laws.bristles import Dahl, LuGre
    from microslip_mechanics.laws.catalogue import LAWS
    from microslip_mechanics.laws.coulomb import RegularisedCoulomb
    from microslip_mechanics.laws.dampers import LinearDamper, QuadraticDamper
    from microslip_mechanics.laws.elastic_friction import ElasticFriction
    from microslip_mechanics.laws.gkf import GeneralKineticFriction
    from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
    from microslip_mechanics.laws.iwan import Iwan
    from microslip_mechanics.laws.jenkins import Jenkins
    from microslip_mechanics.laws.polynomial_spring import CubicSpring, PolynomialSpring
    from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
    from microslip_mechanics.laws.unilateral import UnilateralSpring
    from microslip_mechanics.loads.base_motion import BaseMotion
    from microslip_mechanics.loads.engine_order import EngineOrder
    from microslip_mechanics.reduction.reduced_problem import reduced_problem
    from microslip_mechanics.system import system

__all__ = [
    "LAWS",
    "AreaContact",
    "BaseMotion",
    "CubicSpring",
    "Dahl",
    "ElasticFriction",
    "Element",
    "EngineOrder",
    "GeneralKineticFriction",
    "HuntCrossleyContact",
    "Iwan",
    "Jenkins",
    "LinearDamper",
    "LuGre",
    "MicroslipError",
    "PolynomialSpring",
    "QuadraticDamper",
    "RegularisedCoulomb",
    "RigidCoulomb",
    "UnilateralSpring",
    "curve",
    "figure",
    "follow",
    "load",
    "modes",
    "reduced_problem",
    "save",
    "scene",
    "sweep",
    "system",
]

HOMES = {
    "curve": "microslip.api.curve",
    "follow": "microslip.api.follow",
    "modes": "microslip.api.modes",
    "scene": "microslip.api.scene",
    "sweep": "microslip.api.sweep",
    "figure": "microslip.api.results",
    "load": "microslip.api.results",
    "save": "microslip.api.results",
    "system": "microslip_mechanics.system",
    "reduced_problem": "microslip_mechanics.reduction.reduced_problem",
    "BaseMotion": "microslip_mechanics.loads.base_motion",
    "Element": "microslip_mechanics.element",
    "EngineOrder": "microslip_mechanics.loads.engine_order",
    "LAWS": "microslip_mechanics.laws.catalogue",
    "MicroslipError": "microslip_mechanics.errors",
}
"""module of each name; laws are found in the catalogue by the name of their class"""


def __getattr__(name: str) -> Any:  # noqa: ANN401  (whatever is asked for)
    """Return a public name, a law by its class's name, or the version."""
    if name in HOMES:
        return getattr(importlib.import_module(HOMES[name]), name)
    if name[:1].isupper():
        laws = importlib.import_module(HOMES["LAWS"]).LAWS
        for law in laws.values():
            if law.__name__ == name:
                return law
    if name == "__version__":
        return importlib.import_module("importlib.metadata").version("microslip")
    raise AttributeError(f"module microslip has no attribute {name}")


def __dir__() -> list[str]:
    """Return the public names, without loading them."""
    return sorted([*__all__, "__version__"])
