"""Loads that travel around a bladed disk."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import ComplexArray, numbers_of
from microslip_mechanics.loads.node_sets import texts
from microslip_mechanics.structures.selection import selected


@dataclass(frozen=True, slots=True)
class EngineOrder:
    """A wave that stands still around a disk that turns.

    ``blades`` are the loaded degree of freedom of each blade, in the order around the
    disk, ``order`` the number of maxima, ``amplitude`` the force on each blade [N].
    """

    blades: Sequence[str]
    """the loaded degree of freedom of each blade, in the order around the disk"""
    order: int
    """maxima around the disk"""
    amplitude: float
    """on each blade [N]"""

    def __post_init__(self) -> None:
        """Check that blades are names and the others numbers."""
        if not texts(self.blades):
            raise ValueError(
                f"engine order: blades = {self.blades!r}: give a list of degrees of "
                "freedom, one of each blade"
            )
        order = numbers_of(self.order)
        if order.shape != () or order % 1.0:
            raise ValueError(
                f"engine order {self.order!r}: give a whole number of maxima"
            )
        if numbers_of(self.amplitude).shape != ():
            raise ValueError(
                f"engine order: amplitude {self.amplitude}: give a finite number [N]"
            )

    def load(self, names: Sequence[str]) -> ComplexArray:
        """Return the load on all degrees of freedom, at the frequency of the drive.

        Each blade is ahead of the one before it by 2π E/N of N blades; a negative order
        E travels the other way.

        Parameters
        ----------
        names
            Of all degrees of freedom.

        Returns
        -------
        p, shape ``(dofs,)``: the load is the imaginary part of p e^{iωt}.

        Raises
        ------
        ValueError
            If there are no blades; if one is unknown, is several degrees of freedom, or
            stands there twice.
        """
        load = np.zeros(len(names), complex)
        if not len(self.blades):
            raise ValueError("engine order: no blades: give one or more")
        for place, blade in enumerate(self.blades):
            dof = _of_blade(names, blade)
            if load[dof] != 0.0:
                raise ValueError(
                    f"engine order: blade {blade!r} stands there twice: give each one "
                    "once"
                )
            turn = phasor(int(self.order) * place, len(self.blades))
            load[dof] = self.amplitude * turn
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
