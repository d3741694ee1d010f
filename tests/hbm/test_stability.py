"""Floquet multipliers by harmonic balance, beside closed forms and the time domain."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import expm

from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.curves.periodic_response import periodic_response
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.stability.stability import small_motions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure
from rigs import rig_problem
from small_motions.multipliers import floquet_multipliers
from small_problems import sliding_block

HERTZ = 2.0 * np.pi


def curve(
    problem: Problem,
    lowest: float,
    highest: float,
    harmonics: int | None = None,
    samples: int | None = None,
) -> list[PeriodicResponse]:
    """Return the curve between two frequencies [Hz]."""
    options = CurveOptions(
        HERTZ * lowest, HERTZ * highest, harmonics=harmonics, samples=samples
    )
    return list(frequency_response(problem, static_equilibrium(problem), options))


@pytest.mark.parametrize("samples", [64, 144, 512])
def test_sticking_contacts_have_the_multipliers_of_their_linear_system(
    samples: int,
) -> None:
    problem = rig_problem(model="A", friction__mu_dynamic=50.0)
    rest = static_equilibrium(problem)
    whole = relative_problem(problem, rest)
    balance = HarmonicBalance(whole, FourierBasis(3, samples))
    frequency = HERTZ * 130.0
    balance.contact(balance.split(balance.point(whole.rest[None], frequency))[0], 1.0)

    found = small_motions(problem).multipliers(balance.contact, frequency)

    elastic, viscous = balance.contact.tangents.means()
    structure, select = problem.structure, whole.selection
    none, one = np.zeros_like(structure.mass), np.eye(structure.dofs)
    inverse = np.linalg.inv(structure.mass)
    system = np.block(
        [
            [none, one],
            [
                -inverse @ (structure.stiffness + select.T @ elastic @ select),
                -inverse @ (structure.damping + select.T @ viscous @ select),
            ],
        ]
    )
    exact = np.linalg.eigvals(expm(system * 2.0 * np.pi / frequency))
    largest = np.sort(np.abs(exact))[::-1]
    # the first are creep of the regularised friction, then the resonant mode
    np.testing.assert_allclose(np.abs(found[:4]), largest[:4], rtol=2e-4)


@pytest.mark.parametrize(
    ("model", "law"),
    [
        ("A", "coulomb"),
        pytest.param("A", "gkf", marks=pytest.mark.long),
        pytest.param("B", "coulomb", marks=pytest.mark.long),
        pytest.param("B", "gkf", marks=pytest.mark.long),
    ],
)
def test_largest_multipliers_are_those_of_the_time_domain(model: str, law: str) -> None:
    problem = rig_problem(model=model, friction__law=law)
    points = curve(problem, 134.0, 136.0)
    chosen = points[:: max(1, len(points) // 8)]

    for point in chosen:
        other = floquet_multipliers(problem, point, steps=512)
        # measured: up to 2e-4, most of it from the modes that are left out
        assert abs(point.multipliers[0]) == pytest.approx(
            abs(other.values[0]), abs=1e-3
        )


@pytest.mark.long
def test_rattling_contacts_get_the_multipliers_of_more_harmonics() -> None:
    problem = rig_problem(model="full")
    rest = static_equilibrium(problem)
    points = curve(problem, 134.8, 135.2)
    at = 2.0 * np.pi * 135.058
    point = min(points, key=lambda each: abs(each.frequency - at))
    finest = periodic_response(problem, rest, point, harmonics=63, samples=1024)

    other = floquet_multipliers(problem, finest, steps=1024)

    # with the harmonics that the amplitude asks for it is 1.003
    assert abs(other.values[0]) > 1.1
    assert abs(point.multipliers[0]) == pytest.approx(abs(other.values[0]), abs=0.05)


def test_stability_of_rattling_contacts_changes_where_a_multiplier_crosses() -> None:
    points = curve(rig_problem(model="full"), 125.0, 145.0)

    kinds = "Neimark-Sacker", "branch point"
    beside = [each for each in points if not each.event or each.event in kinds]
    stays = [each for each in beside if not each.event]
    turns = sum(one.unstable != two.unstable for one, two in pairwise(stays))
    assert len(beside) - len(stays) == turns > 0  # as many as the points say

    for before, event, after in zip(beside, beside[1:], beside[2:], strict=False):
        if event.event not in kinds:
            continue
        moduli = np.abs(event.multipliers)
        # without the one of the element on its rope, which hardly decays, or pairs with
        # what crosses; if that is even nearer to the circle it is where it should be
        moduli = np.delete(moduli, np.abs(moduli - 1.0).argmin())
        crossing = moduli[min(before.unstable, after.unstable)]
        # A hundredth of a step is what it is located to, and it changes by up to 0.7 in
        # a step; the reported orbit has more harmonics: 1.0055 becomes 1.0155. The
        # modes of the blades, at 0.9917, are not it.
        assert -6e-3 < crossing - 1.0 < 2e-2


@pytest.mark.parametrize("model", ["A", "full"])
def test_half_a_period_and_its_mirror_image_are_a_period(model: str) -> None:
    problem = rig_problem(model=model, friction__law="gkf")
    point = curve(problem, 135.3, 136.0, harmonics=15, samples=128)[0]
    whole = relative_problem(problem, static_equilibrium(problem))
    balance = HarmonicBalance(whole, FourierBasis(15, 128))
    seen = balance.point(point.coefficients @ whole.selection.T, point.frequency)
    balance.contact(balance.split(seen)[0], point.frequency)

    # all coordinates, so that the contacts know of no symmetry
    assert balance.contact.symmetry.signs.size == 0
    found = small_motions(problem).multipliers(balance.contact, point.frequency)

    largest = np.abs(found[:8])
    np.testing.assert_allclose(np.abs(point.multipliers[:8]), largest, atol=1e-6)


def test_falling_friction_makes_a_torus_and_coulomb_friction_never() -> None:
    falling = curve(rig_problem(model="A", friction__law="gkf"), 134.3, 134.8)
    coulomb = curve(rig_problem(model="A"), 134.0, 136.0)

    assert max(point.unstable for point in falling) == 2
    assert "Neimark-Sacker" in {point.event for point in falling}
    # Coulomb friction with constant load is monotone: every motion decays
    assert {point.unstable for point in coulomb} == {0}


def test_a_peak_is_where_dense_points_have_it() -> None:
    problem = rig_problem(model="A")
    fixed = {"harmonics": 15, "samples": 512}
    peak = next(
        each for each in curve(problem, 134.8, 135.3, **fixed) if each.event == "peak"
    )
    hertz = peak.frequency / HERTZ

    around = [
        curve(problem, hertz + away, 136.0, **fixed)[0]
        for away in (-2e-3, -1e-3, 1e-3, 2e-3)
    ]

    rows = problem.probes.rows
    sizes = [
        float(np.hypot(*(each.coefficients[1:3] @ rows.T)).max())
        for each in [*around, peak]
    ]
    # a kink or a smooth top: none of the neighbours is higher
    assert sizes[-1] >= max(sizes[:-1])


def test_a_mass_that_a_dashpot_alone_couples_is_not_left_out() -> None:
    # The first mass rubs and holds the third by a spring; stuck, it moves the second
    # neither by springs nor by inertia.
    rubbing = sliding_block().interface
    structure = Structure(
        np.diag([2.0, 1.0, 0.5]),
        np.array([[3.0, -3.0, 0.0], [-3.0, 3.5, 0.0], [0.0, 0.0, 0.1]]),
        np.array([[300.0, 0.0, -50.0], [0.0, 200.0, 0.0], [-50.0, 0.0, 150.0]]),
        ("rubs", "by a dashpot", "by a spring"),
    )
    along = np.hstack([rubbing.displacement, np.zeros((3, 2))])
    contact, probes = Interface(rubbing.points, along, ("point",)), np.eye(1, 3)
    whole = Problem(
        structure, contact, np.zeros(3), np.zeros(3), Probes(("rubs",), probes)
    )

    motions = small_motions(whole)

    def poles(mass: Array, damping: Array, stiffness: Array) -> ComplexArray:
        below = -np.linalg.solve(mass, np.hstack([stiffness, damping]))
        count = len(mass)
        first_order = np.vstack([np.eye(count, 2 * count, count), below])
        return np.sort_complex(np.linalg.eigvals(first_order).astype(complex))

    found = poles(motions.mass, motions.damping, motions.stiffness)
    exact = poles(structure.mass, structure.damping, structure.stiffness)
    assert found == pytest.approx(exact, rel=1e-9)
