"""A cantilever beam and point masses, for scenes without matrices of their own."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from microslip.scenes.quantity import quantity
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import MOTIONS, Beam, Frame, Node, RigidBody

FOOT, TIP = "foot", "tip"


@dataclass(frozen=True, slots=True)
class Cantilever:
    """A beam along x, clamped at its foot; its last node is the tip.

    Degrees of freedom are ``tip.uz``, ``tip.ry``, …, and ``node1.uz``, … from the foot.
    """

    length: float = quantity("m", positive=True, highest=100.0)
    elements: int = quantity(lowest=1, highest=1000)
    width: float = quantity("m", positive=True, highest=10.0)
    """along y"""
    thickness: float = quantity("m", positive=True, highest=10.0)
    """along z"""
    young_modulus: float = quantity("Pa", lowest=1e6, highest=2e12)
    poisson_ratio: float = quantity(lowest=0.0, highest=0.5)
    density: float = quantity("kg/m^3", lowest=1.0, highest=3e4)
    plane: bool = quantity(default=False)
    """whether it bends along z only, so that uz and ry are all its motions"""


def assembled(beam: Cantilever, masses: Mapping[str, float]) -> Frame:
    """Return beam and point masses [kg], undamped; a mass moves along x, y and z."""
    places = np.linspace(0.0, beam.length, beam.elements + 1)
    names = [FOOT, *(f"node{n}" for n in range(1, beam.elements)), TIP]
    free = ("uz", "ry") if beam.plane else MOTIONS
    nodes = [
        Node(name, np.array([place, 0.0, 0.0]), () if name == FOOT else free)
        for name, place in zip(names, places, strict=True)
    ]
    section = RectangularSection(
        beam.width,
        beam.thickness,
        beam.young_modulus,
        beam.poisson_ratio,
        beam.density,
    )
    across = np.array([0.0, 0.0, 1.0])
    beams = [
        Beam(start, end, section, across) for start, end in itertools.pairwise(names)
    ]
    moving = ("uz",) if beam.plane else MOTIONS[:3]
    nodes += [Node(name, np.zeros(3), moving) for name in masses]
    bodies = [
        RigidBody(name, mass, np.zeros((3, 3)), np.zeros(3))
        for name, mass in masses.items()
    ]
    return Frame(tuple(nodes), tuple(beams), tuple(bodies))
