"""One or several elements of each law of the catalogue, between x, y, z and ground."""

from __future__ import annotations

from typing import Any

from microslip_mechanics.element import Element
from microslip_mechanics.laws.catalogue import LAWS
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system

NAMES = ("x", "y", "z")
ALONG: dict[str, Any] = {"between": ("x", "ground")}
SLIDING: dict[str, Any] = {"tangents": [("x", "ground"), ("y", "ground")]}
PRESSED: dict[str, Any] = {"normal": ("z", "ground"), **SLIDING}
SPRING: dict[str, Any] = {"normal_stiffness": 30.0, "preload": 2.0}
GKF: dict[str, Any] = {
    "mu_dynamic": 0.3,
    "mu_static": 0.5,
    "stribeck_velocity": 0.4,
    "threshold_velocity": 0.2,
}
LUGRE: dict[str, Any] = {
    "stiffness": 40.0,
    "mu_dynamic": 0.3,
    "mu_static": 0.4,
    "stribeck_velocity": 0.5,
}
CASES: dict[str, tuple[str, dict[str, Any], dict[str, Any]]] = {
    "polynomial": ("polynomial-spring", {"coefficients": {1: 4, 2: 3, 3: 20}}, ALONG),
    "cubic": ("cubic-spring", {"cubic": 30.0}, ALONG),
    "stop": ("unilateral-spring", {"stiffness": 25.0, "gap": 0.1}, ALONG),
    "pressed stop": (
        "unilateral-spring",
        {"stiffness": 25.0, "preload": 1.0, "exponent": 1.5, "damping": 0.2},
        ALONG,
    ),
    "ball": ("hunt-crossley", {"stiffness": 60.0, "damping": 3.0, "gap": 0.05}, ALONG),
    "face": (
        "area-contact",
        {"stiffness": 12.0, "width": 2.0},
        {"normal": ("x", "ground"), "rotations": [("y", "ground")]},
    ),
    "linear damper": ("linear-damper", {"damping": 0.4}, ALONG),
    "quadratic damper": ("quadratic-damper", {"damping": 0.5}, ALONG),
    "jenkins": ("jenkins", {"stiffness": 40.0, "limit": 0.6}, ALONG),
    "iwan": (
        "iwan",
        {
            "slip_force": 0.8, "stiffness": 40.0, "chi": -0.4, "beta": 0.3,
            "sliders": 12,
        },
        ALONG,
    ),
    "elastic, one tangent": (
        "elastic-friction",
        {"stiffness": 40.0, "mu": 0.3, "load": 2.0},
        {"tangents": [("x", "ground")]},
    ),
    "elastic": ("elastic-friction", {"stiffness": 40.0, "mu": 0.3, **SPRING}, PRESSED),
    "dahl": ("dahl", {"stiffness": 40.0, "mu": 0.3, "load": 2.0}, SLIDING),
    "lugre": ("lugre", {**LUGRE, **SPRING}, PRESSED),
    "coulomb": ("coulomb", {"mu": 0.3, "threshold_velocity": 0.2, **SPRING}, PRESSED),
    "rigid coulomb": ("rigid-coulomb", {"mu": 0.3, "load": 2.0}, SLIDING),
    "rigid coulomb, variable load": ("rigid-coulomb", {"mu": 0.3, **SPRING}, PRESSED),
    "smooth coulomb": (
        "coulomb",
        {"mu": 0.3, "threshold_velocity": 0.2, "smooth": True, "load": 2.0},
        SLIDING,
    ),
    "gkf": ("gkf", {**GKF, "viscous": 0.05, **SPRING}, PRESSED),
}  # fmt: skip
"""law, its numbers, and directions"""


def element(case: str) -> Element:
    """Return the element of a case."""
    name, numbers, directions = CASES[case]
    return Element(LAWS[name](**numbers), **directions, name="element")


def driven(case: str) -> Problem:
    """Return three masses on springs, driven along x and less so along y and z."""
    return system(
        mass=[1.0, 1.1, 0.9],
        stiffness=[[60.0, -4.0, 0.0], [-4.0, 66.0, -3.0], [0.0, -3.0, 70.0]],
        damping_ratio=0.03,
        names=NAMES,
        elements=[element(case)],
        drive={"x": 1.5, "y": 0.4, "z": 0.6},
    )
