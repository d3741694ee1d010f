"""One sector of a bladed disk against the whole disk."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg

from benchmarks.cyclic import around
from hbm.curves.cyclic import cyclic_response
from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from memory_problems import JENKINS
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import (
    COULOMB,
    TWO_SIDED,
    PointLaw,
    contact_table,
)
from microslip_mechanics.cyclic import Coupling, CyclicProblem
from microslip_mechanics.problem import Probes
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure

COULOMB_LAW = PointLaw(
    friction=COULOMB, dynamic=0.3, threshold=0.05, constant_load=True, load=1.0
)
DAMPER = replace(COULOMB_LAW, normal=TWO_SIDED, damping=0.02)
HARMONICS = 5


def bladed_disk(sectors: int, engine_order: int, law: PointLaw) -> CyclicProblem:
    """Return sectors of disk, root, middle and tip whose tips rub on each other."""
    springs, disk = (400.0, 300.0, 200.0), 150.0
    stiffness = np.diag([100.0 + 2.0 * disk, 0.0, 0.0, 0.0])
    for place, spring in enumerate(springs):
        pair = slice(place, place + 2)
        stiffness[pair, pair] += spring * np.array([[1.0, -1.0], [-1.0, 1.0]])
    tie = np.zeros((4, 4))
    tie[0, 0] = -disk
    own, following = np.zeros((2, 3, 4))
    own[:2, 3], following[:2, 3] = 1.0, -1.0
    return CyclicProblem(
        sectors,
        engine_order,
        Structure(
            np.diag([4.0, 1.0, 0.5, 0.3]),
            1e-3 * stiffness,
            stiffness,
            ("disk", "root", "middle", "tip"),
        ),
        Coupling(np.zeros((4, 4)), 1e-3 * tie, tie),
        Interface(contact_table([law]), own, ("tip",)),
        following,
        np.zeros(4),
        np.array([0.0, 0.0, 0.0, 0.5]),
        Probes(("tip",), np.eye(4)[3:]),
    )


def first_frequency(problem: CyclicProblem) -> float:
    squares = scipy.linalg.eigh(
        problem.wave("stiffness", problem.lead),
        problem.wave("mass", problem.lead),
        eigvals_only=True,
    )
    return float(np.sqrt(squares[0]))


@pytest.mark.parametrize(
    ("sectors", "engine_order", "law"),
    [
        (6, 2, JENKINS),
        (5, 2, JENKINS),
        (6, 1, COULOMB_LAW),
        (4, 2, JENKINS),
        (3, 3, JENKINS),
        (6, 1, DAMPER),
    ],
    ids=["jenkins", "odd number", "coulomb", "standing wave", "in phase", "damper"],
)
def test_sector_moves_like_the_disk(
    sectors: int, engine_order: int, law: PointLaw
) -> None:
    problem = bladed_disk(sectors, engine_order, law)
    samples = 40 * sectors  # the sectors' samples then fall on each other
    middle = first_frequency(problem)
    options = CurveOptions(
        0.8 * middle,
        1.3 * middle,
        harmonics=HARMONICS,
        samples=samples,
        tolerance=1e-11,
    )
    disk = problem.disk()
    curve = list(cyclic_response(problem, options))
    largest = max(np.hypot(*point.coefficients[1:3, 3]) for point in curve)
    assert largest > 3.0 * np.hypot(*curve[0].coefficients[1:3, 3])  # there is a peak
    for point in curve[3::12]:
        whole = around(problem, point)
        guess = replace(point, coefficients=0.98 * whole)
        solved = periodic_response(
            disk,
            static_equilibrium(disk),
            guess,
            harmonics=HARMONICS,
            samples=samples,
            tolerance=1e-11,
        )
        assert solved.coefficients == pytest.approx(
            whole, abs=1e-9 * np.abs(whole).max()
        )
        for name in ("friction_energy", "damping_energy"):
            found, expected = getattr(point, name), getattr(solved, name)
            assert found == pytest.approx(expected, rel=1e-6, abs=1e-9)
    assert (curve[-1].damping_energy > 1e-6) == (law is DAMPER)


def test_mistuning_breaks_the_symmetry() -> None:
    problem = bladed_disk(4, 1, COULOMB_LAW)
    tuned, mistuned = problem.disk(), problem.disk(np.array([0.02, -0.01, 0.0, 0.01]))
    change = mistuned.structure.stiffness - tuned.structure.stiffness
    assert change[0, 0] == pytest.approx(0.02 * problem.sector.stiffness[0, 0])
    assert np.abs(change[8:12]).max() == 0.0


def test_coupling_of_the_wrong_shape_is_refused() -> None:
    problem = bladed_disk(4, 1, COULOMB_LAW)
    wrong = Coupling(np.zeros((3, 3)), *2 * (np.zeros((4, 4)),))
    with pytest.raises(ValueError, match=r"coupling\.mass has shape \(3, 3\)"):
        replace(problem, coupling=wrong)


@pytest.mark.parametrize("order", [1, 2, 4])
def test_a_wave_runs_round_the_disk_the_way_that_it_leads(order: int) -> None:
    """Even if the tie from a sector to the next is not the one back."""
    problem = bladed_disk(6, order, PointLaw())
    tie = problem.coupling.stiffness.copy()
    tie[0, 1] = -20.0
    problem = replace(problem, coupling=replace(problem.coupling, stiffness=tie))
    wave = np.kron(np.exp(1j * problem.lead * np.arange(6))[:, None], np.eye(4))

    whole = problem.disk().structure.stiffness @ wave
    assert np.abs(whole - wave @ problem.wave("stiffness", problem.lead)).max() < 1e-9


def test_contacts_between_sectors_rest_as_those_of_the_disk() -> None:
    problem = bladed_disk(6, 2, PointLaw(stiffness=500.0, exponent=1.0))
    own, following = np.zeros((2, 3, 4))
    own[0, 3], following[0, 3] = 1.0, -0.5
    problem = replace(
        problem,
        interface=replace(problem.interface, displacement=own),
        to_next=following,
        preload=np.array([0.0, 0.0, 0.0, 2.0]),
    )

    one, all_ = (
        static_equilibrium(each) for each in (problem.standing(), problem.disk())
    )
    assert one.displacement == pytest.approx(
        [0.00554913, 0.00693642, 0.00878613, 0.01156069], rel=1e-6
    )
    assert all_.displacement == pytest.approx(np.tile(one.displacement, 6), rel=1e-9)
