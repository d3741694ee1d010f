"""A traced curve with what happens on it: responses in order, events among them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from hbm.continuation.arc import Metric
from hbm.continuation.correction import Correction
from hbm.continuation.segment import folds
from hbm.curves.cycle_errors import CycleErrors
from hbm.curves.last_points import LastPoints
from hbm.curves.response import response
from hbm.events.crossed import BRANCH, TORUS, crossings
from hbm.events.crossings import ASTRAY
from hbm.events.events import Events
from hbm.events.multipliers import Multipliers
from hbm.events.settled import Settled
from hbm.events.summits import Summits
from hbm.events.told_events import ToldEvents
from hbm.forces.contact_cycle import ContactCycle
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.points import ONE_SIDED
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

if TYPE_CHECKING:
    from hbm.curves.residual_range import ResidualRange

ASIDE = 0.05
"""distance of complex multipliers from the unit circle at which there is no torus"""


@dataclass(frozen=True, slots=True)
class Curve:
    """What turns the corrections of a trace into periodic responses."""

    problem: Problem
    system: AdaptiveBalance
    resolution: PathResolution
    multipliers: Multipliers
    events: Events | None
    """what finds them, if they are wanted"""
    residual_range: ResidualRange | None
    """what finds that of amplitudes, if it is wanted"""
    limits: tuple[float, float]
    """of the parameter"""
    contact_errors: bool
    """whether the errors of energies and normal forces are estimated"""

    def followed(
        self, corrections: Iterable[Correction], metric: Metric, beginning: str = ""
    ) -> Iterator[PeriodicResponse]:
        """Yield the response at each point, and at each event between two points.

        More harmonics may have one beyond the limits: it is left out. ``beginning``
        marks the first point; one that begins anew tells how many it replaces.
        """
        before: Settled | None = None
        summits, told = Summits(self.problem.probes.rows), ToldEvents()
        points = LastPoints(self.limits)
        for correction in corrections:
            undone = points.taken_back(correction.replaces)
            told.forget(undone)
            events: list[PeriodicResponse] = []
            mark = beginning if before is None else "restart"
            if self.residual_range and not correction.joined:
                self.residual_range.begin()
            made, after = self.made(correction, "" if correction.joined else mark)
            if self.events and correction.tangent is not None:
                after = self.events.directed(after, metric)
            if self.events and before is not None and correction.joined:
                found = list(self._between(before, after, metric))
                rising = folds(before.correction) > 0.0
                events += told.fresh(summits.among(found, made), rising=rising)
                changed = crossings(before.multipliers, after.multipliers)
                folded = any(each.event == "fold" for each in found)
                after = after._replace(owes=folded and not changed)
            else:
                summits.begin(made)
            made = replace(made, replaces=len(undone)) if undone else made
            yield from points.added([*events, made])
            before = after

    def _between(
        self, before: Settled, after: Settled, metric: Metric
    ) -> Iterator[PeriodicResponse]:
        """Yield the responses at what happens between two points."""
        if self.events is None:
            return
        for event in self.events.between(before, after, metric):
            told, _ = self.made(event.correction, event.name)
            if _confirmed(event.name, told.multipliers):
                error = told.error + event.aside
                yield replace(told, error=error, parameter_error=event.error)

    def made(
        self, correction: Correction, event: str
    ) -> tuple[PeriodicResponse, Settled]:
        """Return the response at a settled point, and what events beside it need."""
        kept, fourier, error = self.system.report.kept(correction.point)
        balance, point = self.resolution.at(fourier).at_frequency(kept)
        made = replace(
            response(self.problem, balance, replace(correction, point=point)),
            error=error,
            event=event,
            parameter=float(kept[-1]),
        )
        settled = self.system.settled
        coarser = (correction.point, settled) if settled != fourier else None
        told, finer = self._examined(made, kept, fourier, coarser, correction.tangent)
        if self.contact_errors:
            told = self._with_errors(told, correction.point)
        if self.residual_range and told.unstable <= 0:
            told = replace(told, residual_range=self.residual_range.at(kept))
        asks = finer != fourier
        return told, Settled(
            correction, settled, told.multipliers, finer, asks, correction, settled
        )

    def _with_errors(self, told: PeriodicResponse, point: Array) -> PeriodicResponse:
        """Return the response at a settled point with the errors of its contacts."""
        errors = CycleErrors(self.resolution, self.system.report, point).of(
            ContactCycle(
                told.normal_smallest,
                told.normal_largest,
                told.friction_energy,
                told.damping_energy,
            )
        )
        return replace(
            told,
            friction_error=errors.friction,
            damping_error=errors.normal_damping,
            normal_error=np.maximum(errors.normal_smallest, errors.normal_largest),
        )

    def examined(
        self, known: PeriodicResponse, point: Array
    ) -> tuple[PeriodicResponse, FourierBasis]:
        """Return a response with its multipliers, and the resolution they have.

        ``point`` is where it lies. Friction that was smooth for the curve is what it is
        here, where that converges.
        """
        fourier = FourierBasis(known.harmonics, known.samples)
        orbit = self.multipliers.orbits.finer(point, fourier)
        return self._examined(known, point if orbit is None else orbit, fourier)

    def _examined(
        self,
        made: PeriodicResponse,
        point: Array,
        fourier: FourierBasis,
        coarser: tuple[Array, FourierBasis] | None = None,
        along: Array | None = None,
    ) -> tuple[PeriodicResponse, FourierBasis]:
        """Return a response with its multipliers, and the resolution they ask for.

        ``coarser`` is the orbit with fewer harmonics, and ``along`` the tangent of its
        curve, if they are known.
        """
        points = self.problem.interface.points
        presses = (points.normal == ONE_SIDED) & (points.stiffness > 0.0)
        multipliers, finer, confirmed = self.multipliers.sure(
            point, fourier, made.normal_smallest[presses], coarser, along
        )
        error = made.error if confirmed else np.inf
        return replace(made, error=error, multipliers=multipliers), finer


def _confirmed(event: str, multipliers: ComplexArray) -> bool:
    """Return whether the multipliers of an orbit as it is reported are its event's.

    On the orbits of fewer harmonics by which it was located one is +1 at a branch
    point: beside a fold, that may be nothing but the fold. A pair that has met on the
    real axis outside the circle, from where one goes through the fold, is no torus.
    """
    if event == BRANCH:
        return bool((np.abs(multipliers - 1.0) < ASTRAY).any())
    if event == TORUS:
        off = np.abs(np.abs(multipliers[multipliers.imag != 0.0]) - 1.0)
        return bool((off < ASIDE).any())
    return True
