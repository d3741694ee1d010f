"""Bladed disks: equal sectors around an axis, driven by an engine order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import repeated_points
from microslip_mechanics.loads.engine_order import phasor
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.structure import Structure


@dataclass(frozen=True, slots=True)
class Coupling:
    """Blocks of the disk's matrices that tie a sector to the next one."""

    mass: Array
    """shape (dofs, dofs): rows of a sector, columns of the next one [kg]"""
    damping: Array
    """[N s/m]"""
    stiffness: Array
    """[N/m]"""


@dataclass(frozen=True, slots=True, eq=False)
class CyclicProblem:
    """N equal sectors; each moves like the one before, earlier by 2π E/N of a period.

    The relative motion of a contact is ``interface.displacement`` of its sector and
    ``to_next`` of the next one. Thomas, D. L. (1979): Dynamics of rotationally periodic
    structures; Petrov (2004) for contacts between sectors.
    """

    sectors: int
    """N"""
    engine_order: int
    """E, excitation waves around the disk"""
    sector: Structure
    """diagonal blocks of the disk's matrices"""
    coupling: Coupling
    interface: Interface
    """contacts of one sector, and what they see of it"""
    to_next: Array
    """what they see of the next sector, shape (3 points, dofs)"""
    preload: Array
    """static load on each sector [N], shape (dofs,)"""
    drive: Array
    """amplitude of the harmonic load [N], shape (dofs,)"""
    probes: Probes
    """of one sector"""

    def __post_init__(self) -> None:
        """Check shapes and numbers."""
        if self.sectors < 2:
            raise ValueError(f"{self.sectors} sectors: give at least 2")
        dofs = self.sector.dofs
        for name in ("mass", "damping", "stiffness"):
            block = getattr(self.coupling, name)
            if block.shape != (dofs, dofs):
                raise ValueError(
                    f"coupling.{name} has shape {block.shape}, but a sector has {dofs} "
                    "degrees of freedom: give a row and a column for each"
                )
        if self.to_next.shape != self.interface.displacement.shape:
            raise ValueError(
                f"to_next has shape {self.to_next.shape}, but the contacts see the "
                f"sector by {self.interface.displacement.shape}: give the same"
            )
        for name in ("preload", "drive"):
            load = getattr(self, name)
            if load.shape != (dofs,):
                raise ValueError(
                    f"{name} has shape {load.shape}, but a sector has {dofs} degrees "
                    "of freedom: give a load for each"
                )

    @property
    def lead(self) -> float:
        """Phase by which the next sector is ahead [rad]."""
        return 2.0 * np.pi * (self.engine_order % self.sectors) / self.sectors

    def wave(self, name: str, angle: float) -> ComplexArray:
        """Return a matrix of the disk for motions e^{i j angle} of sector j."""
        own, tie = getattr(self.sector, name), getattr(self.coupling, name)
        turn = np.exp(1j * angle)
        wave: ComplexArray = own + turn * tie + np.conj(turn) * tie.T
        return wave

    def standing(self) -> Problem:
        """Return the problem of one sector when all move alike: its statics."""
        mass, damping, stiffness = (
            self.wave(name, 0.0).real for name in ("mass", "damping", "stiffness")
        )
        seen = self.interface.displacement + self.to_next
        return Problem(
            Structure(mass, damping, stiffness, self.sector.names),
            replace(self.interface, displacement=seen),
            self.preload,
            self.drive,
            self.probes,
        )

    def disk(self, mistuning: Array | None = None) -> Problem:
        """Return the whole disk, every sector with its own degrees of freedom.

        Parameters
        ----------
        mistuning
            Relative change of the stiffness of each sector's own block, shape
            ``(sectors,)``; a tuned disk if left out.
        """
        count, eye = self.sectors, np.eye(self.sectors)
        ahead = np.roll(eye, 1, axis=1)
        change = np.zeros(count) if mistuning is None else mistuning

        def whole(name: str, factors: Array) -> Array:
            tie = np.kron(ahead, getattr(self.coupling, name))
            return np.kron(np.diag(factors), getattr(self.sector, name)) + tie + tie.T

        names = [f"{j}.{name}" for j in range(count) for name in self.sector.names]
        structure = Structure(
            whole("mass", np.ones(count)),
            whole("damping", np.ones(count)),
            whole("stiffness", 1.0 + change),
            tuple(names),
        )
        rows = np.kron(eye, self.interface.displacement) + np.kron(ahead, self.to_next)
        order = self.engine_order
        turns = np.array([phasor(order * place, count) for place in range(count)])
        drive = np.kron(turns, self.drive)
        return Problem(
            structure,
            Interface(
                repeated_points(self.interface.points, count),
                rows,
                _numbered(self.interface.names, count),
            ),
            np.tile(self.preload, count),
            drive if drive.imag.any() else drive.real,
            Probes(_numbered(self.probes.names, count), np.kron(eye, self.probes.rows)),
        )


def _numbered(names: Sequence[str], count: int) -> tuple[str, ...]:
    return tuple(f"{name} {number}" for number in range(count) for name in names)
