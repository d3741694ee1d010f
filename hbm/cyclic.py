"""One sector of a bladed disk in place of all: condensation order by order (theory §6).

Order k of a response that travels around the disk has kE nodal diameters: the next
sector moves like this one, ahead by k·2πE/N. Structure and contacts see that as
Hermitian matrices and complex maps, others for each kE mod N.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from hbm.condensed import Loading
from hbm.errors import hertz, placed
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.path import AlongFrequency, among
from hbm.relative import RelativeProblem, held_mean_positions
from hbm.tracer import Tracer
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.cyclic import CyclicProblem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState, static_equilibrium

HELD = 1e-9
"""relative size below which a contact does not see a wave"""


def cyclic_response(
    problem: CyclicProblem, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses of one sector along a frequency response curve.

    The other sectors move like it, each ahead of the one before by ``problem.lead``.
    Floquet multipliers are not computed: a disturbance need not travel like that.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    ValueError
        If a frequency is not positive, or the contacts see a wave in part only.
    """
    standing = problem.standing()
    path = along_sector(problem, options.start, options.end, pruned=options.pruned)
    tracer = Tracer(standing, path, replace(options, stability=False))
    with one_thread(), placed(hertz):
        yield from tracer.responses()


def along_sector(
    problem: CyclicProblem, start: float, end: float, *, pruned: bool = True
) -> AlongFrequency:
    """Return the path of a sector's curve between two frequencies [rad/s]."""
    standing = problem.standing()
    whole = cyclic_problem(problem, static_equilibrium(standing))
    relative = replace(whole, pruned=pruned)
    return among(standing, relative, start, abs(end - start), symmetry=pruned)


def cyclic_problem(problem: CyclicProblem, rest: StaticState) -> RelativeProblem:
    """Return the problem of one sector in the relative coordinates of its contacts."""
    seen = np.hstack([problem.interface.displacement, problem.to_next])
    basis, selection = replace(problem.interface, displacement=seen).relative_motion()
    own, following = np.split(selection, 2, axis=1)
    condensed = CyclicStructure(problem, own, following)
    rank = basis.shape[1]
    made = RelativeProblem(
        problem.interface.points,
        basis,
        own + following,
        np.zeros(basis.shape[0]),
        condensed,
        np.array([problem.preload, -1j * problem.drive]),
        np.zeros((rank, rank)),
        (own + following) @ rest.displacement,
        np.zeros(problem.sector.dofs),
    )
    return replace(made, gauge=held_mean_positions(made))


class CyclicStructure:
    """Dynamic stiffness that relative coordinates see, for each order another wave."""

    def __init__(self, problem: CyclicProblem, own: Array, following: Array) -> None:
        """Plan for contacts that see a sector by ``own`` and the next by ``following``.

        Both have shape ``(rank, dofs)``.
        """
        self._problem, self._own, self._following = problem, own, following
        self._waves: dict[int, _Wave] = {}
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

    def _orders(self, variable: ComplexArray) -> list[_Wave]:
        """Return the wave of each variable; the smallest but zero is of order 1."""
        sizes = np.abs(variable)
        orders = sizes / sizes[sizes > 0.0].min(initial=np.inf)
        return [self._wave(order) for order in np.rint(orders).astype(int).tolist()]

    def _wave(self, order: int) -> _Wave:
        """Return the sector for the wave of one order."""
        problem = self._problem
        diameters = order * problem.engine_order % problem.sectors
        if diameters not in self._waves:
            self._waves[diameters] = self._made(
                2.0 * np.pi * diameters / problem.sectors
            )
        return self._waves[diameters]

    def _made(self, angle: float) -> _Wave:
        rows = self._own + np.exp(1j * angle) * self._following
        sizes = np.linalg.norm(rows, axis=1)
        largest = float(
            np.abs(self._own).max(initial=0.0)
            + np.abs(self._following).max(initial=0.0)
        )
        sees = np.flatnonzero(sizes > HELD * largest)
        matrices = (
            self._problem.wave("stiffness", angle),
            self._problem.wave("damping", angle),
            self._problem.wave("mass", angle),
        )
        return _Wave(sees, matrices, *_split(matrices[0], rows[sees]))


@dataclass(frozen=True, slots=True)
class _Wave:
    """The sector for one number of nodal diameters: u = T y + N z."""

    sees: NDArray[np.int64]
    """relative coordinates that such a wave moves"""
    matrices: tuple[ComplexArray, ComplexArray, ComplexArray]
    """K, C, M of the sector"""
    static: ComplexArray
    """T, shape (dofs, seen)"""
    free: ComplexArray
    """N, shape (dofs, stuck)"""

    def ways(
        self, s: complex
    ) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
        """Return u from y, y's load from a load, K + sC + s²M and its derivative."""
        whole, slope = self._whole(s)
        back = self.free.conj().T
        inner = back @ whole @ self.free
        into = self.static - self.free @ np.linalg.solve(
            inner, back @ whole @ self.static
        )
        left = self.static.conj().T
        out = left - np.linalg.solve(inner.T, (left @ whole @ self.free).T).T @ back
        return into, out, whole, slope

    def stuck(self, s: complex, force: ComplexArray) -> ComplexArray:
        """Return the motion under a load while y is held, shape (dofs,)."""
        whole, _ = self._whole(s)
        back = self.free.conj().T
        motion: ComplexArray = self.free @ np.linalg.solve(
            back @ whole @ self.free, back @ force
        )
        return motion

    def _whole(self, s: complex) -> tuple[ComplexArray, ComplexArray]:
        stiffness, damping, mass = self.matrices
        return stiffness + s * damping + s * s * mass, damping + 2.0 * s * mass


def _split(
    stiffness: ComplexArray, selection: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return T (static response to y = selection u) and N (motion with y = 0).

    Raises
    ------
    ValueError
        If the contacts see a wave in part only, or the sector is free while they stick.
    """
    dofs = len(stiffness)
    if len(selection) == 0:
        return np.zeros((dofs, 0), complex), np.eye(dofs, dtype=complex)
    if np.linalg.matrix_rank(selection, 1e-8) < len(selection):
        raise ValueError(
            "the contacts of a sector do not move independently in every wave around "
            "the disk: solve the whole disk"
        )
    free = scipy.linalg.null_space(selection)
    stuck = free.conj().T @ stiffness @ free
    rigidity = scipy.linalg.eigvalsh(stuck)
    if rigidity.size and rigidity[0] <= 1e-12 * rigidity[-1]:
        raise ValueError(
            "a sector can move freely while all contacts stick: clamp it somewhere"
        )
    direct = np.linalg.pinv(selection)
    static = direct - free @ np.linalg.solve(stuck, free.conj().T @ stiffness @ direct)
    return static, free
