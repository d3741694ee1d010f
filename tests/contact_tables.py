"""Tables of contact points for tests, and motions that reach each of their regions."""

import itertools
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ONE_SIDED,
    ContactPoints,
)

FRICTION_LAWS = {
    "frictionless": FRICTIONLESS,
    "coulomb": COULOMB,
    "gkf": GENERAL_KINETIC,
}
Motion = tuple[Array, Array]
"""relative displacement and velocity of each point, each (points, 3)"""

Region = Callable[[ContactPoints, np.random.Generator], Motion]
"""draws one motion for each point of a table"""

TYPES = {
    "normal": np.int64,
    "clamped": bool,
    "friction": np.int64,
    "constant_load": bool,
}


def contact_points(count: int = 1, **columns: ArrayLike) -> ContactPoints:
    """Return a table of ``count`` points; a single number holds for all of them.

    Without other values the numbers are of order one, the load is computed, and every
    law has something to do: µs > µd, viscous friction, normal damping.
    """
    values: dict[str, ArrayLike] = {
        "normal": ONE_SIDED,
        "gap": 0.0,
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
        "tangential": 5.0,
    }
    values |= columns
    return ContactPoints(
        *(
            np.full(count, values[name], dtype=TYPES.get(name, float))
            for name in ContactPoints._fields
        )
    )


def linear_contact(
    stiffness: float, damping: float, *, clamped: bool = False
) -> ContactPoints:
    """Return a point without friction: a spring [N/m] beside a dashpot [N s/m]."""
    return contact_points(
        stiffness=stiffness,
        exponent=1.0,
        damping=damping,
        damping_exponent=0.0,
        clamped=clamped,
        friction=FRICTIONLESS,
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


def sizes(points: ContactPoints, motion: Motion) -> tuple[Array, Array]:
    """Return the spring's force and the damper's force per approach in contact."""
    depth = np.maximum(motion[0][:, 0], 0.0)
    return (
        points.stiffness * depth**points.exponent,
        points.damping * depth**points.damping_exponent,
    )


def moving(points: ContactPoints, random: np.random.Generator, speed: Array) -> Motion:
    """Return random motions in contact with the given sliding speeds, (points,)."""
    count = len(points.load)
    displacement = random.normal(size=(count, 3))
    displacement[:, 0] = 10.0 ** random.uniform(-6.0, 0.5, count)
    angle = random.uniform(0.0, 2.0 * np.pi, count)
    approach = random.normal(size=count)
    return displacement, np.stack(
        [approach, speed * np.cos(angle), speed * np.sin(angle)], axis=1
    )


def sticking(points: ContactPoints, random: np.random.Generator) -> Motion:
    share = 10.0 ** random.uniform(-6.0, -0.01, len(points.load))
    return moving(points, random, share * points.threshold)


def slipping(points: ContactPoints, random: np.random.Generator) -> Motion:
    share = 10.0 ** random.uniform(0.01, 3.0, len(points.load))
    return moving(points, random, share * points.threshold)


def around_the_threshold(points: ContactPoints, random: np.random.Generator) -> Motion:
    share = 1.0 + random.choice([-1e-4, 1e-4], len(points.load))
    return moving(points, random, share * points.threshold)


def separated(points: ContactPoints, random: np.random.Generator) -> Motion:
    displacement, velocity = slipping(points, random)
    displacement[:, 0] *= -1.0
    return displacement, velocity


def around_the_surface(points: ContactPoints, random: np.random.Generator) -> Motion:
    displacement, velocity = slipping(points, random)
    displacement[:, 0] = random.choice([-1e-12, 1e-12], len(points.load))
    return displacement, velocity


def around_zero_force(points: ContactPoints, random: np.random.Generator) -> Motion:
    motion = slipping(points, random)
    spring, damper = sizes(points, motion)
    share = 1.0 + random.choice([-1e-3, 1e-3], len(points.load))
    motion[1][:, 0] = -share * spring / damper
    return motion


def pulling(points: ContactPoints, random: np.random.Generator) -> Motion:
    motion = slipping(points, random)
    spring, damper = sizes(points, motion)
    motion[1][:, 0] = -random.uniform(1.1, 5.0, len(points.load)) * spring / damper
    return motion


REGIONS = [
    sticking,
    slipping,
    around_the_threshold,
    separated,
    around_the_surface,
    around_zero_force,
    pulling,
]


def written(points: ContactPoints, motion: Motion) -> tuple[Array, Array, Array]:
    """Return force (points, 3) and both tangents (points, 3, 3)."""
    count = len(points.load)
    force = np.full((count, 3), np.nan)
    by_displacement, by_velocity = np.full((2, count, 3, 3), np.nan)
    for point in range(count):
        contact_force(
            points,
            point,
            motion[0][point],
            motion[1][point],
            force[point],
            by_displacement[point],
            by_velocity[point],
        )
    return force, by_displacement, by_velocity
