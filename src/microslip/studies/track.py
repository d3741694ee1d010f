"""How peaks and bifurcations of the curve move with one parameter of the scene."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hbm.errors import ContinuationError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import Wanted, trace_curve
from microslip_mechanics.results.response_curve import ResponseCurve

OTHERWISE = "other tractions"
"""what the largest amplitude is called that other residual tractions allow"""
HIGHEST = "largest"
"""what the largest amplitude is called where it is above all peaks of the range"""
SEEN = 1e-3
"""of the largest amplitude, or of the highest peak, by which these have to be larger"""


@dataclass(frozen=True, slots=True)
class Event:
    """Something located on a curve."""

    name: str
    """peak, fold, branch point, …, :data:`HIGHEST` or :data:`OTHERWISE`"""
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

    @property
    def otherwise(self) -> Event | None:
        """The largest amplitude by other residual tractions, if it is larger."""
        return next((each for each in self.events if each.name == OTHERWISE), None)


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
            problem, wanted = problem_of(loaded), Wanted(residual_range=True)
            curve = trace_curve(problem, loaded.curve, wanted=wanted).curve
        except ContinuationError as error:
            yield Tracked(value, str(error), ())
        else:
            events = (*_events(curve), *_highest(curve), *_otherwise(curve))
            yield Tracked(value, curve.ending, events)
            if curve.ending == "interrupted":
                raise KeyboardInterrupt


def _events(curve: ResponseCurve) -> tuple[Event, ...]:
    return tuple(
        _event(curve, place, name) for place, name in enumerate(curve.event) if name
    )


def _event(curve: ResponseCurve, place: int, name: str) -> Event:
    return Event(
        name,
        float(curve.frequency[place]),
        float(curve.parameter_error[place]),
        float(curve.amplitude[place].max()),
        float(curve.error[place]),
    )


def _highest(curve: ResponseCurve) -> tuple[Event, ...]:
    """Return the largest amplitude if it is above all peaks, as at a range's end.

    Of a curve that is interrupted the larger amplitudes may be still to come.
    """
    if curve.ending == "interrupted":
        return ()
    sizes = curve.amplitude.max(axis=1)
    peaks = [name == "peak" for name in curve.event]
    place = int(sizes.argmax())
    if sizes[place] <= (1.0 + SEEN) * sizes[peaks].max(initial=0.0):
        return ()
    return (_event(curve, place, HIGHEST),)


def _otherwise(curve: ResponseCurve) -> tuple[Event, ...]:
    """Return the largest amplitude by other residual tractions, if it is larger."""
    highest = np.nan_to_num(curve.amplitude_highest).max(axis=1, initial=0.0)
    place = int(highest.argmax())
    if highest[place] <= (1.0 + SEEN) * curve.amplitude.max(initial=0.0):
        return ()
    frequency, amplitude = float(curve.frequency[place]), float(highest[place])
    return (Event(OTHERWISE, frequency, np.nan, amplitude, np.nan),)
