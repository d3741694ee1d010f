"""Faces of the friction element: where its contact points sit and what they obey."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip.scenes.two_blades import layout
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ContactPoints,
)
from microslip_mechanics.frame import Frame

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


def interface(rig: TwoBlades, frame: Frame) -> Interface:
    """Return the contact points of both faces."""
    rows, names, columns = [], [], []
    for face in faces(rig):
        places = _points(face, 4 if rig.model == "full" else 1)
        for number, place in enumerate(places, start=1):
            element = frame.motion(layout.ELEMENT, place)
            end = frame.motion(layout.tip(rig, face.blade), place)
            rows.append(face.axes @ (element - end))
            names.append(f"{face.name}{number}")
            columns.append(_parameters(rig, face, len(places)))
    table = ContactPoints(*(np.array(column) for column in zip(*columns, strict=True)))
    return Interface(table, np.vstack(rows), tuple(names))


def faces(rig: TwoBlades) -> tuple[Face, Face]:
    """Return face B (excited blade) and face A (follower)."""
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
        load = rig.preload.force * math.cos(other) / wedge if wedge else math.inf
        made.append(
            Face(
                name, blade, centre, axes, element.height / cosine, element.depth, load
            )
        )
    return made[0], made[1]


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


def _parameters(rig: TwoBlades, face: Face, count: int) -> tuple[object, ...]:
    """Return one row of the contact table, in the order of its fields."""
    contact, friction = rig.contact, rig.friction
    stiffness = face.width * face.depth / contact.sigma**contact.exponent / count
    share = rig.friction_element.mass / count
    damping = math.sqrt(contact.exponent * stiffness * share)
    return (
        stiffness,
        contact.exponent,
        2.0 * contact.damping_ratio * damping,
        contact.damping_exponent,
        contact.clamped,
        KINDS[friction.law],
        friction.mu_dynamic,
        friction.mu_static,
        friction.stribeck_velocity,
        friction.stribeck_exponent,
        friction.viscous,
        friction.threshold_velocity,
        rig.model == "A",
        face.static_load / count if rig.model == "A" else 0.0,
    )
