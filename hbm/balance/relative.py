"""A problem in the relative coordinates of its contacts (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.structure.condensation import condense
from hbm.structure.condensed import Condensed
from hbm.structure.tractions import Tractions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import FRICTIONLESS, RIGID, ContactPoints
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState

LOOSE, GAUGE = 1e-11, 1e-6
"""of the largest stiffness: up to which nothing holds a mean motion, and by which that
is pinned then"""
SLIGHT = 1e-9
"""of the stiffness of sliders that stick, by which what they hold is pinned besides"""


@dataclass(frozen=True, slots=True)
class RelativeProblem:
    """What harmonic balance solves, in coordinates y of the relative motion."""

    points: ContactPoints
    basis: Array
    """map from y to the points, shape (3 points, rank)"""
    selection: Array
    """map from the structure to y, shape (rank, dofs)"""
    offset: Array
    """constant displacement of the points besides y [m], shape (3 points,)"""
    condensed: Condensed
    force: ComplexArray
    """preload and −i drive: the loads of orders 0 and 1 [N], shape (2, dofs)"""
    loose: Array
    """mean motions that nothing but friction holds, orthonormal, (rank, motions)"""
    gauge: Array
    """stiffness that pins them [N/m], shape (rank, rank)"""
    rest: Array
    """y at rest [m], shape (rank,)"""
    position: Array
    """constant motion of the structure besides that by y and the loads [m], (dofs,)"""
    odd: NDArray[np.bool_] | None = None
    """which coordinates have odd harmonics only, the others even ones; None if mixed"""
    pruned: bool = True
    """whether tangents that the contacts' laws do not have are left out"""
    tractions: Tractions | None = None
    """of rigid contacts: pushes on them are the last coordinates"""
    bent: Array | None = None
    """by how much sliders that never slip are bent in the mean [m], (points, 3); none
    of them is if left out"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates."""
        return int(self.basis.shape[1])

    def contact(self, fourier: FourierBasis) -> AlternatingFrequencyTime:
        """Return the contacts evaluated with a number of harmonics and samples."""
        return AlternatingFrequencyTime(
            self.points,
            self.basis,
            fourier,
            offset=self.offset,
            odd=self.odd,
            pruned=self.pruned,
            floating=self.floating,
        )

    @property
    def floating(self) -> Floating | None:
        """How far what only friction holds has moved from rest; None if all is held.

        And how sliders are bent, if some are.
        """
        if not self.loose.size and self.bent is None:
            return None
        bent = 0.0 if self.bent is None else self.bent
        place = self.basis @ self.rest + self.offset
        return Floating(self.basis @ self.loose, place, bent)

    def smoothed(self, threshold: float) -> RelativeProblem:
        """Return the problem with no threshold velocity below the given one [m/s]."""
        if threshold == 0.0:
            return self
        least = np.maximum(self.points.threshold, threshold)
        return replace(self, points=self.points._replace(threshold=least))

    def first_harmonic(
        self, relative: ComplexArray, frequencies: Array, rows: Array
    ) -> ComplexArray:
        """Return order 1 of linear forms of the motion [m].

        ``relative`` is order 1 of y in several motions at about one frequency, shape
        ``(motions, rank)``; ``rows`` has shape ``(forms, dofs)``, the result
        ``(motions, forms)``.
        """
        motion = self.condensed.motion(1j * frequencies, relative, self.force[1:])
        seen: ComplexArray = motion @ rows.T
        return seen

    def apart(self, frequency: float) -> ComplexArray:
        """Return order 1 of the points' motion if there were no contacts [m].

        Its shape is ``(3 points,)``.
        """
        variable = np.array([1j * frequency])
        load, _ = self.condensed.loading(self.force[1:])(variable)
        stiffness = self.condensed.dynamic_stiffness(variable)
        moved = np.linalg.lstsq(stiffness[0], load[0], rcond=None)[0]
        seen: ComplexArray = self.basis @ moved
        return seen

    def map_from(self, displacement: Array) -> Array:
        """Return the map from a structure to y, shape (rank, dofs).

        ``displacement`` is its map to the points, shape ``(3 points, dofs)``. What is
        not seen in a motion, pushes on rigid contacts, has rows of zeros.
        """
        if self.tractions is None:
            return self.basis.T @ displacement
        rows, places = self.tractions.rows, self.tractions.places
        others = self.basis[:, : rows.shape[1]].T @ displacement
        seen = others + rows.T @ displacement[places]
        return np.pad(seen, ((0, len(rows)), (0, 0)))

    def restricted(
        self, kept: NDArray[np.int64], odd: NDArray[np.bool_] | None
    ) -> RelativeProblem:
        """Return the problem for some coordinates, the others staying at rest."""
        left = np.setdiff1d(np.arange(self.rank), kept)
        return replace(
            self,
            basis=np.ascontiguousarray(self.basis[:, kept]),
            selection=self.selection[kept],
            offset=self.offset + self.basis[:, left] @ self.rest[left],
            condensed=self.condensed.restricted(kept, self.force),
            loose=self.loose[kept],
            gauge=self.gauge[np.ix_(kept, kept)],
            rest=self.rest[kept],
            position=self.position + self.condensed.static[:, left] @ self.rest[left],
            odd=odd,
            tractions=self.tractions and self.tractions.restricted(kept),
        )


def relative_problem(
    problem: Problem,
    rest: StaticState,
    known: RelativeProblem | None = None,
    like: Array | None = None,
) -> RelativeProblem:
    """Return the problem in relative coordinates; ``rest`` is its equilibrium.

    ``known`` is one of the same structure and contact geometry, if there is one;
    ``like`` is a basis of others, to which that of the problem is turned.
    """
    condensed: Condensed
    if known is None:
        basis, selection = problem.interface.relative_motion()
        if like is not None and like.shape == basis.shape:
            turn, _ = scipy.linalg.orthogonal_procrustes(basis, like)
            basis, selection = basis @ turn, turn.T @ selection
        condensed = condense(problem, selection)
    else:
        basis, selection, condensed = known.basis, known.selection, known.condensed
    force = np.array([problem.preload, -1j * problem.drive])
    rank = basis.shape[1]
    made = RelativeProblem(
        problem.interface.points,
        basis,
        selection,
        np.zeros(basis.shape[0]),
        condensed,
        force,
        np.zeros((rank, 0)),
        np.zeros((rank, rank)),
        selection @ rest.displacement,
        np.zeros(problem.structure.dofs),
    )
    return pinned(made)


def pinned(problem: RelativeProblem) -> RelativeProblem:
    """Return the problem with mean motions that nothing but friction holds pinned.

    Without a rope, say, the mean position of the friction element is arbitrary;
    pinning it changes no force as long as no mean force acts along it. What sticks
    holds it besides, where friction remembers.
    """
    rank = problem.rank
    if rank == 0:
        return problem
    contact = replace(problem, points=_sliding(problem.points)).contact(
        FourierBasis(1, 8)
    )
    contact(np.vstack([problem.rest, np.zeros((2, rank))]), 1.0)
    held = problem.condensed.stiffness + contact.tangents.means()[0]
    sizes, directions = np.linalg.eigh((held + held.T) / 2.0)
    largest = max(float(sizes[-1]), np.finfo(float).tiny)
    loose = directions[:, np.abs(sizes) <= LOOSE * largest]
    if sizes[-1] <= 0.0:
        largest = float(np.abs(np.diag(problem.condensed.mass)).max())
    sticking, loose = _sticking(problem, loose)
    pins = np.where(sticking > LOOSE * largest, SLIGHT * sticking, GAUGE * largest)
    return replace(problem, loose=loose, gauge=(loose * pins) @ loose.T)


def _sticking(problem: RelativeProblem, loose: Array) -> tuple[Array, Array]:
    """Return the stiffness that sticking sliders have along motions, and these.

    They are turned until it is diagonal.
    """
    points = problem.points
    stiffness = np.where(remembers(points), points.tangential, 0.0)
    springs = np.outer(stiffness, [0.0, 1.0, 1.0]).ravel()
    seen = problem.basis @ loose
    sizes, turn = np.linalg.eigh(seen.T @ (springs[:, None] * seen))
    return sizes, loose @ turn


def _sliding(points: ContactPoints) -> ContactPoints:
    """Return the points with rigid ones free to slide: they hold no mean position."""
    rigid = points.friction == RIGID
    return points._replace(friction=np.where(rigid, FRICTIONLESS, points.friction))
