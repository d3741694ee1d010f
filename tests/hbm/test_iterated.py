"""Solutions by GMRES against those by factors of all orders."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from hbm.balance import iterated, linearisation
from hbm.balance.linearisation import Linearisation
from hbm.balance.residual import HarmonicBalance
from hbm.continuation.bordered import Bordered
from hbm.continuation.corrected import correct_at
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.homotopy import approaches
from hbm.forces.fourier import FourierBasis, to_complex, to_real
from hbm.forces.remembered import fits
from hbm.forces.touch_factors import touch_factors
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.solve import frequency_response
from lap_joint import lap_joint
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.bristles import Dahl
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem

FREQUENCY = 2.0 * np.pi * 134.9
"""near the peak: normal forces of jammed faces change by half"""
FEW, FOURIER = FourierBasis(7, 128), FourierBasis(127, 1024)
CONTROL = StepControl(tolerance=1e-6)


class Case(NamedTuple):
    """The full rig, and a motion near a response of it."""

    balance: HarmonicBalance
    point: Array
    unknowns: NDArray[np.int64]
    """where they are in the point"""


@lru_cache(maxsize=2)
def case(*, symmetry: bool) -> Case:
    """Return the rig with what a symmetry keeps still left out, or with all of it."""
    problem = rig_problem(model="full")
    rest = static_equilibrium(problem)
    path = along_frequency(
        problem, rest, FREQUENCY, 1.01 * FREQUENCY, symmetry=symmetry
    )
    few, balance = path.balance(FEW), path.balance(FOURIER)
    assert isinstance(few, HarmonicBalance)
    assert isinstance(balance, HarmonicBalance)
    coarse = next(approaches(path, FREQUENCY, CONTROL, Effort(), np.ones_like))
    found = correct_at(few, few.point(coarse, FREQUENCY), CONTROL)
    solved, _ = few.split(found.point)
    motion = np.zeros((FOURIER.coefficients, balance.rank))
    motion[: len(solved)] = solved
    orders = (np.arange(FOURIER.coefficients)[:, None] + 1) // 2
    ripple = np.random.default_rng(3).standard_normal(motion.shape)
    ripple *= 1e-3 * np.abs(solved[1:]).max(axis=0) / np.maximum(orders, 1) ** 3.0
    motion[1:] += ripple[1:]
    unknowns = np.flatnonzero(path.mask(FOURIER.harmonics))
    return Case(balance, balance.point(motion, FREQUENCY), unknowns)


def border(size: int) -> Array:
    """Return a border across a curve, as continuation has it."""
    along = np.zeros(size)
    along[:60] = np.random.default_rng(4).standard_normal(60)
    along[-1] = 1.0
    return along


def test_solutions_by_iteration_are_those_by_factors() -> None:
    balance, point, unknowns = case(symmetry=True)
    residual, linearised = balance(point)
    jacobian, slope = linearised.jacobian, linearised.slope
    normal = border(point.size)
    correction, unit = np.append(residual, 0.0), np.zeros(point.size)
    unit[-1] = 1.0
    dense = Linearisation(lambda: (jacobian, slope), unknowns, point.size)

    def fail() -> tuple[Array, Array]:
        raise AssertionError("factors of all orders are asked for")

    iterating = Linearisation(fail, unknowns, point.size, linearised.parts)
    for row, right, share in (
        (unit, correction, 1e-2),  # which the next one corrects
        (normal, correction, 1e-2),
        (normal, unit, 1e-4),
    ):
        found, expected = iterating.solve(row, right), dense.solve(row, right)

        away = np.linalg.norm((found - expected)[:-1])
        assert away <= share * np.linalg.norm(expected[:-1])
        assert found[-1] == pytest.approx(expected[-1], rel=share, abs=1e-12)


@pytest.mark.parametrize("symmetry", [True, False])
def test_products_by_samples_are_those_by_the_assembled_jacobian(
    symmetry: bool,
) -> None:
    balance, point, unknowns = case(symmetry=symmetry)
    _, linearised = balance(point)
    moved = np.zeros((FOURIER.coefficients, balance.rank))
    moved.ravel()[unknowns] = np.random.default_rng(5).standard_normal(unknowns.size)

    found = balance.contact.tangents.product()(moved, FREQUENCY).ravel()[unknowns]

    orders = 1j * FREQUENCY * np.arange(FOURIER.harmonics + 1)
    held = balance.problem.condensed.dynamic_stiffness(orders)
    held[0] += balance.problem.gauge
    structure = to_real((held @ to_complex(moved)[..., None])[..., 0])
    whole = linearised.jacobian @ moved.ravel()[unknowns]
    expected = whole - structure.ravel()[unknowns]
    assert np.abs(found - expected).max() <= 1e-11 * np.abs(whole).max()
    assert np.abs(expected).max() > 1e-6 * np.abs(whole).max()


def test_products_where_faces_part_are_those_of_the_jacobian() -> None:
    problem = rig_problem(model="full", contact__damping_ratio=0.0)
    rest = static_equilibrium(problem)
    path = along_frequency(problem, rest, FREQUENCY, 1.01 * FREQUENCY)
    balance = path.balance(FOURIER)
    assert isinstance(balance, HarmonicBalance)
    unknowns = np.flatnonzero(path.mask(FOURIER.harmonics))
    motion = np.zeros(FOURIER.coefficients * balance.rank)
    draw = np.random.default_rng(6).standard_normal(unknowns.size)
    orders = (unknowns // balance.rank + 1) // 2
    depth = np.abs(problem.interface.displacement @ rest.displacement).max()
    motion[unknowns] = 3.0 * depth * draw / np.maximum(orders, 1) ** 2
    coefficients = motion.reshape(FOURIER.coefficients, balance.rank)
    _, linearised = balance(balance.point(coefficients, FREQUENCY))
    places = np.where(path.mask(FOURIER.harmonics), 0, -1)
    assert linearised.parts is not None
    parts, step = (
        linearised.parts(),
        np.random.default_rng(7).standard_normal(draw.size),
    )

    found, expected = parts.product(step), linearised.jacobian @ step

    assert np.abs(found - expected).max() <= 1e-11 * np.abs(expected).max()
    low = len(parts.corner)
    corner = linearised.jacobian[:low, :low]
    assert np.abs(parts.corner - corner).max() <= 1e-11 * np.abs(corner).max()
    assert touch_factors(balance.contact, places) is not None


@lru_cache(maxsize=4)
def remembering(name: str) -> Case:
    """Return contacts that remember, and a motion near a response of them."""
    made = {
        # its outer half lies where friction alone holds it along the beam
        "joint": lambda: lap_joint(pairs=5, bolts=2e4, drive=1.0),
        "joint that opens": lambda: lap_joint(pairs=5, bolts=1e3, drive=1.0),
        "both tangents": _pads,
    }
    problem, frequency = made[name](), 2.0 * np.pi * 26.9
    rest = static_equilibrium(problem)
    path = along_frequency(problem, rest, frequency, 1.01 * frequency)
    balance = path.balance(FOURIER)
    options = CurveOptions(
        frequency, 1.01 * frequency, harmonics=7, events=False, stability=False
    )
    known = next(frequency_response(problem, rest, options))
    point = balance.point(known.seen(balance.problem.selection), frequency)
    return Case(balance, point, np.flatnonzero(path.mask(FOURIER.harmonics)))


def _pads() -> Problem:
    """Return masses that slide about on the ground, pressed by springs."""
    names = [f"{axis}{mass}" for mass in range(4) for axis in "zxy"]
    law = ElasticFriction(
        normal_stiffness=4e4, normal_damping=1e5, stiffness=2e4, mu=0.5
    )
    chain = 2.0 * np.eye(4) - np.eye(4, k=1) - np.eye(4, k=-1)
    return system(
        mass=np.ones(12),
        stiffness=np.kron(1e4 * chain, np.eye(3)) + np.diag([2e4, 1e4, 1e4] * 4),
        names=names,
        damping_ratio=0.01,
        elements=[
            Element(
                law,
                normal=(f"z{mass}", "ground"),
                tangents=[(f"{axis}{mass}", "ground") for axis in "xy"],
                name=f"pad {mass}",
            )
            for mass in range(4)
        ],
        preload={f"z{mass}": 20.0 for mass in range(4)},
        drive={"x0": 30.0, "y1": (0.0, 30.0), "z2": 30.0},
    )


REMEMBERING = ("joint", "joint that opens", "both tangents")


@pytest.mark.parametrize("name", REMEMBERING)
def test_products_of_what_remembers_are_those_of_the_jacobian(name: str) -> None:
    balance, point, unknowns = remembering(name)
    _, linearised = balance(point)
    assert linearised.parts is not None
    parts = linearised.parts()
    step = np.random.default_rng(8).standard_normal(unknowns.size)

    found, expected = parts.product(step), linearised.jacobian @ step

    assert np.abs(found - expected).max() <= 1e-11 * np.abs(expected).max()
    low = len(parts.corner)
    corner = linearised.jacobian[:low, :low]
    assert np.abs(parts.corner - corner).max() <= 1e-11 * np.abs(corner).max()


@pytest.mark.parametrize("name", REMEMBERING)
def test_what_remembers_is_solved_by_iteration(name: str) -> None:
    balance, point, unknowns = remembering(name)
    residual, linearised = balance(point)
    unit = np.zeros(point.size)
    unit[-1] = 1.0
    right = np.append(residual, 0.0)

    found = linearised.solve(unit, right)

    assert linearised.parts is not None
    expected = np.linalg.solve(linearised.jacobian, residual[unknowns])
    away = np.linalg.norm(found[unknowns] - expected)
    assert away <= 1e-3 * np.linalg.norm(expected)


def test_derivatives_of_many_bristles_are_too_many_for_products() -> None:
    law = Dahl(stiffness=1e4, mu=0.3, load=1.0)
    names = tuple(f"x{each}" for each in range(16))
    problem = system(
        mass=np.ones(16),
        stiffness=1e3 * (2.0 * np.eye(16) - np.eye(16, k=1) - np.eye(16, k=-1)),
        names=names,
        damping_ratio=0.01,
        elements=[Element(law, tangents=[(name, "ground")]) for name in names],
        drive={"x0": (3.0, 0.0)},
        probes={"x0": "x0"},
    )
    path = along_frequency(problem, static_equilibrium(problem), 30.0, 31.0)
    points, basis = problem.interface.points, path.problem.basis

    assert fits(points, basis, FourierBasis(63, 512))
    assert not fits(points, basis, FourierBasis(255, 2048))


def test_what_takes_too_many_products_is_solved_by_factors(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    balance, point, unknowns = case(symmetry=True)
    monkeypatch.setattr(iterated, "SHARE", unknowns.size // 2)
    made: list[int] = []

    def factored(jacobian: Array, slope: Array, border: Array, *_: object) -> Bordered:
        made.append(slope.size)
        return Bordered(jacobian, slope, border)

    monkeypatch.setattr(linearisation, "factored", factored)
    residual, linearised = balance(point)
    right = np.append(residual, 0.0)

    found = linearised.solve(border(point.size), right)

    assert made == [unknowns.size]
    missing = linearised.jacobian @ found[unknowns] + found[-1] * linearised.slope
    size = np.abs(linearised.jacobian) @ np.abs(found[unknowns])
    assert np.abs(missing - right[unknowns]).max() <= 1e-10 * size.max()


@pytest.mark.parametrize("harmonics", [127, 140])
def test_coordinates_of_odd_harmonics_alone_are_solved(harmonics: int) -> None:
    masses = 12
    names = tuple(f"x{each}" for each in range(masses))
    law = RegularisedCoulomb(mu=0.3, load=1.0, threshold_velocity=1e-3)
    ring = 2.0 * np.eye(masses) - np.eye(masses, k=1) - np.eye(masses, k=-1)
    problem = system(
        mass=np.ones(masses),
        stiffness=1e3 * ring,
        names=names,
        elements=[Element(law, tangents=[(name, "ground")]) for name in names],
        drive={"x0": (3.0, 0.0)},
    )
    path = along_frequency(problem, static_equilibrium(problem), 30.0, 31.0)
    assert not path.mask(harmonics)[4::4].any()
    balance = path.balance(FourierBasis(harmonics, 8 * (harmonics + 1)))
    rng = np.random.default_rng(6)
    moved = 1e-4 * rng.standard_normal((2 * harmonics + 1, masses))
    point = np.append(moved.ravel(), 30.0)
    residual, linearised = balance(point)
    unit = np.zeros(point.size)
    unit[-1] = 1.0

    found = linearised.solve(unit, np.append(residual, 0.0))

    assert linearised.parts is not None
    unknowns = np.flatnonzero(path.mask(harmonics))
    expected = np.linalg.solve(linearised.jacobian, residual[unknowns])
    away = np.linalg.norm(found[unknowns] - expected)
    assert away <= 1e-3 * np.linalg.norm(expected)


def test_another_last_component_has_its_own_slope() -> None:
    balance, point, unknowns = case(symmetry=True)
    _, linearised = balance(point)
    balance.contact(np.zeros((FOURIER.coefficients, balance.rank)), FREQUENCY)
    slope = np.zeros(point.size - 1)
    slope[unknowns] = np.random.default_rng(7).standard_normal(unknowns.size)
    unit = np.zeros(point.size)
    unit[-1] = 1.0

    found = linearised.with_slope(slope).solve(unit, unit)

    expected = -np.linalg.solve(linearised.jacobian, slope[unknowns])
    away = np.linalg.norm(found[unknowns] - expected)
    assert away <= 1e-4 * np.linalg.norm(expected)


def test_few_unknowns_are_factored_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = rig_problem(model="A")
    path = along_frequency(
        problem, static_equilibrium(problem), FREQUENCY, 1.01 * FREQUENCY
    )
    balance = path.balance(FOURIER)
    point = np.zeros(FOURIER.coefficients * path.rank + 1)
    point[-1] = FREQUENCY

    monkeypatch.delattr(linearisation, "Iterated")
    _, linearised = balance(point)
    unit = np.zeros(point.size)
    unit[-1] = 1.0

    found = linearised.solve(unit, unit)

    assert found[-1] == 1.0
