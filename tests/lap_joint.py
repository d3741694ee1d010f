"""Two halves of a beam that a lap joint holds together: bolts press, friction holds."""

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system

WIDTH, HEIGHT, YOUNG, DENSITY = 0.025, 0.012, 2e11, 7800.0
ARM, LAP, ELEMENTS = 0.24, 0.12, 4
"""lengths of the arms and of the joint [m], and elements of each arm"""
NORMAL, TANGENTIAL = 2e9, 1.5e9
"""stiffness of the whole joint [N/m]"""


def lap_joint(pairs: int, bolts: float, drive: float) -> Problem:
    """Return a beam of steel, clamped at one end and driven at the other one.

    Nothing but friction holds its outer half along the beam.

    Parameters
    ----------
    pairs
        Of nodes that touch.
    bolts
        Force that presses the joint [N], most in its middle.
    drive
        At the tip [N].
    """
    arm, lap = np.arange(ELEMENTS) * ARM / ELEMENTS, np.linspace(0.0, LAP, pairs)
    inner = np.append(arm, ARM + lap)
    outer = np.append(ARM + lap, ARM + LAP + arm + ARM / ELEMENTS)
    matrices = zip(_half(inner), _half(outer), strict=True)
    mass, stiffness = (scipy.linalg.block_diag(*each)[3:, 3:] for each in matrices)
    names = [
        f"{half}{node}{axis}"
        for half, nodes in (("i", inner), ("o", outer))
        for node in range(nodes.size)
        for axis in "uwt"
    ][3:]
    law = ElasticFriction(
        normal_stiffness=NORMAL / pairs, stiffness=TANGENTIAL / pairs, mu=0.3
    )
    elements, preload, turn = [], {}, -0.5 * HEIGHT
    pressure = 1.2 - 0.9 * np.linspace(-1.0, 1.0, pairs) ** 2
    pressure *= bolts / pressure.sum()
    for pair in range(pairs):
        low, high = f"i{ELEMENTS + pair}", f"o{pair}"
        slides = {f"{low}u": 1.0, f"{low}t": turn, f"{high}u": -1.0, f"{high}t": turn}
        elements.append(
            Element(
                law,
                normal=(f"{low}w", f"{high}w"),
                tangents=[(slides, "ground")],
                name=f"pair {pair + 1}",
            )
        )
        preload[f"{low}w"], preload[f"{high}w"] = pressure[pair], -pressure[pair]
    tip = f"o{outer.size - 1}w"
    return system(
        names=names,
        mass=mass,
        stiffness=stiffness,
        damping_ratio=0.002,
        elements=elements,
        preload=preload,
        drive={tip: drive},
        probes={"tip": tip},
    )


def _half(places: Array) -> tuple[Array, Array]:
    """Return mass and stiffness of one half, three degrees of freedom a node."""
    mass, stiffness = np.zeros((2, 3 * places.size, 3 * places.size))
    for node, length in enumerate(np.diff(places)):
        own = slice(3 * node, 3 * node + 6)
        inert, stiff = _beam(float(length))
        mass[own, own] += inert
        stiffness[own, own] += stiff
    return mass, stiffness


def _beam(length: float) -> tuple[Array, Array]:
    """Return consistent mass and stiffness of a plane Euler–Bernoulli element."""
    area, inertia = WIDTH * HEIGHT, WIDTH * HEIGHT**3 / 12.0
    mass, stiffness = np.zeros((2, 6, 6))
    axial, bending = np.ix_([0, 3], [0, 3]), np.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    one, two = length, length**2
    stiffness[axial] = YOUNG * area / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    stiffness[bending] = (YOUNG * inertia / length**3) * np.array(
        [
            [12.0, 6.0 * one, -12.0, 6.0 * one],
            [6.0 * one, 4.0 * two, -6.0 * one, 2.0 * two],
            [-12.0, -6.0 * one, 12.0, -6.0 * one],
            [6.0 * one, 2.0 * two, -6.0 * one, 4.0 * two],
        ]
    )
    mass[axial] = DENSITY * area * length / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
    mass[bending] = (DENSITY * area * length / 420.0) * np.array(
        [
            [156.0, 22.0 * one, 54.0, -13.0 * one],
            [22.0 * one, 4.0 * two, 13.0 * one, -3.0 * two],
            [54.0, 13.0 * one, 156.0, -22.0 * one],
            [-13.0 * one, -3.0 * two, -22.0 * one, 4.0 * two],
        ]
    )
    return mass, stiffness
