"""Tables of contact points for tests."""

import itertools

import numpy as np
from numpy.typing import ArrayLike

from microslip_mechanics.contact.law import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ContactPoints,
)

FRICTION_LAWS = {
    "frictionless": FRICTIONLESS,
    "coulomb": COULOMB,
    "gkf": GENERAL_KINETIC,
}
TYPES = {"clamped": bool, "friction": np.int64, "constant_load": bool}


def contact_points(count: int = 1, **columns: ArrayLike) -> ContactPoints:
    """Return a table of ``count`` points; a single number holds for all of them.

    Without other values the numbers are of order one, the load is computed, and every
    law has something to do: µs > µd, viscous friction, normal damping.
    """
    values: dict[str, ArrayLike] = {
        "stiffness": 3.0,
        "exponent": 2.0,
        "damping": 0.8,
        "damping_exponent": 0.5,
        "clamped": False,
        "friction": COULOMB,
        "dynamic": 0.3,
        "static": 0.6,
        "stribeck": 0.5,
        "stribeck_exponent": 1.0,
        "viscous": 0.04,
        "threshold": 0.1,
        "constant_load": False,
        "load": 1.7,
    }
    values |= columns
    return ContactPoints(
        *(
            np.full(count, values[name], dtype=TYPES.get(name, float))
            for name in ContactPoints._fields
        )
    )


def every_combination(friction: int) -> ContactPoints:
    """Return points with all exponents, clamped or not, constant load or not."""
    rows = itertools.product(
        (1.0, 1.5, 2.0, 2.7), (0.5, 0.75, 1.0), (False, True), (False, True)
    )
    exponent, damping_exponent, clamped, constant_load = zip(*rows, strict=True)
    return contact_points(
        len(exponent),
        friction=friction,
        exponent=exponent,
        damping_exponent=damping_exponent,
        clamped=clamped,
        constant_load=constant_load,
        stribeck_exponent=np.resize((0.7, 1.0, 2.0), len(exponent)),
    )
