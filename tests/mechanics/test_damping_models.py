"""Damping models: ratios of each mode, dense and sparse; what is refused."""

import dataclasses
import re
from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

from microslip_mechanics.arrays import Array
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.hysteretic import equivalent_viscous
from microslip_mechanics.structures.modal_damping import ModalDamping
from microslip_mechanics.structures.natural_modes import natural_modes
from microslip_mechanics.structures.rayleigh import Rayleigh
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.system import system
from sparse_problems import dense, net

RATIOS = (0.01, 0.0, 0.03, 0.002, 0.005)


def damped(structure: Structure, damping: ModalDamping | Rayleigh) -> Structure:
    return Structure(
        structure.mass,
        damping.matrix(structure),
        structure.stiffness,
        structure.names,
    )


def modal(structure: Structure) -> tuple[Array, Array]:
    """Return all frequencies, and C in the modes of unit mass."""
    squares, shapes = scipy.linalg.eigh(structure.stiffness, structure.mass)
    return np.sqrt(squares), shapes.T @ structure.damping @ shapes


def test_rayleigh_has_its_ratios_at_two_frequencies() -> None:
    structure = dense(net(4, 5)).structure
    frequencies, _ = modal(structure)
    low, high = frequencies[2], frequencies[11]

    damping = Rayleigh.of_ratios((low, high), (0.01, 0.012))

    _, found = modal(damped(structure, damping))
    ratios = np.diag(found) / (2.0 * frequencies)
    assert ratios[2] == pytest.approx(0.01)
    assert ratios[11] == pytest.approx(0.012)
    np.testing.assert_allclose(found, np.diag(np.diag(found)), atol=1e-9)


def test_modal_damping_gives_each_mode_its_ratio() -> None:
    structure = dense(net(4, 5)).structure
    frequencies, _ = modal(structure)

    _, found = modal(damped(structure, ModalDamping(RATIOS)))

    wanted = 2.0 * RATIOS[-1] / frequencies[len(RATIOS) - 1] * frequencies**2
    wanted[: len(RATIOS)] = 2.0 * np.array(RATIOS) * frequencies[: len(RATIOS)]
    # two modes of the net may be as fast as each other, and mix
    np.testing.assert_allclose(np.linalg.eigvalsh(found), np.sort(wanted), atol=1e-9)


@pytest.mark.parametrize("shape", [(5, 6), (21, 22)])
def test_modal_damping_of_a_sparse_structure_is_that_of_the_dense_one(
    shape: tuple[int, int],
) -> None:
    sparse = net(*shape).structure
    damping = ModalDamping(RATIOS)

    found = damping.matrix(sparse)

    wanted = damping.matrix(dense(net(*shape)).structure)
    moved = np.random.default_rng(5).normal(size=(sparse.dofs, 3))
    np.testing.assert_allclose(
        found @ moved, wanted @ moved, atol=1e-7 * np.abs(wanted @ moved).max()
    )


def test_a_sparse_structure_with_modal_damping_is_reduced_like_a_full_matrix() -> None:
    problem = net(21, 22)
    structure, plain = problem.structure, dense(problem).structure
    full = ModalDamping(RATIOS).matrix(plain)

    found, wanted = (
        reduced(
            dataclasses.replace(
                problem, structure=dataclasses.replace(structure, damping=damping)
            ),
            1500.0,
        )
        for damping in (
            ModalDamping(RATIOS).matrix(structure),
            scipy.sparse.csc_array(full),
        )
    )

    damping = found.problem.structure.damping
    exact = found.shapes.T @ full @ found.shapes
    np.testing.assert_allclose(
        damping, exact, rtol=0, atol=1e-7 * np.abs(damping).max()
    )
    assert found.truncation.damping == pytest.approx(
        wanted.truncation.damping, rel=5e-3
    )
    assert static_equilibrium(found.whole).iterations == 0


def response(matrix: Array, load: Array) -> Array:
    return np.linalg.solve(matrix, load)


@pytest.mark.parametrize("loss", [0.02, 0.3])
def test_hysteretic_and_viscous_responses_differ_as_stated(loss: float) -> None:
    problem = dense(net(4, 5))
    structure = problem.structure
    modes = natural_modes(structure, structure.dofs)
    viscous = equivalent_viscous(loss, structure.dofs).matrix(structure)
    weights = modes.shapes.T @ structure.mass

    for frequency in np.linspace(50.0, 2500.0, 40):
        load = problem.drive.astype(complex)
        inertia = frequency**2 * structure.mass
        exact = response((1.0 + 1j * loss) * structure.stiffness - inertia, load)
        found = response(structure.stiffness + 1j * frequency * viscous - inertia, load)
        share, change = weights @ exact, weights @ (found - exact)
        ratio = frequency / modes.frequencies
        errors = loss * np.abs(1.0 - ratio) / np.abs(1.0 - ratio**2 + 1j * loss * ratio)
        np.testing.assert_allclose(
            np.abs(change), errors * np.abs(share), atol=1e-9 * np.abs(share).max()
        )
        bound = loss / (1.0 + ratio)
        assert (errors <= bound * (1.0 + 1e-12)).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: Rayleigh(-1.0, 0.0),
            "damping by mass -1: give zero or a positive number",
        ),
        (
            lambda: Rayleigh(0.0, np.nan),
            "damping by stiffness nan: give zero or a positive number",
        ),
        (
            lambda: Rayleigh.of_ratios((100.0, 100.0), (0.1, 0.1)),
            "frequencies 100 and 100 rad/s: give two different positive ones",
        ),
        (
            lambda: Rayleigh.of_ratios((100.0, 200.0), (0.1, 0.01)),
            "ratios 0.1 and 0.01 at 100 and 200 rad/s need a negative coefficient: "
            "give ratios that differ less, or modal damping",
        ),
        (lambda: ModalDamping(()), "no damping ratios: give at least one"),
        (
            lambda: ModalDamping((0.1, -0.1)),
            "damping ratio -0.1 of mode 2: give zero or a positive number",
        ),
        (
            lambda: ModalDamping((0.1,) * 21).matrix(dense(net(4, 5)).structure),
            "21 modes of a structure with 20 degrees of freedom: give 20 at the most",
        ),
        (
            lambda: equivalent_viscous(-0.1, 4),
            "loss factor -0.1: give one from 0 to below 1",
        ),
    ],
)
def test_impossible_damping_is_refused(
    make: Callable[[], object], message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        make()


@pytest.mark.parametrize("ratio", [np.float32(0.02), np.array(0.02), 0.02])
def test_one_ratio_of_any_kind_is_that_of_every_mode(ratio: float) -> None:
    found = system(
        mass=[1.0, 1.0],
        stiffness=[[2e4, -1e4], [-1e4, 1e4]],
        damping_ratio=ratio,
        drive={"x1": 1.0},
    )

    squares, shapes = scipy.linalg.eigh(found.structure.stiffness, found.structure.mass)
    rates = np.diag(shapes.T @ found.structure.damping @ shapes)
    np.testing.assert_allclose(rates / 2.0 / np.sqrt(squares), 0.02, rtol=1e-6)
