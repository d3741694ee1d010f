"""Malformed systems and laws: one clear line for each."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
import scipy.sparse

from microslip_mechanics.element import Element
from microslip_mechanics.laws.area_contact import AreaContact
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.iwan import Iwan
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.system import system

MASS, STIFFNESS = [1.0, 2.0], [[30.0, -10.0], [-10.0, 10.0]]
BUCKLED = [[30.0, -10.0], [-10.0, 3.0]]
"""with a motion, mostly of the second mass, that this stiffness drives away"""
SLIDER = Jenkins(20.0, 1.0)
IWAN = Iwan(1.0, 20.0, -0.5, 0.1, sliders=3)


def between(*ends: Any) -> dict[str, Any]:
    return {"elements": [Element(SLIDER, between=ends, name="slider")]}


FAULTS: Mapping[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "asymmetric mass": (
        {"mass": [[1.0, 0.2], [0.0, 1.0]]},
        ("mass is not symmetric",),
    ),
    "asymmetric stiffness": (
        {"stiffness": [[1.0, 0.2], [0.0, 1.0]]},
        ("stiffness is not symmetric",),
    ),
    "no mass": ({"mass": [1.0, 0.0]}, ("mass of x2 is 0", "some mass")),
    "singular mass": (
        {"mass": [[1.0, 1.0], [1.0, 1.0]]},
        ("mass is not positive definite", "some motion has no mass"),
    ),
    "negative damping": (
        {"damping": [0.1, -0.1]},
        ("damping of x2 is -0.1", "negative damping"),
    ),
    "gaining damping": (
        {"damping": [[0.1, 0.2], [0.2, 0.1]]},
        ("puts energy into", "negative eigenvalues"),
    ),
    "gaining sparse damping": (
        {
            "mass": scipy.sparse.diags_array(MASS),
            "stiffness": scipy.sparse.csc_array(np.array(STIFFNESS)),
            "damping": scipy.sparse.csc_array(np.array([[0.1, 0.2], [0.2, 0.1]])),
        },
        ("puts energy into", "negative eigenvalues"),
    ),
    "Rayleigh damping of a stiffness that drives": (
        {"stiffness": BUCKLED, "rayleigh_damping": (0.0, 1e-3)},
        ("puts energy into a motion mostly of x2", "negative eigenvalues"),
    ),
    "sparse Rayleigh damping of a stiffness that drives": (
        {
            "mass": scipy.sparse.diags_array(MASS),
            "stiffness": scipy.sparse.csc_array(np.array(BUCKLED)),
            "rayleigh_damping": (0.0, 1e-3),
        },
        ("puts energy into", "negative eigenvalues"),
    ),
    "damping ratio of a stiffness that drives": (
        {"stiffness": BUCKLED, "damping_ratio": 0.01},
        ("stiffness is negative along a motion mostly of x2", "a damping matrix"),
    ),
    "damping ratio of a single unstable mode": (
        {"stiffness": BUCKLED, "damping_ratio": [0.01]},
        ("stiffness is negative along a motion mostly of x2", "a damping matrix"),
    ),
    "skew damping": (
        {"damping": [[0.1, 0.2], [-0.2, 0.1]]},
        ("damping is not symmetric", "beside a skew-symmetric gyroscopic matrix"),
    ),
    "symmetric gyroscopic matrix": (
        {"gyroscopic": [[0.0, 0.2], [0.2, 0.0]]},
        ("gyroscopic is not skew-symmetric: 0.2 of x1 by x2 but 0.2 of x2 by x1",),
    ),
    "diagonal as gyroscopic matrix": (
        {"gyroscopic": [0.1, 0.0]},
        ("gyroscopic is not skew-symmetric: 0.1 of x1 by x1", "as damping"),
    ),
    "gyroscopic matrix of others": (
        {"gyroscopic": np.zeros((3, 3))},
        ("gyroscopic has shape (3, 3), but mass has (2, 2)",),
    ),
    "one Rayleigh coefficient": (
        {"rayleigh_damping": (0.1,)},
        ("rayleigh_damping = (0.1,)", "give two numbers"),
    ),
    "booleans for masses": ({"mass": [True, True]}, ("mass holds a truth value",)),
    "one boolean": ({"mass": [1.0, True]}, ("mass holds a truth value",)),
    "400 digits": ({"mass": [1.0, 10**400]}, ("mass holds a number above 1e+50",)),
    "structural damping in a list": (
        {"stiffness": [[2e4 + 40j, -1e4], [-1e4, 1e4]]},
        ("stiffness is complex", "loss_factor"),
    ),
    "rows of unequal length": (
        {"stiffness": [[2e4], [-1e4, 1e4]]},
        ("stiffness is no matrix of numbers", "rows of equal length"),
    ),
    "stiffness with a unit": (
        {"stiffness": [["20 kN/m", -1e4], [-1e4, 1e4]]},
        ("stiffness holds the text '20 kN/m'", "SI units"),
    ),
    "negative ratio": ({"damping_ratio": -0.1}, ("damping_ratio = -0.1", "0 to")),
    "negative Rayleigh": ({"rayleigh_damping": (-1.0, 0.0)}, ("by mass -1",)),
    "damping twice": (
        {"damping": [0.1, 0.1], "damping_ratio": 0.1},
        ("damping is given twice",),
    ),
    "unknown node": (between("x1", "x3"), ("slider", "'x3'", "x1", "x2")),
    "node mistyped": (between("X1", "ground"), ("slider", "'X1'", "x1")),
    "one end left out": (between("x1"), ("slider: between", "two ends", '"ground"')),
    "empty end": (between("x1", {}), ("slider", "no motion")),
    "end without a name": (between("x1", None), ("slider", "no motion")),
    "same ends": (between("x1", "x1"), ("slider", "do not move")),
    "both grounded": (between("ground", "ground"), ("slider", "do not move")),
    "no direction": (
        {"elements": [Element(SLIDER, name="slider")]},
        ("slider: between has 0", 'Jenkins (law = "jenkins") needs 1'),
    ),
    "direction not taken": (
        {"elements": [Element(SLIDER, normal=("x1", "ground"), name="slider")]},
        ("slider",),
    ),
    "normal left out": (
        {
            "elements": [
                Element(
                    ElasticFriction(stiffness=1.0, mu=0.2, normal_stiffness=1.0),
                    tangents=[("x1", "ground")],
                    name="face",
                )
            ]
        },
        ("face: normal has 0", "needs 1"),
    ),
    "rotations missing": (
        {
            "elements": [
                Element(
                    AreaContact(1.0, 1.0, 1.0),
                    normal=("x1", "ground"),
                    rotations=[("x2", "ground")],
                )
            ]
        },
        ("rotations has 1", "needs 2"),
    ),
    "elements named alike": (
        {
            "elements": [
                Element(SLIDER, between=("x1", "ground"), name="a"),
                Element(SLIDER, between=("x2", "ground"), name="a"),
            ]
        },
        ("two elements are named a",),
    ),
    "elements of several points named alike": (
        {
            "elements": [
                Element(IWAN, between=("x1", "ground"), name="a"),
                Element(IWAN, between=("x2", "ground"), name="a"),
            ]
        },
        ("two elements are named a: name element 2",),
    ),
    "an element named like a point of another": (
        {
            "elements": [
                Element(SLIDER, between=("x1", "ground"), name="a-2"),
                Element(IWAN, between=("x2", "ground"), name="a"),
            ]
        },
        ("two elements are named a: name element 2",),
    ),
    "factor that is no number": (
        between({"x1": float("nan")}, "ground"),
        ("slider", "factor nan of x1"),
    ),
    "factor in a list": (between({"x1": [1.0]}, "ground"), ("factor [1.0] of x1",)),
    "a table in place of ends": (
        {"elements": [Element(SLIDER, between={"x1": 1.0})]},  # type: ignore[arg-type]
        ("two ends", """[{'x1': 1.0}, "ground"]"""),
    ),
    "ends that are a number": ({"probes": {"tip": 3}}, ("probe tip = 3", "two ends")),
    "probes that are a number": ({"probes": 3}, ("probes = 3", "names")),
    "probe twice": ({"probes": ["x1", "x2", "x1"]}, ("probes: x1", "more than once")),
    "probe without a name": ({"probes": [True]}, ("probe True", "two ends")),
    "stiffness of another shape": (
        {"stiffness": np.eye(3)},
        ("stiffness has shape (3, 3)", "mass has (2, 2)"),
    ),
    "mass that is no square": ({"mass": np.ones((2, 3))}, ("mass has shape (2, 3)",)),
    "ragged rows": ({"stiffness": [[1.0], [1.0, 2.0]]}, ("stiffness", "equal length")),
    "NaN in the stiffness": (
        {"stiffness": [[np.nan, 0.0], [0.0, 1.0]]},
        ("stiffness holds a value that is not finite",),
    ),
    "NaN in the mass": ({"mass": [np.nan, 1.0]}, ("mass", "not finite")),
    "text in the drive": (
        {"drive": {"x1": "0.5 N"}},
        ("drive of x1 is '0.5 N'", "a finite amplitude"),
    ),
    "text in the preload": (
        {"preload": {"x1": "1 N"}},
        ("preload of x1 is 1 N", "a finite number"),
    ),
    "NaN in the drive": ({"drive": {"x1": np.nan}}, ("drive of x1", "finite")),
    "NaN in the preload": ({"preload": {"x2": np.inf}}, ("preload of x2", "finite")),
    "drive on nothing": ({"drive": {"x9": 1.0}}, ("drive", "'x9'")),
    "drive on a node twice": (
        {
            "names": ["1.z", "2.z"],
            "sets": {"face": ["1", "2", "1"]},
            "drive": {"face.z": 1.0},
        },
        ("drive of face.z", "node 1", "more than once", "give each node once"),
    ),
    "drive by number": ({"drive": {1: 1.0}}, ("drive", "no degree of freedom 1")),
    "preload by number": ({"preload": {2: 1.0}}, ("preload", "no degree of freedom 2")),
    "engine order of a table": (
        {"engine_order": {"blades": ["x1"]}},
        ("engine_order = {'blades'", "give microslip.EngineOrder"),
    ),
    "base of a table": (
        {"base": {"direction": [0, 0, 1]}},
        ("base = {'direction'", "give microslip.BaseMotion"),
    ),
    "too many names": ({"names": ["a", "b", "c"]}, ("3 names", "(2, 2)")),
    "names alike": (
        {"names": ["a", "a"]},
        ("a stands there more than once: give each its own name",),
    ),
    "named ground": ({"names": ["a", "ground"]}, ("ground",)),
    "probe of nothing": ({"probes": {"tip": "tip"}}, ("probe tip", "'tip'")),
    "probe of the ground": ({"probes": {"g": "ground"}}, ("probe g never moves",)),
    "sparse beside dense": (
        {"stiffness": scipy.sparse.eye_array(2)},
        ("sparse", "alike"),
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_malformed_system_ends_with_one_line(fault: str) -> None:
    changes, words = FAULTS[fault]
    given: dict[str, Any] = {"mass": MASS, "stiffness": STIFFNESS}
    given |= {"drive": {"x1": 1.0}, **changes}

    with pytest.raises(ValueError, match=r".") as raised:
        system(**given)

    message = str(raised.value)
    assert "\n" not in message
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    ("law", "numbers", "words"),
    [
        (UnilateralSpring, {"stiffness": 1.0, "gap": -0.1}, ("gap = -0.1", "preload")),
        (UnilateralSpring, {"stiffness": -1.0}, ("stiffness = -1", "above 0")),
        (
            UnilateralSpring,
            {"stiffness": 1.0, "gap": 0.1, "preload": 2.0},
            ("gap = 0.1", "preload = 2", "one of the two"),
        ),
        (Jenkins, {"stiffness": np.nan, "limit": 1.0}, ("stiffness = nan", "finite")),
        (Jenkins, {"stiffness": 1.0, "limit": -1.0}, ("limit = -1", "at least 0")),
        (Jenkins, {"stiffness": "20 N/m", "limit": 1.0}, ("'20 N/m'", "SI units")),
        (PolynomialSpring, {"coefficients": {0: 1.0}}, ("power 0", "preload")),
        (PolynomialSpring, {"coefficients": {}}, ("empty",)),
        (PolynomialSpring, {"coefficients": {3: np.inf}}, ("power 3", "finite")),
        (ElasticFriction, {"stiffness": 1.0, "mu": 0.1}, ("load", "normal_stiffness")),
        (
            ElasticFriction,
            {"stiffness": 1.0, "mu": 0.1, "load": 1.0, "gap": 0.1},
            ("gap", "constant load"),
        ),
    ],
)
def test_malformed_law_ends_with_one_line(
    law: Any, numbers: dict[str, Any], words: tuple[str, ...]
) -> None:
    with pytest.raises(ValueError, match=r".") as raised:
        law(**numbers)

    message = str(raised.value)
    assert "\n" not in message
    for word in words:
        assert word in message
