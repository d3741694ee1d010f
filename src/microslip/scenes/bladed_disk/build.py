"""From the tables of a bladed disk to one sector, and to the whole disk."""

from __future__ import annotations

import numpy as np

from microslip.scenes.bladed_disk.tables import PARTS, BladedDisk, Friction
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import COULOMB, PointLaw, contact_table
from microslip_mechanics.cyclic import Coupling, CyclicProblem
from microslip_mechanics.laws.jenkins import slider
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.structure import Structure


def sector(rig: BladedDisk) -> CyclicProblem:
    """Return one sector of the tuned disk, which knows its neighbours."""
    table, count = rig.sector, len(PARTS)
    mass, stiffness, tie = np.diag(table.masses), _stiffness(rig), _tie(rig)
    alpha, beta = table.mass_damping, table.stiffness_damping
    tip = np.eye(count)[-1:]
    own, following = np.zeros((2, 3, count))
    own[1], following[1] = tip, -tip
    return CyclicProblem(
        rig.sectors,
        rig.drive.engine_order,
        Structure(mass, alpha * mass + beta * stiffness, stiffness, PARTS),
        Coupling(np.zeros((count, count)), beta * tie, tie),
        Interface(contact_table([_law(rig.friction)]), own, ("tip",)),
        following,
        np.zeros(count),
        rig.drive.amplitude * tip[0],
        Probes(("tip",), tip),
    )


def disk(rig: BladedDisk) -> Problem:
    """Return the whole disk, mistuned if the tables say so."""
    random = np.random.default_rng(rig.mistuning.seed)
    return sector(rig).disk(random.normal(0.0, rig.mistuning.deviation, rig.sectors))


def _stiffness(rig: BladedDisk) -> Array:
    """Return the stiffness of a sector whose neighbours are held."""
    stiffness = np.zeros((len(PARTS), len(PARTS)))
    stiffness[0, 0] = rig.sector.ground + 2.0 * rig.sector.coupling
    for place, spring in enumerate(rig.sector.springs):
        pair = slice(place, place + 2)
        stiffness[pair, pair] += spring * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return stiffness


def _tie(rig: BladedDisk) -> Array:
    """Return the stiffness by which a sector feels the next one."""
    tie = np.zeros((len(PARTS), len(PARTS)))
    tie[0, 0] = -rig.sector.coupling
    return tie


def _law(friction: Friction) -> PointLaw:
    """Return the row of one friction element."""
    if friction.law == "jenkins":
        return slider(friction.stiffness, friction.limit)
    return PointLaw(
        friction=COULOMB,
        dynamic=1.0,
        threshold=friction.threshold,
        constant_load=True,
        load=friction.limit,
    )
