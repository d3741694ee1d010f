"""Beams, rigid bodies and springs, assembled to a Structure (theory §1–3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection, beam_matrices
from microslip_mechanics.structures.rigid_body import point_motion, rigid_mass
from microslip_mechanics.structures.structure import Structure

MOTIONS = ("ux", "uy", "uz", "rx", "ry", "rz")


@dataclass(frozen=True, slots=True)
class Node:
    """A place with up to six free motions."""

    name: str
    position: Array
    """x, y, z [m]"""
    free: tuple[str, ...] = MOTIONS
    """the motions that are unknowns; the others are locked"""


@dataclass(frozen=True, slots=True)
class Beam:
    """A straight beam element between two nodes."""

    start: str
    end: str
    section: RectangularSection
    thickness_direction: Array
    """direction of the section's thickness (local z), shape (3,)"""
    mass_damping: float = 0.0
    """α [1/s] on this element's mass"""
    stiffness_damping: float = 0.0
    """β [s] on this element's stiffness"""


@dataclass(frozen=True, slots=True)
class RigidBody:
    """A rigid body that moves with a node."""

    node: str
    mass: float
    """[kg]"""
    inertia: Array
    """about the centre of mass, global axes [kg m²], shape (3, 3)"""
    centre: Array
    """position of the centre of mass [m], shape (3,)"""


@dataclass(frozen=True, slots=True)
class GroundSpring:
    """A spring between a node and the ground."""

    node: str
    direction: Array
    """unit vector, shape (3,)"""
    stiffness: float
    """[N/m]"""


@dataclass(frozen=True, slots=True)
class Frame:
    """Nodes and what connects them."""

    nodes: tuple[Node, ...]
    beams: tuple[Beam, ...] = ()
    bodies: tuple[RigidBody, ...] = ()
    springs: tuple[GroundSpring, ...] = ()

    def structure(self) -> Structure:
        """Assemble mass, damping and stiffness of the free motions."""
        free = self.free()
        names = tuple(f"{n.name}.{motion}" for n in self.nodes for motion in n.free)
        mass, damping, stiffness = (
            matrix[np.ix_(free, free)] for matrix in self.matrices()
        )
        return Structure(mass, damping, stiffness, names)

    def motion(self, node: str, point: Array) -> Array:
        """Return the map from the free motions to a point's displacement.

        Parameters
        ----------
        node
            The node with which the point moves rigidly.
        point
            Its position [m], shape ``(3,)``.

        Returns
        -------
        Shape ``(3, dofs)``; a force at the point enters through the transpose.

        Raises
        ------
        ValueError
            If the frame has no such node.
        """
        first = 6 * self.index(node)
        rows = np.zeros((3, 6 * len(self.nodes)))
        arm = np.asarray(point) - self.nodes[self.index(node)].position
        rows[:, first : first + 6] = point_motion(arm)
        return rows[:, self.free()]

    def index(self, name: str) -> int:
        """Return the place of a node."""
        names = [node.name for node in self.nodes]
        if name not in names:
            raise ValueError(f"no node {name!r}: give one of {', '.join(names)}")
        return names.index(name)

    def free(self) -> list[int]:
        """Return the unknowns among all six motions of all nodes."""
        return [
            6 * place + MOTIONS.index(motion)
            for place, node in enumerate(self.nodes)
            for motion in node.free
        ]

    def matrices(self) -> tuple[Array, Array, Array]:
        """Return M, C, K over all six motions of all nodes."""
        size = 6 * len(self.nodes)
        mass, damping, stiffness = (np.zeros((size, size)) for _ in range(3))
        for beam in self.beams:
            both = np.r_[self.slots(beam.start), self.slots(beam.end)]
            place = np.ix_(both, both)
            elastic, inertial = self._element(beam)
            stiffness[place] += elastic
            mass[place] += inertial
            damping[place] += (
                beam.mass_damping * inertial + beam.stiffness_damping * elastic
            )
        for body in self.bodies:
            slots = self.slots(body.node)
            arm = body.centre - self.nodes[self.index(body.node)].position
            mass[np.ix_(slots, slots)] += rigid_mass(body.mass, body.inertia, arm)
        for spring in self.springs:
            slots = self.slots(spring.node)[:3]
            along = np.outer(spring.direction, spring.direction)
            stiffness[np.ix_(slots, slots)] += spring.stiffness * along
        return mass, damping, stiffness

    def slots(self, node: str) -> NDArray[np.intp]:
        """Return the places of a node's six motions among those of all nodes."""
        return 6 * self.index(node) + np.arange(6)

    def _element(self, beam: Beam) -> tuple[Array, Array]:
        """Return stiffness and mass of a beam in global axes."""
        axes, length = self.axes(beam)
        turn = np.kron(np.eye(4), axes)
        elastic, inertial = beam_matrices(beam.section, length)
        return turn.T @ elastic @ turn, turn.T @ inertial @ turn

    def axes(self, beam: Beam) -> tuple[Array, float]:
        """Return the local axes of a beam as rows, shape (3, 3), and its length [m].

        Raises
        ------
        ValueError
            If its thickness is not across its axis.
        """
        start, end = (
            self.nodes[self.index(beam.start)],
            self.nodes[self.index(beam.end)],
        )
        axis = end.position - start.position
        length = float(np.linalg.norm(axis))
        across = float(np.abs(beam.thickness_direction @ axis))
        if across > 1e-9 * length * float(np.linalg.norm(beam.thickness_direction)):
            raise ValueError(
                f"beam {beam.start} to {beam.end}: thickness_direction "
                f"{beam.thickness_direction} is not perpendicular to the beam's axis"
            )
        local_z = beam.thickness_direction / np.linalg.norm(beam.thickness_direction)
        axes = np.array([axis / length, np.cross(local_z, axis / length), local_z])
        return axes, length
