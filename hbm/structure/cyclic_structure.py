"""The structure of one sector, condensed order by order (theory §6.6).

Order k of a response that travels around the disk has kE nodal diameters: the next
sector moves like this one, ahead by k·2πE/N. Structure and contacts see that as
Hermitian matrices and complex maps, others for each kE mod N.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from hbm.structure.condensed import Loading
from hbm.structure.sector_wave import Wave, sector_wave
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.cyclic import CyclicProblem


class CyclicStructure:
    """Dynamic stiffness that relative coordinates see, for each order another wave."""

    def __init__(self, problem: CyclicProblem, own: Array, following: Array) -> None:
        """Plan for contacts that see a sector by ``own`` and the next by ``following``.

        Both have shape ``(rank, dofs)``.
        """
        self._problem, self._own, self._following = problem, own, following
        self._waves: dict[int, Wave] = {}
        still = self._wave(0)
        rank = len(own)
        inside = np.ix_(still.sees, still.sees)
        self.stiffness, self.mass = np.zeros((2, rank, rank))
        self.static = np.zeros((own.shape[1], rank))
        adjoint = still.static.conj().T
        self.stiffness[inside] = (adjoint @ still.matrices[0] @ still.static).real
        self.mass[inside] = (adjoint @ still.matrices[2] @ still.static).real
        self.static[:, still.sees] = still.static.real

    def restricted(
        self,
        kept: NDArray[np.int64],
        force: ComplexArray,  # noqa: ARG002
    ) -> CyclicStructure:
        """Return the structure seen by some coordinates, the others held still."""
        return CyclicStructure(self._problem, self._own[kept], self._following[kept])

    def possible(self, orders: int) -> NDArray[np.bool_]:
        """Return which coordinates the waves of orders 0, 1, … move, (orders, rank)."""
        mask = np.zeros((orders, len(self._own)), dtype=bool)
        for order in range(orders):
            mask[order, self._wave(order).sees] = True
        return mask

    def dynamic_stiffness(
        self, variable: ComplexArray, wanted: NDArray[np.bool_] | None = None
    ) -> ComplexArray:
        """Return S(s) for s = ikω, k = 0, 1, …, shape (orders, rank, rank)."""
        del wanted  # a wave is solved as a whole
        rank = len(self._own)
        value = np.zeros((variable.size, rank, rank), complex)
        for order, wave in enumerate(self._orders(variable)):
            _, out, whole, _ = wave.ways(variable[order])
            value[order][np.ix_(wave.sees, wave.sees)] = out @ whole @ wave.static
        return value

    def slope(self, variable: ComplexArray, relative: ComplexArray) -> ComplexArray:
        """Return (dS/ds) y of each order, shape (orders, rank)."""
        change = np.zeros((variable.size, len(self._own)), complex)
        for order, wave in enumerate(self._orders(variable)):
            into, out, _, slope = wave.ways(variable[order])
            moved = into @ relative[order, wave.sees]
            change[order, wave.sees] = out @ (slope @ moved)
        return change

    def loading(self, force: ComplexArray) -> Loading:
        """Return how loads reach y; ``force`` [N] has shape (orders, dofs)."""
        return partial(self._load, force)

    def _load(
        self, force: ComplexArray, variable: ComplexArray
    ) -> tuple[ComplexArray, ComplexArray]:
        value, change = np.zeros((2, variable.size, len(self._own)), complex)
        for order, wave in enumerate(self._orders(variable)):
            s = variable[order]
            _, out, _, slope = wave.ways(s)
            value[order, wave.sees] = out @ force[order]
            change[order, wave.sees] = -out @ slope @ wave.stuck(s, force[order])
        return value, change

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return the motion of the sector from y and the loads, (orders, dofs)."""
        rows, loads = [], np.broadcast_to(force, (variable.size, force.shape[1]))
        for place, wave in enumerate(self._orders(variable)):
            s = variable[place]
            into, _, _, _ = wave.ways(s)
            rows.append(into @ relative[place, wave.sees] + wave.stuck(s, loads[place]))
        return np.array(rows)

    def _orders(self, variable: ComplexArray) -> list[Wave]:
        """Return the wave of each variable; the smallest but zero is of order 1."""
        sizes = np.abs(variable)
        orders = sizes / sizes[sizes > 0.0].min(initial=np.inf)
        return [self._wave(order) for order in np.rint(orders).astype(int).tolist()]

    def _wave(self, order: int) -> Wave:
        """Return the sector for the wave of one order."""
        problem = self._problem
        diameters = order * problem.engine_order % problem.sectors
        if diameters not in self._waves:
            angle = 2.0 * np.pi * diameters / problem.sectors
            self._waves[diameters] = sector_wave(
                problem, self._own, self._following, angle
            )
        return self._waves[diameters]
