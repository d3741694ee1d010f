"""Faces of the friction element: where its contact points sit and what they obey."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from microslip.scenes.quantity import SceneError
from microslip.scenes.two_blades import layout
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    PointLaw,
    contact_table,
)
from microslip_mechanics.structures.frame import Frame

MOST = 4
"""contact points of a face, in the full model"""
KINDS = {"none": FRICTIONLESS, "coulomb": COULOMB, "gkf": GENERAL_KINETIC}


@dataclass(frozen=True, slots=True)
class Face:
    """A planar face of the friction element against one blade end."""

    name: str
    blade: int
    centre: Array
    axes: Array
    """rows: normal out of the friction element, in-plane tangent, axial tangent"""
    width: float
    """extent along the in-plane tangent [m]"""
    depth: float
    """extent along the axial tangent [m]"""
    static_load: float
    """normal force at rest, without friction [N]"""


def interface(rig: TwoBlades, frame: Frame, push: Array) -> Interface:
    """Return the contact points of both faces.

    ``push`` is the static force on the friction element [N], shape ``(3,)``.
    """
    return _seen(rig, frame, push, _needed)


def unpruned_interface(rig: TwoBlades, frame: Frame, push: Array) -> Interface:
    """Return contact points as many as those of the full model, which act the same.

    Where one point of a face is enough, three of its corners stand beside it, whose
    normal force and friction are computed as all others are, and are zero.
    """
    return _seen(rig, frame, push, _all)


def _faces(rig: TwoBlades, push: Array) -> tuple[Face, Face]:
    """Return face B (excited blade) and face A (follower) under a static force."""
    element, angles = rig.friction_element, (
        rig.contact.angle_excited,
        rig.contact.angle_follower,
    )  # fmt: skip
    wedge = math.sin(angles[0] + angles[1])
    made = []
    for blade, name in enumerate("BA"):
        side, angle, other = (-1.0, 1.0)[blade], angles[blade], angles[1 - blade]
        sine, cosine = math.sin(angle), math.cos(angle)
        axes = np.array(
            [[sine, side * cosine, 0.0], [cosine, -side * sine, 0.0], [0.0, 0.0, 1.0]]
        )
        centre = layout.element_centre(rig) + np.array(
            [0.0, side * element.width / 2.0, 0.0]
        )
        across = push[0] * math.cos(other) + side * push[1] * math.sin(other)
        load = across / wedge if wedge else math.inf
        made.append(
            Face(
                name, blade, centre, axes, element.height / cosine, element.depth, load
            )
        )
    return made[0], made[1]


def _seen(
    rig: TwoBlades,
    frame: Frame,
    push: Array,
    points: Callable[[TwoBlades, Face], list[tuple[Array, PointLaw]]],
) -> Interface:
    """Return the interface of both faces; ``points`` gives place and law of each."""
    rows, names, laws = [], [], []
    for face in _faces(rig, push):
        for number, (place, law) in enumerate(points(rig, face), start=1):
            element = frame.motion(layout.ELEMENT, place)
            end = frame.motion(layout.tip(rig, face.blade), place)
            rows.append(face.axes @ (element - end))
            names.append(f"{face.name}{number}")
            laws.append(law)
    return Interface(contact_table(laws), np.vstack(rows), tuple(names))


def _needed(rig: TwoBlades, face: Face) -> list[tuple[Array, PointLaw]]:
    """Return place and law of the points that the model has on a face."""
    count = MOST if rig.model == "full" else 1
    return [(place, _law(rig, face, count)) for place in _points(face, count)]


def _all(rig: TwoBlades, face: Face) -> list[tuple[Array, PointLaw]]:
    """Return the same, and idle points up to the number of the full model."""
    needed = _needed(rig, face)
    idle = replace(
        needed[0][1],
        stiffness=0.0,
        damping=0.0,
        viscous=0.0,
        constant_load=True,
        load=0.0,
    )
    corners = _points(face, MOST)[: MOST - len(needed)]
    return [*needed, *((place, idle) for place in corners)]


def _points(face: Face, count: int) -> list[Array]:
    """Return the face's centre, or four points with its rotational stiffness."""
    if count == 1:
        return [face.centre]
    half_width, half_depth = (
        extent / (2.0 * math.sqrt(3.0)) for extent in (face.width, face.depth)
    )
    return [
        face.centre
        + along * half_width * face.axes[1]
        + across * half_depth * face.axes[2]
        for along, across in ((-1, -1), (-1, 1), (1, -1), (1, 1))
    ]


def _constant_load(rig: TwoBlades, face: Face) -> float:
    """Return the load of a face's friction in model A; zero in the others."""
    if rig.model != "A":
        return 0.0
    if face.static_load < 0.0:
        raise SceneError(
            f"[rotation] lifts face {face.name} at rest ({face.static_load:.3g} N), "
            'but model = "A" keeps it pressed: give more preload.force, or model B or '
            "full"
        )
    return face.static_load


def _law(rig: TwoBlades, face: Face, count: int) -> PointLaw:
    """Return the law of one of ``count`` points of a face."""
    contact, friction = rig.contact, rig.friction
    stiffness = face.width * face.depth / contact.sigma**contact.exponent / count
    share = rig.friction_element.mass / count
    damping = math.sqrt(contact.exponent * stiffness * share)
    return PointLaw(
        stiffness=stiffness,
        exponent=contact.exponent,
        damping=2.0 * contact.damping_ratio * damping,
        damping_exponent=contact.damping_exponent,
        clamped=contact.clamped,
        friction=KINDS[friction.law],
        dynamic=friction.mu_dynamic,
        static=friction.mu_static,
        stribeck=friction.stribeck_velocity,
        stribeck_exponent=friction.stribeck_exponent,
        viscous=friction.viscous,
        threshold=friction.threshold_velocity,
        constant_load=rig.model == "A",
        load=_constant_load(rig, face) / count,
    )
