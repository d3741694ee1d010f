"""The table of contact points, and the row that a law is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array

ONE_SIDED, TWO_SIDED = 0, 1
"""kinds of normal law: Hunt and Crossley's, and a spring that also pulls"""
FRICTIONLESS, COULOMB, GENERAL_KINETIC, TANH, ELASTIC, BRISTLE = 0, 1, 2, 3, 4, 5
RIGID, PUSHED = 6, 7
"""kinds of friction; those from ELASTIC on are no functions of the motion. Harmonic
balance turns RIGID into PUSHED, that under a mass which is pushed"""


class ContactPoints(NamedTuple):
    """Parameters of all contact points; each array has shape (points,)."""

    normal: NDArray[np.int64]
    """ONE_SIDED or TWO_SIDED"""
    gap: Array
    """displacement at which the faces touch [m]; negative where they are pressed"""
    stiffness: Array
    """K [N/m^pK]"""
    exponent: Array
    """pK"""
    damping: Array
    """C: ONE_SIDED [N s/m^(pD+1)], TWO_SIDED [N (s/m)^(pD+1)]"""
    damping_exponent: Array
    """pD: of penetration if ONE_SIDED, of the speed if TWO_SIDED"""
    clamped: NDArray[np.bool_]
    """whether a pulling normal force is set to zero"""
    friction: NDArray[np.int64]
    """FRICTIONLESS, COULOMB, GENERAL_KINETIC, TANH, ELASTIC, BRISTLE, RIGID, PUSHED"""
    dynamic: Array
    """µd"""
    static: Array
    """µs (GKF, bristles)"""
    stribeck: Array
    """V_str [m/s] (GKF, bristles); rate at which a mass slows down [1/s] (PUSHED)"""
    stribeck_exponent: Array
    """γ (GKF, bristles)"""
    viscous: Array
    """f_d [N s/m] (GKF, bristles)"""
    threshold: Array
    """V_lim [m/s]"""
    constant_load: NDArray[np.bool_]
    """whether friction uses ``load`` instead of the computed normal force"""
    load: Array
    """constant normal load of friction [N]"""
    tangential: Array
    """k_t [N/m] (ELASTIC, BRISTLE); push by displacement (PUSHED)"""


@dataclass(frozen=True, slots=True)
class PointLaw:
    """One row of the table; what is left out does nothing."""

    normal: int = ONE_SIDED
    gap: float = 0.0
    stiffness: float = 0.0
    exponent: float = 1.0
    damping: float = 0.0
    damping_exponent: float = 0.0
    clamped: bool = False
    friction: int = FRICTIONLESS
    dynamic: float = 0.0
    static: float = 0.0
    stribeck: float = 1.0
    stribeck_exponent: float = 1.0
    viscous: float = 0.0
    threshold: float = 1.0
    constant_load: bool = False
    load: float = 0.0
    tangential: float = 0.0


def contact_table(laws: Sequence[PointLaw]) -> ContactPoints:
    """Return the table of points with the given laws."""
    types = {"normal": np.int64, "friction": np.int64, "clamped": bool}
    types["constant_load"] = bool
    return ContactPoints(
        *(
            np.array([getattr(law, name) for law in laws], types.get(name, float))
            for name in ContactPoints._fields
        )
    )


def rubs(points: ContactPoints) -> bool:
    """Return whether some point has friction."""
    return bool((points.friction != FRICTIONLESS).any())


def smooth(points: ContactPoints) -> bool:
    """Return whether there are no transitions: no point can part, stick or slide."""
    held = (points.normal == TWO_SIDED) & (points.friction == FRICTIONLESS)
    return bool(held.all())


def repeated_points(points: ContactPoints, times: int) -> ContactPoints:
    """Return the table with all its points so many times, one after the other."""
    return ContactPoints(*(np.tile(column, times) for column in tuple(points)))
