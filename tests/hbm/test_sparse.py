"""Harmonic balance of sparse structures beside dense ones and direct solutions."""

import dataclasses
import itertools
import tracemalloc

import numpy as np
import pytest
import scipy.sparse.linalg

from hbm.curves.periodic_response import periodic_response
from hbm.forces.fourier import to_complex
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.stability.stability import small_motions
from hbm.structure.condensation import condense
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduction import Reduction, reduced
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import response_curve
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_motions.multipliers import floquet_multipliers
from sparse_problems import dense, net, sparse
from timedomain.integrate import MarchOptions, integrate

HERTZ = 2.0 * np.pi
ALL = 1e7
"""frequency above all modes of the rig [rad/s]"""
SLOWEST = 624.0
"""slowest mode of a large net with stuck contacts [rad/s], about"""


def curve(
    problem: Problem, options: CurveOptions, count: int | None = None
) -> list[PeriodicResponse]:
    """Return the first ``count`` points of a curve."""
    rest = static_equilibrium(problem)
    return list(itertools.islice(frequency_response(problem, rest, options), count))


@pytest.mark.parametrize("model", ["A", "full"])
def test_a_sparse_structure_has_the_curve_of_the_same_dense_one(model: str) -> None:
    problem = rig_problem(model=model)
    options = CurveOptions(130.0 * HERTZ, 132.0 * HERTZ, harmonics=7, highest=ALL)

    found, expected = curve(sparse(problem), options), curve(problem, options)

    assert len(found) == len(expected) > 5
    for one, other in zip(found, expected, strict=True):
        assert one.frequency == pytest.approx(other.frequency, rel=1e-8)
        assert np.abs(one.multipliers[0]) == pytest.approx(
            np.abs(other.multipliers[0]), rel=1e-8
        )
    found_curve, exact_curve = (
        response_curve(problem, each, "complete") for each in (found, expected)
    )
    # the points lie where Newton's last step has left them on the curve
    np.testing.assert_allclose(found_curve.peak, exact_curve.peak, rtol=1e-6)


@pytest.mark.parametrize("model", ["A", "full"])
def test_responses_at_one_frequency_are_the_same(model: str) -> None:
    problem = rig_problem(model=model)
    options = CurveOptions(130.0 * HERTZ, 135.0 * HERTZ, harmonics=7)

    for point in curve(problem, options)[::8]:
        found, exact = (
            periodic_response(
                each,
                static_equilibrium(each),
                point,
                harmonics=9,
                samples=160,
                tolerance=1e-13,
                highest=ALL,
            ).seen(problem.probes.rows)
            for each in (sparse(problem), problem)
        )
        np.testing.assert_allclose(
            found, exact, rtol=0, atol=1e-8 * np.abs(exact).max()
        )


def whole_stiffness(
    problem: Problem, variable: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return dynamic stiffness and load by the drive on the points, order by order."""
    basis, selection = problem.interface.relative_motion()
    condensed = condense(problem, selection)
    force = np.tile(problem.drive.astype(complex), (variable.size, 1))
    stiffness = condensed.dynamic_stiffness(variable)
    load, _ = condensed.loading(force)(variable)
    return basis @ stiffness @ basis.T, load @ basis.T


def truncated(reduction: Reduction, frequencies: Array) -> tuple[Array, Array]:
    """Return true changes by truncation over their bounds, at each frequency."""
    variable = 1j * frequencies
    pairs = zip(
        whole_stiffness(reduction.problem, variable),
        whole_stiffness(dense(reduction.whole), variable),
        strict=True,
    )
    stiffness, load = (found - exact for found, exact in pairs)
    bounds = np.array([reduction.error(float(each)) for each in frequencies])
    return (
        np.linalg.norm(stiffness, 2, axis=(1, 2)) / bounds[:, 0],
        np.linalg.norm(load, axis=1) / bounds[:, 1],
    )


@pytest.mark.parametrize("highest", [800.0, 2000.0])
@pytest.mark.parametrize("stiffness_damping", [0.0, 2e-6, 1e-4])
@pytest.mark.parametrize(("contacts", "phase"), [(1, 0.0), (4, 0.0), (4, 1.0)])
def test_truncation_changes_less_than_its_bound(
    contacts: int, phase: float, stiffness_damping: float, highest: float
) -> None:
    problem = net(
        12,
        11,
        contacts=contacts,
        stiffness_damping=stiffness_damping,
        mass_damping=1e5 * stiffness_damping,
    )
    if phase:  # two loads, out of phase with each other
        turned = np.roll(problem.drive, 7) * np.exp(1j * phase)
        problem = dataclasses.replace(problem, drive=problem.drive + turned)
    reduction = reduced(problem, highest)
    assert reduction.problem.structure.dofs < problem.structure.dofs
    limit = reduction.truncation.limit

    stiffness, load = truncated(reduction, limit * np.array([0.3, 0.5, 0.7, 0.9]))

    assert stiffness.max() < 1.0
    assert load.max() < 1.0
    # nor is the bound idle: measured from 7e-4 (much damping) to 0.25
    assert stiffness.max() > 1e-4
    assert reduction.error(limit) == (np.inf, np.inf)


def test_truncation_is_bounded_where_damping_is_most_of_what_is_left_out() -> None:
    # Dashpots between the masses and the ground: at low frequencies a mode that is left
    # out moves less by its inertia, (ω/ω_k)², than by its damping, 300 ω/ω_k².
    problem = net(12, 11, contacts=4, stiffness_damping=0.0, mass_damping=300.0)
    reduction = reduced(problem, 800.0)
    limit = reduction.truncation.limit

    stiffness, load = truncated(reduction, limit * np.array([0.02, 0.1, 0.3]))

    assert stiffness.max() < 1.0  # measured 0.04; 4 by inertia alone
    assert load.max() < 1.0


def test_truncation_falls_with_the_modes() -> None:
    problem = net(12, 11)

    errors = [reduced(problem, highest).error(400.0) for highest in (500.0, 2000.0)]

    for few, many in zip(*errors, strict=True):
        assert many < 0.1 * few


def large_curve(highest: float) -> CurveOptions:
    return CurveOptions(
        0.95 * SLOWEST,
        1.05 * SLOWEST,
        harmonics=63,
        stability=False,
        highest=highest,
    )


def missed(problem: Problem, response: PeriodicResponse, order: int) -> float:
    """Return by how much one order misses a direct solution with the same contacts.

    The friction force is what gives the contact the motion that it has.
    """
    structure, tangent = problem.structure, problem.interface.displacement[1]
    s = 1j * order * response.frequency
    dynamic = structure.stiffness + s * (structure.damping + s * structure.mass)
    solve = scipy.sparse.linalg.splu(dynamic.tocsc()).solve
    driven = solve(-1j * problem.drive) if order == 1 else np.zeros(len(tangent))
    by_contact = solve(tangent.astype(complex))
    assert response.shapes is not None
    motion = to_complex(response.coefficients)[order] @ response.shapes.T
    force = (tangent @ (motion - driven)) / (tangent @ by_contact)
    exact = driven + force * by_contact
    return float(np.abs(motion - exact).max() / np.abs(exact).max())


@pytest.mark.long
@pytest.mark.slow
def test_twenty_thousand_degrees_of_freedom() -> None:
    problem = net(141, 142)
    options = large_curve(highest=4.0 * SLOWEST)
    points = curve(problem, options, 1)  # compiles
    tracemalloc.start()

    points = curve(problem, options, 40)

    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(points) == 40
    # all coefficients of all points would take 0.8 GB
    whole = 40 * (2 * 63 + 1) * problem.structure.dofs * 8
    assert sum(each.coefficients.nbytes for each in points) < whole / 100
    assert all(each.shapes is points[0].shapes for each in points)
    assert peak < whole / 5


@pytest.mark.slow
def test_a_large_structure_moves_as_direct_solutions_say() -> None:
    problem = net(141, 142)
    coarse, fine = (
        curve(problem, large_curve(highest=times * SLOWEST), 1)[0] for times in (2, 4)
    )

    for order in (1, 3):
        few, many = (missed(problem, each, order) for each in (coarse, fine))
        # the static correction leaves the square of order ω over the limit; measured
        # 1.1e-3 and 2.6e-4, 5.6e-3 and 3.2e-4
        assert many < 1e-3
        assert few > 3.0 * many


def test_one_response_with_another_resolution() -> None:
    problem = net(12, 11)
    options = CurveOptions(600.0, 620.0, harmonics=5, highest=2500.0, stability=False)
    known = curve(problem, options, 1)[0]

    rest = static_equilibrium(problem)
    finer = periodic_response(
        problem, rest, known, harmonics=15, samples=256, highest=2500.0
    )

    assert finer.iterations < 10
    seen, before = (each.seen(problem.probes.rows) for each in (finer, known))
    np.testing.assert_allclose(
        seen[: len(before)], before, rtol=0, atol=1e-2 * np.abs(before).max()
    )
    displacement, _ = finer.at(np.zeros(1))
    assert displacement.shape == (1, problem.structure.dofs)
    np.testing.assert_allclose(
        displacement @ problem.probes.rows.T,
        [seen[0] + seen[1::2].sum(axis=0)],
        rtol=1e-10,
    )


def test_without_contact_there_is_a_curve_too() -> None:
    problem = net(12, 11, contacts=0)
    options = CurveOptions(300.0, 400.0, harmonics=1, highest=2500.0, stability=False)

    point = curve(problem, options, 1)[0]

    s = 300.0j
    structure = dense(problem).structure
    dynamic = structure.stiffness + s * (structure.damping + s * structure.mass)
    exact = problem.probes.rows @ np.linalg.solve(dynamic, -1j * problem.drive)
    seen = to_complex(point.seen(problem.probes.rows))[1]
    np.testing.assert_allclose(seen, exact, rtol=1e-5)


def test_what_needs_a_dense_structure_says_so() -> None:
    problem = net(5, 5)
    _, selection = problem.interface.relative_motion()
    response = curve(problem, CurveOptions(300.0, 310.0, harmonics=1), 1)[0]
    text = r"^the structure is sparse, .*: reduce it, in a scene by "

    with pytest.raises(ValueError, match=text):
        condense(problem, selection)
    with pytest.raises(ValueError, match=text):
        small_motions(problem)
    with pytest.raises(ValueError, match=text):
        next(integrate(problem, Dwell(300.0, 0.1), MarchOptions()))
    with pytest.raises(ValueError, match=text):
        floquet_multipliers(problem, response, steps=16)
