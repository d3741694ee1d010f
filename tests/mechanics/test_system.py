"""User systems: what they become, and one clear line for each that is malformed."""

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
from microslip_mechanics.laws.polynomial_spring import CubicSpring, PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.system import system

MASS, STIFFNESS = [1.0, 2.0], [[30.0, -10.0], [-10.0, 10.0]]
BUCKLED = [[30.0, -10.0], [-10.0, 3.0]]
"""with a motion, mostly of the second mass, that this stiffness drives away"""
SLIDER = Jenkins(20.0, 1.0)
IWAN = Iwan(1.0, 20.0, -0.5, 0.1, sliders=3)


def made(**changes: Any) -> Any:
    given = {"mass": MASS, "stiffness": STIFFNESS, "drive": {"x1": 1.0}, **changes}
    return system(**given)


def test_elements_see_the_first_end_relative_to_the_second() -> None:
    problem = made(
        elements=[
            Element(SLIDER, between=("x1", "x2"), name="slider"),
            Element(CubicSpring(5.0), between=({"x1": 2.0}, "ground")),
        ]
    )

    assert problem.interface.names == ("slider", "element-2")
    rows = problem.interface.displacement
    np.testing.assert_array_equal(rows[1], [1.0, -1.0])
    np.testing.assert_array_equal(rows[3], [2.0, 0.0])
    assert np.count_nonzero(rows) == 3


def test_contact_has_normal_and_tangents_where_it_says() -> None:
    law = ElasticFriction(stiffness=3.0, mu=0.2, normal_stiffness=9.0)
    places: dict[str, Any] = {
        "normal": ("x1", "ground"),
        "tangents": [("x2", "ground")],
    }

    problem = made(elements=[Element(law, **places, name="face")])

    np.testing.assert_array_equal(
        problem.interface.displacement, [[1, 0], [0, 1], [0, 0]]
    )


def test_modal_damping_damps_each_mode_alike() -> None:
    problem = made(damping_ratio=0.03)

    structure = problem.structure
    squares, shapes = np.linalg.eig(
        np.linalg.solve(structure.mass, structure.stiffness)
    )
    for square, shape in zip(squares, shapes.T, strict=True):
        lost = shape @ structure.damping @ shape / (shape @ structure.mass @ shape)
        assert lost == pytest.approx(2.0 * 0.03 * np.sqrt(square), rel=1e-10)


def test_rayleigh_damping_and_sparse_matrices_are_kept() -> None:
    problem = system(
        mass=scipy.sparse.diags_array(MASS),
        stiffness=scipy.sparse.csr_array(np.array(STIFFNESS)),
        rayleigh_damping=(0.5, 1e-3),
        probes=["x2"],
    )

    assert problem.structure.sparse
    expected = 0.5 * np.diag(MASS) + 1e-3 * np.array(STIFFNESS)
    np.testing.assert_allclose(problem.structure.damping.toarray(), expected)


@pytest.mark.parametrize("sparse", [False, True])
@pytest.mark.parametrize("name", ["mass", "stiffness", "damping"])
def test_complex_matrices_are_refused_rather_than_cut(name: str, sparse: bool) -> None:
    given: dict[str, Any] = dict.fromkeys(("mass", "stiffness", "damping"), np.eye(2))
    given[name] = given[name] * (1.0 + 0.05j)
    made: dict[str, Any] = {
        key: scipy.sparse.csc_array(each) if sparse else each
        for key, each in given.items()
    }

    with pytest.raises(ValueError, match=f"{name} is complex: .* loss_factor"):
        system(**made, drive={"x1": 1.0})


def test_sparse_matrices_are_copied() -> None:
    stiffness = scipy.sparse.csc_array(3.0 * np.eye(2))
    mass = scipy.sparse.csc_array(np.eye(2))
    problem = system(mass=mass, stiffness=stiffness, drive={"x1": 1.0})

    stiffness.data[:] = 7.0

    assert problem.structure.stiffness[0, 0] == 3.0


def test_drive_has_amplitudes_and_phases() -> None:
    assert made(drive={"x1": 2.0, "x2": (3.0, np.pi)}).drive.tolist() == [2.0, -3.0]

    turned = made(drive={"x1": 2.0, "x2": (3.0, np.pi / 2)}).drive

    np.testing.assert_allclose(turned, [2.0, 3.0j], atol=1e-15)


def test_probes_are_degrees_of_freedom_forms_or_pairs() -> None:
    probes = {"first": "x1", "mean": {"x1": 0.5, "x2": 0.5}, "gap": ("x1", "x2")}

    rows = made(probes=probes).probes.rows

    np.testing.assert_array_equal(rows, [[1, 0], [0.5, 0.5], [1, -1]])


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

    with pytest.raises(ValueError, match=r".") as raised:
        made(**changes)

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


@pytest.mark.parametrize("pair", [[2.0, 0.5], np.array([2.0, 0.5])])
def test_a_pair_of_amplitude_and_phase_may_be_a_list_or_an_array(pair: Any) -> None:
    listed = system(mass=MASS, stiffness=STIFFNESS, drive={"x1": pair})

    paired = system(mass=MASS, stiffness=STIFFNESS, drive={"x1": (2.0, 0.5)})
    np.testing.assert_array_equal(listed.drive, paired.drive)
