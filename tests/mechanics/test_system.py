"""User systems: what they become."""

from typing import Any

import numpy as np
import pytest
import scipy.sparse

from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.system import system

MASS, STIFFNESS = [1.0, 2.0], [[30.0, -10.0], [-10.0, 10.0]]
SLIDER = Jenkins(20.0, 1.0)


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


@pytest.mark.parametrize("pair", [[2.0, 0.5], np.array([2.0, 0.5])])
def test_a_pair_of_amplitude_and_phase_may_be_a_list_or_an_array(pair: Any) -> None:
    listed = system(mass=MASS, stiffness=STIFFNESS, drive={"x1": pair})

    paired = system(mass=MASS, stiffness=STIFFNESS, drive={"x1": (2.0, 0.5)})
    np.testing.assert_array_equal(listed.drive, paired.drive)
