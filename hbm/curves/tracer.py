"""Everything that tracing along one path needs, put together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from hbm.continuation.corrected import correct_at
from hbm.continuation.effort import Effort
from hbm.curves.curve import Curve
from hbm.curves.pieces import Pieces
from hbm.events.amplitude_growth import AmplitudeGrowth
from hbm.events.events import Events
from hbm.events.finer_orbits import FinerOrbits
from hbm.events.multipliers import Multipliers
from hbm.forces.marched import marched
from hbm.options import CurveOptions
from hbm.paths.path import Path
from hbm.paths.path_resolution import PathResolution
from hbm.paths.smoothness import smoothest
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.structure.linear_curve import Place
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import ELASTIC, RIGID
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

if TYPE_CHECKING:
    from hbm.continuation.step_control import StepControl
    from hbm.curves.residual_range import ResidualRange


class Tracer:
    """Follows a path with the accuracy that a user asks for."""

    def __init__(self, problem: Problem, path: Path, options: CurveOptions) -> None:
        """Plan for ``path``; ``problem``, one on it, says what is large."""
        self.path, self.effort = path, Effort(options.effort)
        points = problem.interface.points
        rigid = bool((points.friction == RIGID).any())
        resolution = _resolution(problem, path)
        adaptive = partial(_adaptive, problem, options, smoothest(path, options))
        self.system = adaptive(resolution, self.effort)

        def resolved(other: Path, effort: Effort) -> AdaptiveBalance:
            return adaptive(_resolution(problem, other), effort)

        drive = largest(problem.drive)
        self.control = options.control(problem.force_scale, drive)
        motions = path.motions if options.stability and not rigid else None
        multipliers = Multipliers(
            resolution,
            motions,
            FinerOrbits(resolution, self.control),
            options.harmonics is not None,
        )
        least, most = sorted((options.start, options.end))
        growth = AmplitudeGrowth(resolution, (least, most))
        recalls = bool(remembers(points).any())
        events = Events(self.system, growth, self.control, multipliers, recalls=recalls)
        self.curve = Curve(
            problem,
            self.system,
            resolution,
            multipliers,
            events if options.events else None,
            _residual_range(problem, resolution, self.control)
            if options.residual_range
            else None,
            (least, most),
            options.contact_errors and points.load.size > 0,
        )
        self.pieces = Pieces(
            path,
            self.system,
            options.start,
            options.end,
            self.control,
            self.effort,
            resolved,
        )

    def responses(self) -> Iterator[PeriodicResponse]:
        """Yield the responses from one end of the range to the other."""
        yield from self.curve.followed(self.pieces, self.pieces.metric)

    def at_places(self, places: Iterable[Place]) -> Iterator[PeriodicResponse]:
        """Yield the responses at given frequencies, of what has no coordinates."""
        for frequency, error in places:
            if error is not None and self.curve.events is None:
                continue
            guess = np.append(np.zeros(self.system.size - 1), frequency)
            found = correct_at(self.system, guess, self.control, self.system)
            made, _ = self.curve.made(found, "" if error is None else "peak")
            yield made if error is None else replace(made, parameter_error=error)

    def from_response(
        self, known: PeriodicResponse, selection: Array, mark: str
    ) -> Iterator[PeriodicResponse]:
        """Yield the responses to both sides of one, until the range ends.

        Or until the curve closes.

        Parameters
        ----------
        known
            Where to begin.
        selection
            Map from the structure to the coordinates of the path, (rank, dofs).
        mark
            What the first response of each side is marked as.
        """
        guess = self.guess(known, selection)
        direction = np.zeros_like(guess)
        for side in (1.0, -1.0):
            self.system.restart(known.harmonics)
            direction[-1] = side
            corrections = self.pieces.from_point(guess, direction)
            last = known
            for last in self.curve.followed(corrections, self.pieces.metric, mark):
                yield last
            if last.frequency == known.frequency:
                return  # the curve is closed

    def guess(self, known: PeriodicResponse, selection: Array) -> Array:
        """Return the point of a response, as a guess along frequency."""
        guess = np.zeros(self.system.size)
        relative = (known.coefficients @ selection.T).ravel()
        guess[: relative.size] = relative
        guess[-1] = known.frequency
        return guess


def _resolution(problem: Problem, path: Path) -> PathResolution:
    """Return a path, judged by a problem's probes, at any resolution."""
    points = problem.interface.points
    by_steps = bool((points.friction == RIGID).any() or marched(points).any())
    return PathResolution(path, problem.probes.rows, marched=by_steps)


def _residual_range(
    problem: Problem, resolution: PathResolution, control: StepControl
) -> ResidualRange | None:
    """Return what finds that; None if no load may follow what a stuck slider carries.

    What hardly a scene needs is loaded by those alone that do.
    """
    points = problem.interface.points
    if points.constant_load.all() or not (points.friction == ELASTIC).any():
        return None
    from hbm.curves.residual_range import ResidualRange

    return ResidualRange(resolution, problem.probes.rows, control.tolerance)


def _adaptive(
    problem: Problem,
    options: CurveOptions,
    threshold: float,
    resolution: PathResolution,
    effort: Effort,
) -> AdaptiveBalance:
    """Return what follows a path; friction begins with a threshold velocity [m/s]."""
    return AdaptiveBalance(
        resolution,
        replace(options.first, threshold=threshold),
        tolerance=options.error if options.harmonics is None else None,
        most=options.most_harmonics,
        errors=options.errors,
        effort=effort,
        pushed=bool((problem.interface.points.friction == RIGID).any()),
    )
