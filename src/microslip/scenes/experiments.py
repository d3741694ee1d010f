"""What is done with a rig: tables [sweep], [curve] and [march] of a scene."""

from __future__ import annotations

import typing
from dataclasses import dataclass

from microslip.scenes.quantity import SceneError, quantity
from microslip_mechanics.quantity import apart

HERTZ = 1e-12, 1e12
"""between which frequencies lie, so that periods and their steps can be counted"""
LONGEST = 1e12
"""time of a sweep [s]"""
APART = 1e-12
"""share by which both ends of a range differ at least: less is rounding"""


@dataclass(frozen=True, slots=True)
class Sweep:
    """Load history of the time march."""

    end: float = quantity("s", positive=True, highest=LONGEST)
    duration: float = quantity("s", positive=True, highest=LONGEST)
    lowest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    highest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    ramp: float = quantity("s", lowest=0.0, highest=LONGEST, default=0.0)
    start: float = quantity("s", lowest=0.0, highest=LONGEST, default=0.0)
    kind: typing.Literal["exponential", "linear", "stepped"] = quantity(
        default="exponential"
    )
    direction: typing.Literal["up", "down", "up-down"] = quantity(default="up")
    levels: tuple[float, ...] = quantity(positive=True, highest=1e6, default=(1.0,))
    steps: int | None = quantity(lowest=2, highest=10**5, optional=True)
    periods: int | None = quantity(lowest=1, highest=10**7, optional=True)
    force_file: str | None = quantity(optional=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Resolution:
    """Accuracy of harmonic balance, or fixed harmonics and samples instead."""

    tolerance: float = quantity(lowest=1e-6, highest=0.5, default=1e-3)
    harmonics: int | None = quantity(lowest=1, highest=255, optional=True)
    samples: int | None = quantity(lowest=6, highest=2**16, optional=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve(Resolution):
    """Frequency response by harmonic balance."""

    lowest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    highest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])


@dataclass(frozen=True, slots=True)
class March:
    """Time integration."""

    time_step: float = quantity("s", lowest=1e-18, highest=LONGEST)
    store_every: int = quantity(lowest=1, highest=10**6, default=1)


def check_sweep(source: str, sweep: Sweep) -> None:
    """Check what more than one key of a sweep decides.

    Raises
    ------
    SceneError
        With file, table, keys, values and remedy.
    """
    if not sweep.ramp <= sweep.start < sweep.end <= sweep.duration:
        raise SceneError(
            f"{source}: [sweep] ramp {sweep.ramp:g} s, start {sweep.start:g} s, end "
            f"{sweep.end:g} s, duration {sweep.duration:g} s: "
            "give ramp <= start < end <= duration"
        )
    _check_range(f"{source}: [sweep]", sweep)
    _check_kind(source, sweep)


def check_curve(source: str, curve: Curve) -> None:
    """Check what more than one key of a curve decides.

    Raises
    ------
    SceneError
        With file, table, keys, values and remedy.
    """
    _check_range(f"{source}: [curve]", curve)
    check_samples(f"{source}: [curve]", curve)


def check_samples(place: str, curve: Resolution) -> None:
    """Check the number of samples per period.

    Raises
    ------
    SceneError
        If they are too few, or do not stand with harmonics.
    """
    if curve.samples is not None and curve.harmonics is None:
        raise SceneError(
            f"{place} samples = {curve.samples}: they follow from the "
            "tolerance unless harmonics are given: give both, or neither"
        )
    fewest = 4 * (curve.harmonics or 0) + 2
    if curve.samples is not None and curve.samples < fewest:
        raise SceneError(
            f"{place} samples = {curve.samples}: too few for "
            f"{curve.harmonics} harmonics: give at least {fewest}"
        )


def _check_range(place: str, table: Sweep | Curve) -> None:
    if not table.lowest * (1.0 + APART) < table.highest:
        low, high = apart(table.lowest, table.highest)
        raise SceneError(
            f"{place} lowest = {low} Hz, highest = {high} Hz: give lowest < highest"
        )


def _check_kind(source: str, sweep: Sweep) -> None:
    """Check that a sweep has the keys of its kind, and those alone."""
    steps = {"steps": sweep.steps, "periods": sweep.periods}
    for name, value in steps.items():
        if sweep.kind == "stepped" and value is None:
            raise SceneError(
                f'{source}: [sweep] {name} is missing: kind = "stepped" needs it'
            )
        if sweep.kind != "stepped" and value is not None:
            raise SceneError(
                f"{source}: [sweep] {name} = {value}: only for "
                'kind = "stepped": leave it out'
            )
    plain = (sweep.kind, sweep.direction, sweep.levels) == ("exponential", "up", (1.0,))
    if sweep.force_file is not None and not plain:
        raise SceneError(
            f'{source}: [sweep] force_file = "{sweep.force_file}": the force takes the '
            "place of the sine: leave kind, direction and levels out"
        )
