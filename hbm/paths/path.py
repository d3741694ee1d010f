"""What a curve is followed along: the frequency, or another parameter (§6.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hbm.balance.active import PROBE, extended, moving, symmetric
from hbm.balance.balance import Balance
from hbm.balance.relative import RelativeProblem
from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.balance.rigid import with_pushes
from hbm.forces.fourier import FourierBasis
from hbm.stability.stability import SmallMotions, small_motions
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState

BROKEN = 1e-6
"""of a motion: what it has where a symmetry keeps still, beyond rounding"""


class Path(Protocol):
    """Problems along a parameter, which is the last component of each point."""

    @property
    def rank(self) -> int:
        """Number of relative coordinates that move."""

    def at(self, parameter: float) -> tuple[RelativeProblem, float]:
        """Return problem and excitation frequency [rad/s] at one place."""

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""

    def in_all(self) -> tuple[Path, NDArray[np.int64]]:
        """Return the path in all coordinates and orders, and which of them these are.

        A symmetry that keeps some still may be broken there.
        """

    def balance(self, fourier: FourierBasis) -> Balance:
        """Return the system whose curve is followed, at one resolution."""

    def unit(self, parameter: float) -> float:
        """Return the change that counts as one unit of arc."""

    def measure(self, vibration: float, parameter: float) -> float:
        """Return the change that counts as one unit of arc of a vibration."""

    def motions(self, parameter: float) -> SmallMotions:
        """Return the structure for small motions."""


@dataclass(frozen=True)
class AlongFrequency:
    """One problem; its excitation frequency changes."""

    whole: Problem
    problem: RelativeProblem
    """of what moves"""
    active: NDArray[np.bool_]
    """coefficients of the probing orders that move, (11, rank)"""
    range: float
    """of frequencies [rad/s]"""
    every: RelativeProblem
    """of all that may move"""
    kept: NDArray[np.int64]
    """which of its coordinates these are, shape (rank,)"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates that move."""
        return self.problem.rank

    def at(self, parameter: float) -> tuple[RelativeProblem, float]:
        """Return the problem, and the parameter, which is its frequency."""
        return self.problem, parameter

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""
        possible = self.problem.condensed.possible(harmonics + 1)
        rows = np.vstack([possible[:1], possible[1:].repeat(2, axis=0)])
        active: NDArray[np.bool_] = extended(self.active, harmonics) & rows
        return active

    def in_all(self) -> tuple[AlongFrequency, NDArray[np.int64]]:
        """Return the path in all coordinates and orders, and which of them are kept."""
        if self.active.all() and self.problem.rank == self.every.rank:
            return self, np.arange(self.rank)
        return _in_all(self.whole, self.every, self.range), self.kept

    def holding(self, motion: Array) -> AlongFrequency:
        """Return this path, or that in all if a motion breaks the symmetry.

        ``motion`` holds all coordinates, shape (2 harmonics + 1, rank of all).
        """
        moved = motion.copy()
        moved[0] -= self.every.rest
        moving = np.zeros(motion.shape, dtype=bool)
        moving[:, self.kept] = self.mask(len(motion) // 2)
        broken = largest(moved[~moving]) > BROKEN * largest(moved)
        return self.in_all()[0] if broken else self

    def balance(self, fourier: FourierBasis) -> HarmonicBalance:
        """Return harmonic balance at one resolution."""
        return HarmonicBalance(self.problem, fourier, self.mask(fourier.harmonics))

    def unit(self, parameter: float) -> float:  # noqa: ARG002
        """Return a tenth of the range."""
        return self.range / 10.0

    def measure(self, vibration: float, parameter: float) -> float:  # noqa: ARG002
        """Return the vibration itself."""
        return vibration

    def motions(self, parameter: float) -> SmallMotions:  # noqa: ARG002
        """Return the structure for small motions."""
        return self._motions

    @cached_property
    def _motions(self) -> SmallMotions:
        return small_motions(self.whole)

    def vibration(self, point: Array) -> float:
        """Return the size of the whole structure's first harmonic at a point."""
        cosines, sines = point[self.rank : 3 * self.rank].reshape(2, -1)
        rows, place = np.eye(self.whole.structure.dofs), point[-1:]
        first = self.problem.first_harmonic((cosines - 1j * sines)[None], place, rows)
        return float(np.linalg.norm(first))


def along_frequency(
    problem: Problem,
    rest: StaticState,
    start: float,
    end: float,
    *,
    symmetry: bool = True,
    pruned: bool = True,
) -> AlongFrequency:
    """Return the path of a frequency response curve.

    Parameters
    ----------
    problem, rest
        What is solved, and its static equilibrium.
    start, end
        Frequencies [rad/s].
    symmetry
        Whether what a symmetry keeps still is left out: a branch that breaks it needs
        all.
    pruned
        Whether anything is left out, see :class:`~hbm.options.CurveOptions`.

    Raises
    ------
    ValueError
        If a frequency is not positive.
    """
    if min(start, end) <= 0.0:
        raise ValueError(f"frequencies {start:g} and {end:g} rad/s: give positive ones")
    still = relative_problem(problem, rest)
    relative = with_pushes(replace(still, pruned=pruned), max(start, end))
    width = abs(end - start)
    return moving_path(problem, relative, start, width, symmetry=symmetry and pruned)


def moving_path(
    whole: Problem,
    relative: RelativeProblem,
    start: float,
    width: float,
    *,
    symmetry: bool,
) -> AlongFrequency:
    """Return the path of a problem's coordinates that move, or of all.

    ``start`` is the first frequency and ``width`` the range [rad/s]; a ``symmetry``
    keeps still what does not move.
    """
    if not symmetry:
        return _in_all(whole, relative, width)
    active = moving(relative, start)
    kept, odd = symmetric(active)
    problem = relative.restricted(kept, odd)
    return AlongFrequency(whole, problem, active[:, kept], width, relative, kept)


def _in_all(whole: Problem, relative: RelativeProblem, width: float) -> AlongFrequency:
    """Return the path of all coordinates and orders."""
    active = np.ones((PROBE.coefficients, relative.rank), dtype=bool)
    kept = np.arange(relative.rank)
    return AlongFrequency(whole, relative, active, width, relative, kept)
