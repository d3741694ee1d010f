"""Loads that travel around a bladed disk."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np

from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.structures.selection import selected


def engine_order(
    names: Sequence[str], blades: Sequence[str], order: int, amplitude: complex
) -> ComplexArray:
    """Return a wave with some maxima around the disk, at the frequency of the drive.

    Parameters
    ----------
    names
        Of all degrees of freedom.
    blades
        The loaded degree of freedom of each blade, in the order around the disk.
    order
        E, maxima around the disk. Each blade is ahead of the one before it by 2π E/N
        of N blades; −E travels the other way.
    amplitude
        On each blade [N]; with a phase if it is complex.

    Returns
    -------
    p, shape ``(dofs,)``: the load is the imaginary part of p e^{iωt}.

    Raises
    ------
    ValueError
        If a blade is unknown, is several degrees of freedom, or stands there twice; if
        the order is no whole number.
    """
    load = np.zeros(len(names), complex)
    if not np.isfinite(amplitude):
        raise ValueError(f"amplitude {amplitude} N: give a finite one")
    if not len(blades):
        raise ValueError("engine order: no blades: give one or more")
    if order != int(order):
        raise ValueError(f"engine order {order:g}: give a whole number of maxima")
    for place, blade in enumerate(blades):
        dof = _of_blade(names, blade)
        if load[dof] != 0.0:
            raise ValueError(
                f"engine order: blade {blade!r} stands there twice: give each one once"
            )
        load[dof] = amplitude * phasor(int(order) * place, len(blades))
    return load


def _of_blade(names: Sequence[str], blade: str) -> int:
    """Return the place of a blade's degree of freedom."""
    try:
        dof, *more = (int(each) for each in selected(names, [blade]))
    except ValueError as error:
        raise ValueError(f"engine order: blades: {error}") from None
    if more:
        raise ValueError(
            f"engine order: blade {blade!r} is {1 + len(more)} degrees of freedom: "
            "give one"
        )
    return dof


def phasor(part: int, count: int) -> complex:
    """Return e^(2πi part/count); what is in phase, or opposite, is exactly real."""
    part %= count
    if 2 * part % count == 0:
        return 1.0 if part == 0 else -1.0
    return cmath.rect(1.0, math.tau * part / count)
