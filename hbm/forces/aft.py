"""Alternating frequency/time: contact forces and their tangents (theory §6.1)."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hbm.forces.contact_cycle import ContactCycle, contact_cycle
from hbm.forces.fourier import FourierBasis
from hbm.forces.last_call import LastCall
from hbm.forces.marched import marched
from hbm.forces.sampled_tangents import SampledTangents
from hbm.forces.sampling import sample, sample_smooth
from hbm.forces.symmetry import still_holds, symmetry
from hbm.forces.tangent_entries import kinds, tangent_entries
from hbm.forces.traces import Traces
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.points import RIGID, ContactPoints, smooth
from microslip_mechanics.errors import MicroslipError

if TYPE_CHECKING:
    from hbm.forces.memory import FrictionMemory
    from hbm.forces.remembered import Remembered


class AlternatingFrequencyTime:
    """Contact points evaluated over the samples of one period.

    Arrays that a call returns as samples are buffers, valid until the next call.
    """

    def __init__(
        self,
        points: ContactPoints,
        basis: Array,
        fourier: FourierBasis,
        *,
        offset: Array | None = None,
        odd: NDArray[np.bool_] | None = None,
        pruned: bool = True,
        floating: Floating | None = None,
    ) -> None:
        """Plan the transforms.

        Parameters
        ----------
        points
            Contact table.
        basis
            Map from the coordinates y to the points, shape ``(3 points, rank)``.
        fourier
            Harmonics and samples.
        offset
            Constant displacement of the points besides y [m], ``(3 points,)``.
        odd
            Which coordinates have odd harmonics only, the others even ones only,
            shape ``(rank,)``: half a period then says all. None without that symmetry.
        pruned
            Whether tangents and transitions that the laws do not have are left out.
        floating
            Mean motions that only what remembers holds; none if left out.

        Raises
        ------
        MicroslipError
            If a contact is rigid: its traction does not follow from the motion.
        """
        _refuse_rigid(points)
        samples = self.samples = fourier.samples
        self.points, self.basis, self._fourier = points, basis, fourier
        self._offset = np.zeros(len(basis)) if offset is None else offset
        self._odd, self._pruned = odd, pruned
        self.smooth = pruned and smooth(points)
        """whether no contact changes its state between samples"""
        recalls = bool(marched(points).any())
        self._memory = _memory(basis, fourier, floating) if recalls else None
        entries = tangent_entries(points, pruned)
        halves = None if recalls or samples % 2 else odd
        self.symmetry = symmetry(points, self._offset, basis, entries, halves)
        """what half a period later looks like"""
        signs = np.empty(0)
        if odd is not None and self.symmetry.holds:
            signs = np.where(odd, -1.0, 1.0)
        self._traces = Traces(basis, fourier, signs)
        self.tangents = SampledTangents(basis, entries, self.symmetry, signs, samples)
        """of the last call"""
        self.frequency = np.nan
        """of the last call [rad/s]"""
        still = np.zeros((2, len(basis), samples))
        self.moved: tuple[Array, Array] = (still[0], still[1])
        """displacement [m] and velocity [m/s] of the points in the last call, shape
        (3 points, samples) each; with a symmetry samples of the second half of the
        period may be left out"""
        self._last: LastCall | None = None

    def with_points(
        self, points: ContactPoints, offset: Array, floating: Floating | None = None
    ) -> AlternatingFrequencyTime:
        """Return the same for other values of the contacts.

        Both share buffers, unless other tangents are needed or a symmetry is lost.
        """
        alike = still_holds(self.symmetry, points, offset)
        if not (alike and np.array_equal(kinds(points), kinds(self.points))):
            return AlternatingFrequencyTime(
                points,
                self.basis,
                self._fourier,
                offset=offset,
                odd=self._odd,
                pruned=self._pruned,
                floating=floating,
            )
        other = copy.copy(self)
        other.points, other._offset, other._last = points, offset, None
        if self._memory is not None:
            other._memory = _memory(self.basis, self._fourier, floating)
        return other

    def __call__(
        self, coefficients: Array, frequency: float, decay: float = 0.0
    ) -> Array:
        """Return the coefficients of the force on y [N], shape (2H + 1, rank).

        Parameters
        ----------
        coefficients
            Of y [m], shape ``(2H + 1, rank)``.
        frequency
            Excitation frequency ω [rad/s]; turns the derivative by phase into velocity.
        decay
            Rate β [1/s] at which the motion about its mean dies away: it slows the
            velocity by β times that motion (theory, eq. 27).
        """
        last, motion = self._last, (frequency, decay)
        if last is not None and last.answers(self.calls, motion, coefficients):
            return last.force
        force = self._evaluated(coefficients, frequency, decay)
        self._last = LastCall(self.calls, motion, coefficients.copy(), force)
        return force

    def by_frequency(self) -> Array:
        """Return ∂force/∂ω [N s/rad] of the last call, shape (2H + 1, rank).

        It is that of a steady motion.
        """
        return self._traces.changes() / self.frequency

    @property
    def calls(self) -> int:
        """Number of calls so far: of this one and of what shares its buffers."""
        return self._traces.calls

    def add_remembered(self, places: NDArray[np.int64], jacobian: Array) -> None:
        """Add ∂force/∂y of the last call by what the contacts remember.

        ``places``, shape ``(2h + 1, rank)`` with h ≤ H, are the rows and columns of the
        coefficients in ``jacobian``; negative ones are left out.
        """
        if self._memory is not None:
            self._memory.add_jacobian(
                self.points, self.moved, self.frequency, places, jacobian
            )

    def remembered(self) -> Remembered | None:
        """Return what multiplies by that derivative; None if nothing remembers."""
        if self._memory is None:
            return None
        return self._memory.remembered(self.points, self.moved, self.frequency)

    def small_tangents(self, order: int = 1) -> tuple[Array, Array]:
        """Return what a small motion about that of the last call feels in the mean.

        By y [N/m] and by ẏ [N s/m], shape ``(rank, rank)`` each. What contacts remember
        is a spring for a small motion of that order.
        """
        elastic, viscous = (mean.copy() for mean in self.tangents.means())
        rank = len(elastic)
        cosines = np.full((self._fourier.coefficients, rank), -1)
        cosines[2 * order - 1] = np.arange(rank)
        self.add_remembered(cosines, elastic)
        return elastic, viscous

    @property
    def floating(self) -> Floating | None:
        """Mean motions that only what remembers holds."""
        return None if self._memory is None else self._memory.floating

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses [N] of the last call.

        They are forces integrated over the phase. Orders up to ``above`` are left out,
        ``most`` is the highest one.
        """
        force = self._traces.force(most)
        orders = (np.arange(2 * above + 1, 2 * most + 1) + 1) // 2
        return float(np.linalg.norm(force[2 * above + 1 :] / orders[:, None]))

    def cycle(self, coefficients: Array, frequency: float) -> ContactCycle:
        """Return normal forces and energies over one period."""
        self(coefficients, frequency)
        forces = self._traces.regular.force + self._traces.extra.force
        period = 2.0 * np.pi / frequency
        cycle = contact_cycle(self.points, self.moved, forces, self.telling, period)
        # in the other half a point does what its mirror image did in this one
        return cycle.joined(self.symmetry.images) if self.symmetry.holds else cycle

    def _evaluated(self, coefficients: Array, frequency: float, decay: float) -> Array:
        """Return the force, and fill the buffers."""
        traces = self._traces
        displacement, velocity = traces.motion(coefficients, frequency, decay)
        displacement += self._offset[:, None]
        self.moved, self.frequency = (displacement, velocity), frequency
        given = (
            self.points,
            *self.moved,
            self.tangents.entries,
            self.tangents.bounds,
            self.symmetry,
            traces.regular,
            self.tangents.samples,
        )
        if self.smooth:
            sample_smooth(*given)
        else:
            sample(*given, traces.extra)
        if self._memory is not None:
            self._memory.add(self.points, self.moved, frequency, *traces.regular)
        return traces.forces()

    @property
    def telling(self) -> int:
        """Number of samples that tell all: those of half a period with a symmetry."""
        return self.samples // 2 if self.symmetry.holds else self.samples


def _memory(
    basis: Array, fourier: FourierBasis, floating: Floating | None
) -> FrictionMemory:
    """Return what marches friction that remembers, loaded by scenes that have some."""
    from hbm.forces.memory import FrictionMemory

    return FrictionMemory(basis, fourier, floating)


def _refuse_rigid(points: ContactPoints) -> None:
    """Raise an error if a contact is rigid."""
    if (points.friction == RIGID).any():
        raise MicroslipError(
            "rigid friction has no force of a given motion: it is solved along a "
            "frequency or a parameter; give coulomb with a small threshold_velocity "
            "here"
        )
