"""Natural frequency and damping of a scene's modes against amplitude."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from hbm.errors import ContinuationError
from hbm.modes.linear_modes import LinearMode
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import NonlinearMode, modes_in_range, nonlinear_mode
from microslip.interruption import unmasked
from microslip.progress import Watch
from microslip.scenes.quantity import SceneError
from microslip.studies.mode_beginning import ALIKE, begun, likeness
from microslip_mechanics.by_value import ByValue
from microslip_mechanics.contact.points import rubs
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState, static_equilibrium

COARSER = (7, 3, 1)
"""harmonics with which a mode is followed on, in turn, that does not go on with those
that its error asks for: they may meet modes of the structure, where it branches"""
SHOWN = 20
"""points of a mode in a table, beside the most damped one"""


class ModeError(MicroslipError):
    """A scene without a point of a mode; the text says why."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FollowedMode(ByValue):
    """A mode, as far as it was followed."""

    linear: LinearMode
    """of very small motions"""
    points: tuple[NonlinearMode, ...]
    ending: str
    """"complete", "interrupted", or the cause"""
    coarser: int | None = None
    """place from which on points have fewer harmonics than their error asks for"""
    likeness: float = 1.0
    """of the first point's motion to the linear mode, from 0 to 1: see
    :func:`~microslip.studies.mode_beginning.likeness`"""

    @property
    def apart(self) -> bool:
        """Whether it begins with another motion than the linear mode."""
        return self.likeness < ALIKE

    def __repr__(self) -> str:
        """Return what the mode is, in a line."""
        ends = [
            1e3 * point.amplitude for point in (*self.points[:1], *self.points[-1:])
        ]
        span = " to ".join(f"{each:.4g}" for each in ends)
        return (
            f"<FollowedMode: {self.linear.frequency / math.tau:.6g} Hz in small "
            f"motions; {len(self.points)} points, {span or 'none'} mm; {self.ending}>"
        )

    @property
    def most_damped(self) -> NonlinearMode:
        """The point of the largest damping ratio; there must be one."""
        return max(self.points, key=lambda point: point.damping)


def followed(
    problem: Problem,
    frequencies: tuple[float, float],
    options: ModeOptions,
    watch: Watch = iter,
) -> Iterator[FollowedMode]:
    """Yield the modes with natural frequencies in a range [rad/s], the lowest first.

    What cannot go on with the harmonics that its error asks for goes on with fewer, and
    with the error that these have. What cannot go on at all, or is interrupted, keeps
    what it has; a mode without a first point has the cause alone.

    Raises
    ------
    SceneError
        If there is no mode in the range.
    KeyboardInterrupt
        If it comes before the first point of a mode.
    """
    rest = static_equilibrium(problem)
    found = modes_in_range(problem, rest, *frequencies)
    if not found:
        raise SceneError(_none(problem, rest, frequencies))
    for linear in found:
        mode = _followed(linear, begun(problem, rest, linear, options), watch)
        for harmonics in COARSER if options.harmonics is None else ():
            if mode.ending in ("complete", "interrupted"):
                break
            fewer = replace(options, harmonics=harmonics)
            growth = nonlinear_mode(problem, rest, linear, fewer)
            mode = _farther(mode, growth, watch)
        if mode.points:
            alike = likeness(problem, linear, mode.points[0])
            mode = replace(mode, likeness=alike)
        yield mode
        if mode.ending == "interrupted":
            return


def _none(problem: Problem, rest: StaticState, frequencies: tuple[float, float]) -> str:
    """Return what is said of a range [rad/s] without modes."""
    stuck = " while its contacts stick" if rubs(problem.interface.points) else ""
    lowest, highest = frequencies
    every = [each.frequency for each in modes_in_range(problem, rest, 0.0, math.inf)]
    if not every:
        return f"no mode vibrates{stuck}, or no probe sees it: give another probe"
    nearest = min(every, key=lambda each: max(lowest / each, each / highest))
    return (
        f"no mode has a natural frequency in this range{stuck}: give another range; "
        f"the nearest is {nearest / math.tau:.6g} Hz"
    )


def _followed(
    linear: LinearMode, growth: Iterator[NonlinearMode], watch: Watch
) -> FollowedMode:
    """Return a mode as far as it grows."""
    points: list[NonlinearMode] = []
    ending = "complete"
    try:
        with unmasked():
            for point in watch(growth):
                points.append(point)  # noqa: PERF402  (what is there must be kept)
    except ContinuationError as error:
        ending = str(error)
    except KeyboardInterrupt:
        ending = "interrupted"
        if not points:
            raise
    return FollowedMode(linear, tuple(points), ending)


def _farther(
    mode: FollowedMode, growth: Iterator[NonlinearMode], watch: Watch
) -> FollowedMode:
    """Return a mode that goes on with what grows beyond its end, if that is farther.

    Its end is where its amplitude is largest: behind that it has turned back.
    """
    try:
        again = _followed(mode.linear, growth, watch)
    except KeyboardInterrupt:
        return replace(mode, ending="interrupted")
    fine = _up_to_the_largest(mode.points[: mode.coarser])
    reached, last = (
        max((point.amplitude for point in points), default=0.0)
        for points in (fine, mode.points)
    )
    beyond = tuple(
        itertools.dropwhile(lambda point: point.amplitude <= reached, again.points)
    )
    farther = bool(beyond) and beyond[-1].amplitude > last
    known = ("interrupted", "complete") if farther else ("interrupted",)
    ending = again.ending if again.ending in known else mode.ending
    if not farther:
        return replace(mode, ending=ending)
    return FollowedMode(mode.linear, (*fine, *beyond), ending, len(fine))


def _up_to_the_largest(points: Sequence[NonlinearMode]) -> tuple[NonlinearMode, ...]:
    """Return points up to that of the largest amplitude."""
    amplitudes = [point.amplitude for point in points]
    place = amplitudes.index(max(amplitudes)) if amplitudes else -1
    return tuple(points[: place + 1])


def shown_points(mode: FollowedMode) -> list[NonlinearMode]:
    """Return points evenly spread along a mode, the most damped one among them."""
    last = len(mode.points) - 1
    places = {round(last * share / (SHOWN - 1)) for share in range(SHOWN)}
    places.add(_place(mode.points, mode.most_damped))
    return [mode.points[place] for place in sorted(places)]


def _place(points: Sequence[NonlinearMode], wanted: NonlinearMode) -> int:
    return next(place for place, each in enumerate(points) if each is wanted)
