"""The constants of the first-order form."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.loads.segments import Segments

ENERGIES = 3
"""friction, damping, input: the last places of the state"""


class System(NamedTuple):
    """Constants of the first-order form."""

    rates: Array
    """ω² / s of each mode [1/s], shape (modes,)"""
    damping: Array
    """Φᵀ C Φ [1/s], shape (modes, modes)"""
    gaps: Array
    """relative displacements of the points [m] from s q over its unit, (3 points, m)"""
    slips: Array
    """relative velocities [m/s] from q̇ over its unit, shape (3 points, modes)"""
    pulls: Array
    """Φᵀ Lᵀ over the motion unit, shape (modes, 3 points)"""
    loads: Array
    """Φᵀ of preload and drive over the motion unit, shape (loads, modes)"""
    scale: float
    """s [1/s]"""
    motion: float
    """unit of s q and q̇ [m √kg / s]"""
    energy: float
    """unit of the energies [J]"""
    history: Segments
    points: ContactPoints
    slider: NDArray[np.int64]
    """place of each point's tractions among the tractions, −1 if there are none"""
    limit: Array
    """µ N of each point [N], the unit of its tractions"""
