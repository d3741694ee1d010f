"""Static equilibrium against closed forms of one contact and of the wedge."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog

from contact_tables import contact_points
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.element import Element
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.static import StaticError, static_equilibrium
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.system import system
from rigs import rig_problem

pytestmark = pytest.mark.kernels


def pressed(exponent: float, force: float, spring: float = 0.0) -> Problem:
    """Return a mass that is pressed on one contact point, held sideways by nothing."""
    stiffness = np.diag([spring, 0.0, 0.0])
    return Problem(
        Structure(0.01 * np.eye(3), np.zeros((3, 3)), stiffness, ("x", "y", "z")),
        Interface(contact_points(stiffness=2e8, exponent=exponent), np.eye(3), ("p",)),
        preload=np.array([force, 0.0, 0.0]),
        drive=np.zeros(3),
        probes=Probes(("x",), np.eye(1, 3)),
    )


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 2.7])
@pytest.mark.parametrize("force", [1e-3, 1.0, 100.0])
def test_mass_sinks_into_a_contact_until_its_spring_carries_the_load(
    exponent: float, force: float
) -> None:
    problem = pressed(exponent, force)

    rest = static_equilibrium(problem)

    depth = (force / 2e8) ** (1.0 / exponent)
    assert rest.normal_force == pytest.approx([force], rel=1e-9, abs=0.0)
    np.testing.assert_allclose(rest.displacement, [depth, 0.0, 0.0], rtol=1e-9)


def test_spring_beside_a_linear_contact_takes_its_share() -> None:
    problem = pressed(1.0, 3.0, spring=1e8)

    rest = static_equilibrium(problem)

    assert rest.normal_force == pytest.approx([2.0], rel=1e-9, abs=0.0)


@pytest.mark.parametrize("model", ["full", "B", "A"])
@pytest.mark.parametrize("sigma", [3e-9, 3e-7])
@pytest.mark.parametrize("force", [1e-3, 1.0, 100.0])
@pytest.mark.parametrize("rope", [0, 10])
def test_faces_of_the_wedge_carry_what_statics_demands(
    model: str, sigma: float, force: float, rope: float
) -> None:
    problem = rig_problem(
        model=model, contact__sigma=sigma, preload__force=force, rope__stiffness=rope
    )

    rest = static_equilibrium(problem)

    inclined, straight = np.split(rest.normal_force, 2)  # face B, face A
    angle = math.radians(20.0)
    assert inclined.sum() == pytest.approx(force / math.sin(angle), rel=1e-9, abs=0.0)
    assert straight.sum() == pytest.approx(force / math.tan(angle), rel=1e-9, abs=0.0)


def test_points_of_the_rig_carry_what_the_reference_computation_found() -> None:
    problem = rig_problem()

    rest = static_equilibrium(problem)

    # face B, then face A; inner points (radially), then outer ones
    assert problem.interface.names == ("B1", "B2", "B3", "B4", "A1", "A2", "A3", "A4")
    expected = np.repeat([0.61, 0.85, 1.21, 0.16], 2)
    np.testing.assert_allclose(rest.normal_force, expected, rtol=0.0, atol=0.005)


@pytest.mark.parametrize("model", ["full", "B"])
@pytest.mark.parametrize("offset", ["0 mm", "4.51 mm"])
def test_equilibrium_balances_preload_structure_and_contact_springs(
    model: str, offset: str
) -> None:
    problem = rig_problem(model=model, preload__offset=offset)
    points, normals = problem.interface.points, problem.interface.displacement[::3]

    rest = static_equilibrium(problem)

    depth = np.maximum(normals @ rest.displacement, 0.0)
    springs = points.stiffness * depth**points.exponent
    unbalanced = (
        problem.structure.stiffness @ rest.displacement
        + normals.T @ springs
        - problem.preload
    )
    np.testing.assert_allclose(rest.normal_force, springs, rtol=1e-12)
    assert np.abs(unbalanced).max() == pytest.approx(rest.residual, rel=0.0, abs=1e-12)
    assert rest.residual <= 1e-10


def test_outer_points_of_face_a_lift_off_under_a_preload_at_that_face() -> None:
    problem = rig_problem(preload__offset="4.51 mm")

    rest = static_equilibrium(problem)

    inclined, straight = np.split(rest.normal_force, 2)
    np.testing.assert_array_equal(straight[2:], 0.0)
    assert np.all(np.concatenate([inclined, straight[:2]]) > 0.1)
    assert straight.sum() == pytest.approx(
        1.0 / math.tan(math.radians(20.0)), rel=1e-9, abs=0.0
    )


@pytest.mark.parametrize("law", ["none", "gkf"])
def test_friction_carries_nothing_at_rest(law: str) -> None:
    rubbing, other = rig_problem(), rig_problem(friction__law=law)

    rest = static_equilibrium(other)

    np.testing.assert_array_equal(
        rest.normal_force, static_equilibrium(rubbing).normal_force
    )


def test_nothing_moves_without_preload() -> None:
    problem = rig_problem(preload__force=0)

    rest = static_equilibrium(problem)

    np.testing.assert_array_equal(rest.displacement, np.zeros(54))
    np.testing.assert_array_equal(rest.normal_force, np.zeros(8))
    assert (rest.residual, rest.iterations) == (0.0, 0)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_mass_that_is_pulled_off_its_contact_has_no_equilibrium(side: float) -> None:
    problem = pressed(2.0, -side)
    contact = replace(problem.interface, displacement=side * np.eye(3))

    with pytest.raises(StaticError, match=r"after \d{1,2} steps"):
        static_equilibrium(replace(problem, interface=contact))


@pytest.mark.parametrize("force", [2.0, -3e4])
def test_a_spring_holds_a_load_however_far(force: float) -> None:
    problem = system(
        mass=[1.0],
        stiffness=[1.0],
        elements=[Element(UnilateralSpring(9.0, gap=1.0), ("x1", "ground"))],
        preload={"x1": force},
        drive={"x1": 0.1},
    )

    rest = static_equilibrium(problem)

    # u + 9 (u − 1) = 2 at the stop
    assert rest.displacement[0] == pytest.approx(1.1 if force > 0.0 else force)


def test_equilibrium_is_found_where_newtons_steps_must_be_shortened() -> None:
    problem = rig_problem(
        preload__offset="4.51 mm", contact__sigma=1.5e-10, contact__exponent=2.7
    )

    rest = static_equilibrium(problem)

    straight = rest.normal_force[4:].sum()
    expected = 1.0 / math.tan(math.radians(20.0))
    assert straight == pytest.approx(expected, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("seed", range(5))
def test_equilibrium_exists_where_pushing_forces_can_balance_the_wedge(
    seed: int,
) -> None:
    random = np.random.default_rng(seed)
    for _ in range(12):
        problem = rig_problem(
            contact__sigma=float(10.0 ** random.uniform(-10.0, -7.5)),
            contact__exponent=float(random.choice([1.5, 2.0, 2.7, 3.0])),
            contact__angle_excited=f"{random.choice([10, 20, 40])} deg",
            contact__angle_follower=f"{random.choice([0, 10])} deg",
            preload__force=float(10.0 ** random.uniform(-3.0, 1.0)),
            preload__offset=float(random.choice([0.0, 0.001, -0.003, 0.00451])),
        )
        wedge = problem.structure.dofs - np.array([6, 5, 1])  # ux, uy, rz
        moments = np.array([1.0, 1.0, 1e3])  # in N mm, for the linear programme

        try:
            exists = static_equilibrium(problem).residual <= 1e-10
        except StaticError:
            exists = False

        balance = linprog(
            np.zeros(8),
            A_eq=problem.interface.displacement[::3, wedge].T * moments[:, None],
            b_eq=problem.preload[wedge] * moments,
        )
        assert exists == balance.success


@pytest.mark.parametrize("model", ["full", "B"])
def test_preload_that_drives_the_wedge_out_has_no_equilibrium(model: str) -> None:
    problem = rig_problem(model=model)
    inward = replace(problem, preload=-problem.preload)

    with pytest.raises(
        StaticError,
        match=r"^the static preload \(largest load 1 N\) has no equilibrium in contact "
        r"within 1 m, after \d+ steps: check its direction and size, and the contact$",
    ) as failure:
        static_equilibrium(inward)

    assert isinstance(failure.value, MicroslipError)


@pytest.mark.parametrize("elements", [16, 30, 60])
@pytest.mark.parametrize("model", ["full", "B"])
def test_fine_meshes_have_the_same_totals(model: str, elements: int) -> None:
    problem = rig_problem(model=model, blade__elements=elements)

    forces = static_equilibrium(problem).normal_force

    half = len(forces) // 2
    assert forces[half:].sum() == pytest.approx(1 / np.tan(np.radians(20)), rel=1e-6)


def wells(preload: dict[str, float], cubic: float = 1e6, at: str = "x") -> Problem:
    """Return a mass between wells at ± √(100/cubic) m, and one that a spring holds."""
    return system(
        mass=[1.0, 2.0],
        stiffness=[[-100.0, 0.0], [0.0, 1e5]],
        names=("x", "y"),
        elements=[Element(CubicSpring(cubic=cubic), between=(at, "ground"))],
        preload=preload,
    )


@pytest.mark.parametrize("preload", [0.0, 1e-3, -1e-3, 0.1, -0.1, 0.5, 5.0])
def test_rest_between_two_wells_is_in_the_one_of_the_preload(preload: float) -> None:
    rest = static_equilibrium(wells({"x": preload, "y": 3.0}))

    roots = np.roots([1e6, 0.0, -100.0, -preload])
    real = roots[np.abs(roots.imag) < 1e-9].real
    lowest = real.max() if preload >= 0.0 else real.min()
    # it was the hilltop
    assert rest.displacement[0] == pytest.approx(lowest, rel=1e-8)
    assert rest.displacement[1] == pytest.approx(3e-5, rel=1e-9)


def test_rest_of_two_wells_without_any_load_is_in_one_of_them() -> None:
    problem = wells({})

    assert abs(static_equilibrium(problem).displacement[0]) == pytest.approx(0.01)


def test_shallow_wells_are_seen_beside_a_large_preload() -> None:
    problem = wells({"y": 1e4}, cubic=1e12)

    assert abs(static_equilibrium(problem).displacement[0]) == pytest.approx(
        1e-5, rel=1e-3
    )


def test_rest_that_no_spring_holds_is_kept() -> None:
    rest = static_equilibrium(wells({"y": 3.0}, at="y")).displacement

    assert rest[0] == 0.0
    assert rest[1] == pytest.approx(3e-5, rel=1e-6)


def test_a_free_body_is_no_hilltop() -> None:
    problem = system(
        mass=[1.0, 2.0, 3.0],
        stiffness=1e8 * np.array([[0.1, -0.1, 0.0], [-0.1, 0.4, -0.3], [0, -0.3, 0.3]]),
        elements=[Element(CubicSpring(cubic=1e6), between=("x1", "x3"))],
        preload={"x1": 1.0, "x3": -1.0},
    )

    rest = static_equilibrium(problem)

    assert rest.displacement[0] - rest.displacement[2] == pytest.approx(
        1.0 / 1e7 + 1.0 / 3e7, rel=1e-6
    )
