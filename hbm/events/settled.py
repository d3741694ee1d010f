"""A settled point of a curve, with what events beside it need."""

from __future__ import annotations

import math
from typing import NamedTuple

from hbm.continuation.correction import Correction
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import ComplexArray


class Settled(NamedTuple):
    """A settled point of a curve, with what its multipliers say and ask for."""

    correction: Correction
    solved: FourierBasis
    """the resolution with which the curve has it"""
    multipliers: ComplexArray
    finer: FourierBasis
    """the resolution that they ask for"""
    asks: bool
    """whether that is more than the reported orbit has"""
    reported: Correction
    """the point as it is reported, where events are sought"""
    fourier: FourierBasis
    """the resolution of that"""
    growth: float = math.nan
    """of its largest amplitude along the curve"""
    owes: bool = False
    """whether the curve folded before it, and no multiplier has crossed +1 for that"""
