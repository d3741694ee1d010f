"""Layout of the two-blade rig: places, axes, beams, rigid bodies and the rope.

Axes: x radial (outward), y circumferential, z axial, at the friction element. Blade 0
is the excited one, at y < 0; blade 1 is the follower, at y > 0 (tutorial, part 1).
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.frame import (
    MOTIONS,
    Beam,
    Frame,
    GroundSpring,
    Node,
    RigidBody,
)

AXIAL = np.array([0.0, 0.0, 1.0])
ELEMENT = "friction-element"
BLADES = ("excited-blade", "follower-blade")


def frame(rig: TwoBlades) -> Frame:
    """Return the beams, rigid bodies and the rope of the rig."""
    nodes, beams, bodies = [], [], []
    for blade in (0, 1):
        stations = _stations(rig, blade)
        names = [f"{BLADES[blade]}.{k}" for k in range(len(stations))]
        nodes += [
            Node(name, place, MOTIONS if k else ())
            for k, (name, place) in enumerate(zip(names, stations, strict=True))
        ]
        ends = itertools.pairwise(names)
        beams += [_beam(rig, start, end) for start, end in ends]
        bodies.append(_blade_end(rig, blade))
    centre, free = element_centre(rig), MOTIONS if rig.model == "full" else MOTIONS[:3]
    nodes.append(Node(ELEMENT, centre, free))
    element = rig.friction_element
    inertia = np.diag([element.inertia_x, element.inertia_y, element.inertia_z])
    bodies.append(RigidBody(ELEMENT, element.mass, inertia, centre))
    return Frame(tuple(nodes), tuple(beams), tuple(bodies), _rope(rig))


def element_centre(rig: TwoBlades) -> Array:
    """Return the centre of the friction element [m], shape (3,)."""
    return np.array([rig.friction_element.shift, 0.0, 0.0])


def end_centre(rig: TwoBlades, blade: int) -> Array:
    """Return the centre of mass of a blade end [m], shape (3,)."""
    distance = (rig.blade_end.width + rig.friction_element.width) / 2.0
    return np.array([0.0, distance * (-1.0, 1.0)[blade], 0.0])


def blade_axis(rig: TwoBlades, blade: int) -> Array:
    """Return the direction from root to tip, shape (3,)."""
    lean = (rig.blade.fan, 0.0)[blade]
    return np.array([math.cos(lean), -math.sin(lean), 0.0])


def tip(rig: TwoBlades, blade: int) -> str:
    """Return the name of a blade's tip node."""
    return f"{BLADES[blade]}.{rig.blade.elements}"


def _stations(rig: TwoBlades, blade: int) -> list[Array]:
    """Return the node positions from root to tip."""
    axis = blade_axis(rig, blade)
    end = end_centre(rig, blade) - rig.blade_end.offset * axis
    steps = np.linspace(rig.blade.length, 0.0, rig.blade.elements + 1)
    return [end - step * axis for step in steps]


def _beam(rig: TwoBlades, start: str, end: str) -> Beam:
    blade = rig.blade
    section = RectangularSection(
        blade.width,
        blade.thickness,
        blade.young_modulus,
        blade.poisson_ratio,
        blade.density,
    )
    return Beam(start, end, section, AXIAL, blade.mass_damping, blade.stiffness_damping)


def _blade_end(rig: TwoBlades, blade: int) -> RigidBody:
    end, axis = rig.blade_end, blade_axis(rig, blade)
    axes = np.array([axis, np.cross(AXIAL, axis), AXIAL])
    principal = np.diag([end.inertia_x, end.inertia_y, end.inertia_z])
    inertia = axes.T @ principal @ axes
    return RigidBody(tip(rig, blade), end.mass, inertia, end_centre(rig, blade))


def _rope(rig: TwoBlades) -> tuple[GroundSpring, ...]:
    if rig.rope is None or rig.rope.stiffness == 0.0:
        return ()
    return (GroundSpring(ELEMENT, AXIAL, rig.rope.stiffness),)
