"""Loads as a user gives them: by name, by a moving base, by an engine order."""

from __future__ import annotations

import cmath
import math
import numbers
from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.loads.base_motion import BaseMotion
from microslip_mechanics.loads.engine_order import EngineOrder
from microslip_mechanics.loads.node_sets import Sets, members
from microslip_mechanics.structures.forms import place_of
from microslip_mechanics.structures.structure import Structure

Drive: TypeAlias = Mapping[str, float | tuple[float, float]]
"""amplitude [N], or amplitude and phase [rad], by degree of freedom"""


def driven(
    drive: Drive,
    structure: Structure,
    sets: Sets,
    order: EngineOrder | None = None,
    base: BaseMotion | None = None,
) -> Array | ComplexArray:
    """Return the drive [N], shape (dofs,): real if all acts in phase with the sine.

    Raises
    ------
    ValueError
        If a name is unknown or an amplitude is not finite.
    """
    names, waves = structure.names, {}
    if not isinstance(drive, Mapping):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            f"drive = {drive!r}: give amplitudes [N] by degree of freedom, such as "
            f"{{{names[0]!r}: 1.0}}"
        )
    for name, wave in drive.items():
        amplitude, phase = _wave(name, wave)
        turn = math.remainder(phase, math.tau)
        if turn in (0.0, math.pi, -math.pi):
            waves[name] = complex(amplitude if turn == 0.0 else -amplitude)
        else:
            waves[name] = cmath.rect(1.0, phase) * amplitude
    total = loads(waves, names, sets, "drive")
    if not isinstance(order, EngineOrder | None):
        raise ValueError(  # noqa: TRY004  (as above)
            f"engine_order = {order!r}: give microslip.EngineOrder(blades, order, "
            "amplitude)"
        )
    if not isinstance(base, BaseMotion | None):
        raise ValueError(  # noqa: TRY004  (as above)
            f"base = {base!r}: give microslip.BaseMotion(direction, acceleration)"
        )
    if order is not None:
        total += order.load(names)
    if base is not None:
        total += base.load(structure)
    return total if total.imag.any() else total.real


def preloaded(
    preload: Mapping[str, float], names: tuple[str, ...], sets: Sets
) -> Array:
    """Return the static load [N], shape (dofs,).

    Raises
    ------
    ValueError
        If a name is unknown or a force is not a finite real number.
    """
    if not isinstance(preload, Mapping):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            f"preload = {preload!r}: give static forces [N] by degree of freedom, such "
            f"as {{{names[0]!r}: 1.0}}"
        )
    for name, force in preload.items():
        if isinstance(force, numbers.Complex) and not isinstance(force, numbers.Real):
            raise ValueError(  # noqa: TRY004  (as above)
                f"preload of {name} is {force}: give a real number, a static force has "
                "no phase"
            )
    return loads(preload, names, sets, "preload").real


def _wave(name: str, given: object) -> tuple[float, float]:
    """Return amplitude and phase of a load."""
    several = isinstance(given, tuple | list) or getattr(given, "ndim", 0) > 0
    pair: Any = given if several else (given, 0.0)
    try:
        amplitude, phase = (_number(each) for each in pair)
    except (TypeError, ValueError):
        amplitude = phase = math.nan
    if not math.isfinite(phase) or not math.isfinite(amplitude):
        raise ValueError(
            f"drive of {name} is {given!r}: give a finite amplitude [N], or a pair of "
            "that and a phase [rad]"
        )
    return amplitude, phase


def _number(given: Any) -> float:  # noqa: ANN401  (whatever a user gives)
    """Return a number; a switch is none."""
    return math.nan if isinstance(given, bool) else float(given)


def loads(
    given: Mapping[str, float] | Mapping[str, complex],
    names: tuple[str, ...],
    sets: Sets,
    what: str,
) -> ComplexArray:
    """Return loads over the degrees of freedom; ``set.direction`` is all of a set."""
    total = np.zeros(len(names), dtype=complex)
    for name, force in given.items():
        number = isinstance(force, numbers.Number) and not isinstance(force, bool)
        if not number or not cmath.isfinite(force):
            raise ValueError(f"{what} of {name} is {force}: give a finite number")
        for each in members(name, names, sets, what):
            total[place_of(each, names, what)] += force
    return total
