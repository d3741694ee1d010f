"""A frame that rotates: load, stiffening, softening, Coriolis (theory §9)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.frame import Beam, Frame
from microslip_mechanics.structures.rotating_beam import (
    rotating_beam,
    stretch,
    tension_stiffness,
)
from microslip_mechanics.structures.rotating_body import rotating_body
from microslip_mechanics.structures.rotating_part import RotatingPart
from microslip_mechanics.structures.rotation import Rotation
from microslip_mechanics.structures.structure import Structure

UNHELD = 1e-12
"""stiffness over the largest, below which nothing holds a motion"""


@dataclass(frozen=True, slots=True)
class RotatingFrame:
    """A frame and the steady rotation of the axes in which it moves."""

    frame: Frame
    rotation: Rotation

    def structure(self) -> Structure:
        """Return the structure with stiffening, softening and Coriolis terms.

        The tension of the beams is that under the centrifugal load where contacts
        carry nothing; static bending adds nothing to it.
        """
        still, part = self.frame.structure(), self._part()
        stiffness = still.stiffness + part.softening + self._stiffening(still)
        turning = bool(part.coriolis.any())
        damping = still.damping + part.coriolis
        return replace(still, damping=damping, stiffness=stiffness, gyroscopic=turning)

    def load(self) -> Array:
        """Return the centrifugal load on the free motions [N, N m], shape (dofs,)."""
        return self._part().load

    def coriolis(self) -> Array:
        """Return G, skew-symmetric, of the free motions [N s/m], shape (dofs, dofs)."""
        return self._part().coriolis

    def _part(self) -> RotatingPart:
        """Return the terms of all beams and bodies over the free motions."""
        frame, spin = self.frame, self.rotation.spin
        size = 6 * len(frame.nodes)
        load, softening, coriolis = (np.zeros((size,) * axes) for axes in (1, 2, 2))

        def add(places: NDArray[np.intp], part: RotatingPart) -> None:
            load[places] += part.load
            softening[np.ix_(places, places)] += part.softening
            coriolis[np.ix_(places, places)] += part.coriolis

        for beam in frame.beams:
            turn, local, root, length = self._local(beam)
            part = rotating_beam(beam.section, length, local, root)
            add(self._ends(beam), part.turned(turn))
        for body in frame.bodies:
            offset = body.centre - frame.nodes[frame.index(body.node)].position
            centre = body.centre - self.rotation.centre
            part = rotating_body(body.mass, body.inertia, offset, spin, centre)
            add(frame.slots(body.node), part)
        free = frame.free()
        square = np.ix_(free, free)
        return RotatingPart(load[free], softening[square], coriolis[square])

    def _stiffening(self, still: Structure) -> Array:
        """Return the stiffness by the tension of the beams over the free motions."""
        frame, free = self.frame, self.frame.free()
        size = 6 * len(frame.nodes)
        moved, stiffness = np.zeros(size), np.zeros((size, size))
        moved[free] = np.linalg.lstsq(still.stiffness, self.load(), rcond=UNHELD)[0]
        for beam in frame.beams:
            turn, local, root, length = self._local(beam)
            places = self._ends(beam)
            mean = float(stretch(beam.section, length) @ turn @ moved[places])
            tense = tension_stiffness(beam.section, length, local, root, mean)
            stiffness[np.ix_(places, places)] += turn.T @ tense @ turn
        found: Array = stiffness[np.ix_(free, free)]
        return found

    def _local(self, beam: Beam) -> tuple[Array, Array, Array, float]:
        """Return turn to local axes, W and start in them, and length of a beam."""
        axes, length = self.frame.axes(beam)
        start = self.frame.nodes[self.frame.index(beam.start)].position
        root = axes @ (start - self.rotation.centre)
        return (
            np.kron(np.eye(4), axes),
            axes @ self.rotation.spin @ axes.T,
            root,
            length,
        )

    def _ends(self, beam: Beam) -> NDArray[np.intp]:
        return np.concatenate([self.frame.slots(end) for end in (beam.start, beam.end)])
