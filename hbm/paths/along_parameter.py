"""A path along a parameter of the problem, at one excitation frequency (§6.2)."""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import copy

import numpy as np
from numpy.typing import NDArray

from hbm.balance.active import extended, linear_amplitude, moving, symmetric
from hbm.balance.parametric import ParametricBalance
from hbm.balance.relative import RelativeProblem
from hbm.balance.relative_problem import relative_problem
from hbm.balance.rigid import with_pushes
from hbm.errors import PLACE, ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.paths.unchanged import one_equilibrium, one_structure
from hbm.stability.stability import SmallMotions, small_motions
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState, static_equilibrium

WIDE = 10.0
"""ratio of two values from which equal ratios, not differences, count as equal"""
FAINT = 0.1
"""of the largest drive, below which vibrations count as they do there"""
PAST = 8
"""problems that are remembered"""


class AlongParameter:
    """A problem that depends on a parameter; its excitation frequency stays.

    The structure is condensed anew only where the parameter changes it.
    """

    def __init__(
        self,
        problem_at: Callable[[float], Problem],
        frequency: float,
        start: float,
        end: float,
    ) -> None:
        """Plan for parameters from ``start`` to ``end`` at ``frequency`` [rad/s].

        Raises
        ------
        ValueError
            If the frequency is not positive.
        """
        if frequency <= 0.0:
            raise ValueError(f"frequency {frequency:g} rad/s: give a positive one")
        self._problem_at, self._frequency = problem_at, frequency
        self._limits = min(start, end), max(start, end)
        self._last: tuple[Problem, RelativeProblem, StaticState] | None = None
        self._motions: tuple[Problem, SmallMotions] | None = None
        self._basis: Array | None = None
        self._past: dict[float, RelativeProblem] = {}
        values = (start, 0.5 * (start + end), end)
        seen, self._loudest = [], (0.0, 0.0)
        for problem in map(self._whole, values):
            seen.append(moving(problem, frequency))
            loud = largest(problem.force[1]), linear_amplitude(problem, frequency)
            self._loudest = max(self._loudest, loud)
        active = np.logical_or.reduce(seen)
        self._kept, self._odd = symmetric(active)
        self._active = active[:, self._kept]
        self.rank = self._kept.size

    def at(self, parameter: float) -> tuple[RelativeProblem, float]:
        """Return the problem at one value of the range, or its end, and the frequency.

        Steps along a curve may lead beyond the range, where there may be no problem.
        """
        parameter = float(np.clip(parameter, *self._limits))
        if parameter not in self._past:
            while len(self._past) >= PAST:
                self._past.pop(next(iter(self._past)))
            whole = self._whole(parameter)
            self._past[parameter] = whole.restricted(self._kept, self._odd)
        return self._past[parameter], self._frequency

    def beyond(self, parameter: float) -> AlongParameter:
        """Return the path up to a value beyond its range.

        Where nobody asked for a problem none may be made, for whatever cause.
        """
        path, problem_at = copy(self), self._problem_at

        def made(value: float) -> Problem:
            try:
                return problem_at(value)
            except Exception as error:  # a user's function may fail in any way
                raise ValueError(str(error)) from error

        low, high = self._limits
        path._problem_at, path._past = made, {}
        path._limits = min(low, parameter), max(high, parameter)
        return path

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""
        return extended(self._active, harmonics)

    def in_all(self) -> tuple[AlongParameter, NDArray[np.int64]]:
        """Return the path in all coordinates and orders, and which of them are kept."""
        rank = self._whole(self._limits[0]).rank
        if self._active.all() and self.rank == rank:
            return self, self._kept
        path = copy(self)
        path._kept, path._odd = np.arange(rank), None
        path._active = np.ones((len(self._active), rank), dtype=bool)
        path.rank, path._past = rank, {}
        return path, self._kept

    def balance(self, fourier: FourierBasis) -> ParametricBalance:
        """Return harmonic balance at one resolution."""
        return ParametricBalance(
            self.at, fourier, self.mask(fourier.harmonics), self.unit, self._limits
        )

    def unit(self, parameter: float) -> float:
        """Return a tenth of the range, or the same share of its logarithm."""
        low, high = self._limits
        if self._by_ratios:
            return max(parameter, 0.1 * low) * math.log(high / low) / 10.0
        return (high - low) / 10.0

    @property
    def _by_ratios(self) -> bool:
        """Whether equal ratios of the parameter count as equal, not differences."""
        low, high = self._limits
        return low > 0.0 and high > WIDE * low

    def measure(self, vibration: float, parameter: float) -> float:
        """Return a vibration, or about that under a faint drive where it is less.

        As the drive vanishes all does: steps by shares of it would not come to an end,
        unless the parameter is followed by shares as well.
        """
        if self._by_ratios:
            return vibration
        drive, amplitude = self._loudest
        problem, _ = self.at(parameter)
        share = largest(problem.force[1]) / drive if drive > 0.0 else 1.0
        if share >= FAINT:
            return vibration
        if share > 0.0:  # it may be less than the linear one
            amplitude = min(amplitude, vibration / share)
        return max(vibration, FAINT * amplitude)

    def motions(self, parameter: float) -> SmallMotions:
        """Return the structure for small motions."""
        problem = self._problem(parameter)
        if self._motions is None or not one_structure(problem, self._motions[0]):
            self._motions = problem, small_motions(problem)
        return self._motions[1]

    def _problem(self, parameter: float) -> Problem:
        """Return the problem at a value of the range, or its end.

        Raises
        ------
        ContinuationError
            If there is none.
        """
        parameter = float(np.clip(parameter, *self._limits))
        try:
            return self._problem_at(parameter)
        except (MicroslipError, ValueError) as error:
            text = f"there is no problem at {PLACE}: {error}"
            raise ContinuationError(text, parameter) from error

    def _whole(self, parameter: float) -> RelativeProblem:
        """Return the problem at one value, in all relative coordinates."""
        problem = self._problem(parameter)
        known = rest = None
        if self._last is not None:
            earlier, known, rest = self._last
            if not one_equilibrium(problem, earlier):
                rest = None
            if not one_structure(problem, earlier):
                known = rest = None
        rest = rest or static_equilibrium(problem)
        made = relative_problem(problem, rest, known, self._basis)
        self._basis = made.basis if self._basis is None else self._basis
        self._last = problem, made, rest
        return with_pushes(made, self._frequency)
