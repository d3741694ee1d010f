"""How peaks and bifurcations of the curve move with one parameter of the scene."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from hbm.errors import ContinuationError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import trace_curve
from microslip_mechanics.results.response_curve import ResponseCurve


@dataclass(frozen=True, slots=True)
class Event:
    """Something located on a curve."""

    name: str
    """peak, fold, branch point, …"""
    frequency: float
    """[rad/s]"""
    frequency_error: float
    """estimated [rad/s]; NaN if it is not known"""
    amplitude: float
    """largest of the probes [m]"""
    error: float
    """estimated, of the amplitude, relative"""


@dataclass(frozen=True, slots=True)
class Tracked:
    """The curve at one value of the parameter."""

    value: str
    """as it was given"""
    ending: str
    """"complete", or the cause"""
    events: tuple[Event, ...]

    @property
    def peak(self) -> Event | None:
        """The highest peak, if there is one within the range."""
        peaks = [event for event in self.events if event.name == "peak"]
        return max(peaks, key=lambda each: each.amplitude, default=None)


def tracked(
    scene: str, overrides: Sequence[str], key: str, values: Sequence[str]
) -> Iterator[Tracked]:
    """Yield the events of the curve for each value of a scene's key.

    A curve without a first point is a result too, and what there is of one that is
    interrupted.

    Raises
    ------
    SceneError
        If the scene does not take a value.
    KeyboardInterrupt
        After the curve that is interrupted.
    """
    for value in values:
        loaded = load_scene(scene, (*overrides, f"{key}={value}"))
        try:
            curve = trace_curve(problem_of(loaded), loaded.curve).curve
        except ContinuationError as error:
            yield Tracked(value, str(error), ())
        else:
            yield Tracked(value, curve.ending, _events(curve))
            if curve.ending == "interrupted":
                raise KeyboardInterrupt


def _events(curve: ResponseCurve) -> tuple[Event, ...]:
    return tuple(
        Event(
            name,
            float(curve.frequency[place]),
            float(curve.parameter_error[place]),
            float(curve.amplitude[place].max()),
            float(curve.error[place]),
        )
        for place, name in enumerate(curve.event)
        if name
    )
