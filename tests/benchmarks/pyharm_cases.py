"""The systems of pyharm.py, in the words of both sides."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.loads.engine_order import EngineOrder
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system

Told = tuple[str, list[int], dict[str, Any]]
"""an element for pyHarm: kind, nodes, numbers"""


@dataclass(frozen=True)
class Case:
    """A curve, and how pyHarm is to follow it."""

    problem: Problem
    elements: list[Told]
    lowest: float
    """[rad/s]"""
    highest: float
    harmonics: int
    samples: int
    step: float
    """first and largest one of pyHarm"""
    solvers: tuple[str, ...] = ("scipyroot", "NewtonRaphson", "MoorePenrose")
    most: int = 10_000
    """points that pyHarm tries, accepted or not"""

    def told(self, repeats: int) -> dict[str, Any]:
        """Return the case for pyHarm."""
        return {
            **_matrices(self.problem),
            "elements": self.elements + _loads(self.problem),
            "motions": 1,
            "harmonics": self.harmonics,
            "samples": self.samples,
            "solvers": self.solvers,
            "repeats": repeats,
            "steps": {
                "puls_inf": self.lowest,
                "puls_sup": self.highest,
                "ds0": self.step,
                "ds_max": self.step,
                "ds_min": 1e-6,
                "verbose": False,
                "stopper": "solnumber",
                "stopper_options": {"max_solutions": self.most},
            },
        }


@dataclass(frozen=True)
class Evaluation:
    """A motion of contacts at which residual and Jacobian are asked for."""

    problem: Problem
    elements: list[Told]
    motion: Array
    """coefficients [m] of whatever moves the contacts so, shape (2H + 1, dofs)"""
    frequency: float
    """[rad/s]"""
    harmonics: int
    samples: int

    def told(self, motion: Array, repeats: int) -> dict[str, Any]:
        """Return the case for pyHarm, at a motion of shape (2H + 1, dofs)."""
        return {
            **_matrices(self.problem),
            "elements": self.elements,
            "motions": 3,
            "harmonics": self.harmonics,
            "samples": self.samples,
            "repeats": repeats,
            "steps": {},
            "point": motion.ravel().tolist(),
            "frequency": self.frequency,
        }


def duffing() -> Case:
    """Return a mass on a spring that hardens, through its fold and back."""
    problem = system(
        mass=[1.0],
        stiffness=[1.0],
        damping=[0.05],
        elements=[Element(CubicSpring(cubic=1.0), between=("x1", "ground"))],
        drive={"x1": 0.1},
    )
    cubic: Told = ("CubicSpring", [0], {"k": 1.0})
    return Case(problem, [cubic], 0.5, 2.0, 7, 128, 0.05)


def chain() -> Case:
    """Return the scene of that name; pyHarm does not get past 1.65 rad/s."""
    slider = {"k": 20.0, "mu": 1.0, "N0": 1.0}
    elements: list[Told] = [
        ("Jenkins", [0], slider),
        ("Jenkins", [0, 1], slider),
        ("CubicSpring", [1], {"k": 1.0}),
        ("CubicSpring", [1, 2], {"k": 1.0}),
        ("PenaltyUnilateralGap", [2], {"k": 1.0, "g": 0.25}),
    ]
    problem = problem_of(load_scene("chain"))
    return Case(problem, elements, 0.5, 2.0, 7, 1024, 0.2, ("scipyroot",), 100)


SECTORS, ORDER = 24, 3
STIFFNESS, LIMIT = 40.0, 0.3
"""of a slider between two tips [N/m], [N]"""


def blisk() -> Case:
    """Return 24 blades of four masses whose tips rub on their neighbours'."""
    springs, disk = (400.0, 300.0, 200.0), 150.0
    own = np.diag([100.0 + 2.0 * disk, 0.0, 0.0, 0.0])
    for place, spring in enumerate(springs):
        pair = slice(place, place + 2)
        own[pair, pair] += spring * np.array([[1.0, -1.0], [-1.0, 1.0]])
    ahead = np.roll(np.eye(SECTORS), 1, axis=1)
    tie = np.diag([-disk, 0.0, 0.0, 0.0])
    stiffness = np.kron(np.eye(SECTORS), own) + np.kron(ahead + ahead.T, tie)
    names = [
        f"{blade}.{part}"
        for blade in range(SECTORS)
        for part in ("disk", "root", "middle", "tip")
    ]
    tips = names[3::4]
    load = EngineOrder(tips, ORDER, 0.5).load(names)
    problem = system(
        mass=np.tile([4.0, 1.0, 0.5, 0.3], SECTORS),
        stiffness=stiffness,
        damping=1e-3 * stiffness,
        names=names,
        elements=[
            Element(Jenkins(STIFFNESS, LIMIT), between=pair)
            for pair in zip(tips, [*tips[1:], tips[0]], strict=True)
        ],
        drive={
            name: (abs(load[place]), float(np.angle(load[place])))
            for place, name in enumerate(names)
            if load[place]
        },
        probes=[tips[0]],
    )
    slider = {"k": STIFFNESS, "mu": 1.0, "N0": LIMIT}
    elements: list[Told] = [
        ("Jenkins", [4 * blade + 3, (4 * blade + 7) % (4 * SECTORS)], slider)
        for blade in range(SECTORS)
    ]
    return Case(problem, elements, 6.0, 8.5, 3, 128, 0.25, ("NewtonRaphson",))


POINTS, HARMONICS = 36, 5
NORMAL, TANGENTIAL, PRELOAD, MU = 1e4, 5e3, 10.0, 0.4


def contacts() -> Evaluation:
    """Return two bodies of 36 nodes on springs, pressed together; all contacts slide.

    Loads vary, but no contact separates: pyHarm's normal force then jumps. Tangential
    motions have no mean: there alone the rules for what sticks agree.
    """
    names = [
        f"{body}{n}.{axis}" for body in "ab" for n in range(POINTS) for axis in "xyz"
    ]
    count = len(names)
    law = ElasticFriction(
        normal_stiffness=NORMAL, preload=PRELOAD, stiffness=TANGENTIAL, mu=MU
    )
    tie = 200.0 * (np.eye(count, k=3) + np.eye(count, k=-3))
    tie[count // 2 :, : count // 2] = tie[: count // 2, count // 2 :] = 0.0
    stiffness = np.diag(1e3 + tie.sum(axis=0)) - tie
    problem = system(
        mass=np.repeat([1.0, 2.0], count // 2),
        stiffness=stiffness,
        damping=1e-3 * stiffness,
        names=names,
        elements=[
            Element(
                law,
                normal=(f"b{n}.x", f"a{n}.x"),
                tangents=[(f"a{n}.{axis}", f"b{n}.{axis}") for axis in "yz"],
            )
            for n in range(POINTS)
        ],
        preload={
            f"{body}{n}.x": sign * PRELOAD
            for body, sign in (("a", -1.0), ("b", 1.0))
            for n in range(POINTS)
        },
        probes=names[:1],
    )
    numbers = {
        "mu": MU, "N0": PRELOAD, "g": 0.0, "k_n": NORMAL, "k_t": TANGENTIAL,
        "dirs": [0, 1, 2],
    }  # fmt: skip
    elements: list[Told] = [
        ("Penalty3D", [n, n + POINTS], numbers) for n in range(POINTS)
    ]
    return Evaluation(problem, elements, _sliding(), 10.0, HARMONICS, 256)


def _sliding() -> Array:
    """Return a motion of the first body along which every contact slides."""
    random = np.random.default_rng(1)
    motion = random.normal(size=(2 * HARMONICS + 1, 2 * POINTS, 3))
    orders = (np.arange(2 * HARMONICS + 1) + 1) // 2
    motion /= (1.0 + orders[:, None, None]) ** 2
    motion[0, :, 1:] = 0.0
    motion[:, :, 0] *= 0.3 * PRELOAD / NORMAL
    motion[:, :, 1:] *= 10.0 * MU * PRELOAD / TANGENTIAL
    motion[:, POINTS:] = 0.0
    return motion.reshape(len(motion), -1)


def _matrices(problem: Problem) -> dict[str, Any]:
    """Return M, C and K as lists."""
    structure = problem.structure
    return {
        "M": structure.mass.tolist(),
        "C": structure.damping.tolist(),
        "K": structure.stiffness.tolist(),
    }


def _loads(problem: Problem) -> list[Told]:
    """Return the drive: p sin(ωt + φ) is p cos(φ − π/2 + ωt)."""
    told: list[Told] = []
    for place in np.flatnonzero(problem.drive):
        load = complex(problem.drive[place])
        turn = math.pi / 2.0 - math.atan2(load.imag, load.real)
        numbers = {"dto": 0, "ho": 1, "phi": turn, "amp": abs(load)}
        told.append(("GOForcing", [int(place)], numbers))
    return told
