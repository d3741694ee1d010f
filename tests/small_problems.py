"""Small problems with known answers: a mass, a mass on a contact, a clamped beam."""

import itertools

import numpy as np

from contact_tables import contact_points
from microslip_mechanics.beam import RectangularSection
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.law import ContactPoints
from microslip_mechanics.frame import Beam, Frame, Node
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structure import Structure

NORMAL, TANGENT = 0, 1
"""the direction of a contact point along which :func:`mass_on_contact` moves"""


def oscillator(
    *,
    mass: float = 2.0,
    damping: float = 0.5,
    stiffness: float = 300.0,
    preload: float = 0.0,
    drive: float = 1.5,
) -> Problem:
    """Return a mass on spring and damper, without contact; its probe is ``x``."""
    structure = _structure(mass, damping, stiffness)
    contact = Interface(contact_points(0), np.zeros((0, 1)), ())
    return _problem(structure, contact, preload, drive)


def mass_on_contact(
    points: ContactPoints,
    *,
    direction: int,
    mass: float = 2.0,
    damping: float = 0.0,
    stiffness: float = 0.0,
    preload: float = 0.0,
    drive: float = 0.0,
) -> Problem:
    """Return a mass that moves along one direction of a contact; its probe is ``x``."""
    along = np.zeros((3, 1))
    along[direction] = 1.0
    contact = Interface(points, along, ("point",))
    return _problem(_structure(mass, damping, stiffness), contact, preload, drive)


def sliding_block(
    *,
    mass: float = 2.0,
    stiffness: float = 0.0,
    damping: float = 0.0,
    drive: float = 0.0,
    **friction: float,
) -> Problem:
    """Return a block on one point with constant normal load, free to slide."""
    points = contact_points(stiffness=0.0, damping=0.0, constant_load=True, **friction)
    return mass_on_contact(
        points,
        direction=TANGENT,
        mass=mass,
        stiffness=stiffness,
        damping=damping,
        drive=drive,
    )


def cantilever(
    *, elements: int = 3, mass_damping: float = 20.0, stiffness_damping: float = 2e-5
) -> Problem:
    """Return a steel beam, clamped, without contact, driven across its tip.

    Half a metre long; the first bending modes lie near 33 and 66 Hz. The drive pulls
    along both, so that both answer.
    """
    section = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
    stations = np.linspace(0.0, 0.5, elements + 1)
    nodes = [Node("root", np.zeros(3), ())]
    nodes += [
        Node(f"{place}", np.array([station, 0.0, 0.0]))
        for place, station in enumerate(stations[1:], start=1)
    ]
    beams = tuple(
        Beam(
            start.name,
            end.name,
            section,
            np.array([0.0, 0.0, 1.0]),
            mass_damping,
            stiffness_damping,
        )
        for start, end in itertools.pairwise(nodes)
    )
    frame = Frame(tuple(nodes), beams)
    tip = frame.motion(nodes[-1].name, nodes[-1].position)
    structure = frame.structure()
    return Problem(
        structure,
        Interface(contact_points(0), np.zeros((0, structure.dofs)), ()),
        preload=np.zeros(structure.dofs),
        drive=tip.T @ np.array([0.0, 1.0, 2.0]),
        probes=Probes(("tip y", "tip z"), tip[1:]),
    )


def _structure(mass: float, damping: float, stiffness: float) -> Structure:
    one = np.eye(1)
    return Structure(mass * one, damping * one, stiffness * one, ("x",))


def _problem(
    structure: Structure, contact: Interface, preload: float, drive: float
) -> Problem:
    return Problem(
        structure,
        contact,
        preload=np.array([preload]),
        drive=np.array([drive]),
        probes=Probes(("x",), np.eye(1)),
    )
