"""The residual of a nonlinear mode: its derivative, and what it is at poles."""

import math

import numpy as np
import pytest

from hbm.balance.relative_problem import relative_problem
from hbm.forces.fourier import FourierBasis
from hbm.modes.free_motion import free_motion
from hbm.modes.linear_modes import linear_modes
from hbm.modes.modal import ModalBalance
from hbm.modes.modal_parts import ModalParts, Reference
from hbm.structure.condensation import condense
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

AMPLITUDE, TINY = 1e-4, 1e-10
"""[m], the second without slip and separation"""
FOURIER = FourierBasis(4, 128)


def balance_and_point(random: np.random.Generator) -> tuple[ModalBalance, np.ndarray]:
    """Return the soft full rig, creeping everywhere, and a motion near its mode."""
    problem = rig_problem(
        model="full", contact__sigma=3e-7, friction__threshold_velocity="1 m/s"
    )
    relative = relative_problem(problem, static_equilibrium(problem))
    linear = linear_modes(problem, relative, 800.0, 900.0)[0]
    condensed = condense(problem, relative.selection)
    mass, kept = problem.structure.mass, np.arange(relative.rank)
    row = linear.shape.conj() @ mass
    size = float((row @ linear.shape).real)
    free = free_motion(condensed, kept, mass, linear.pole, size)
    reference = Reference(linear.pole, row / size, linear.frequency**2 * size)
    active = np.ones((FOURIER.coefficients, relative.rank), dtype=bool)
    balance = ModalBalance(relative, free, reference, FOURIER, active)
    shape = np.zeros(active.shape)
    moved = relative.selection @ linear.shape
    shape[1], shape[2] = moved.real, -moved.imag
    shape += 1e-3 * random.normal(size=shape.shape)
    modal = free.modal(linear.pole, moved, linear.shape)
    parts = ModalParts(shape, modal, linear.pole * (1.0 + 0.01j), AMPLITUDE)
    return balance, balance.unknowns.point(
        parts, FOURIER.coefficients * balance.unknowns.width + 1
    )


def test_the_jacobian_is_the_derivative_of_the_residual() -> None:
    random = np.random.default_rng(3)
    balance, point = balance_and_point(random)
    _, linearised = balance(point)
    unknown = np.zeros((FOURIER.coefficients, balance.unknowns.width), dtype=bool)
    unknown[:, : balance.rank] = True
    unknown[1:3] = True
    places = [*np.flatnonzero(unknown), point.size - 1]
    step = 1e-6

    # [J; n] d = (J; n) e gives back each unit vector e of the unknowns
    for place in places:
        ahead, behind = point.copy(), point.copy()
        ahead[place] += step
        behind[place] -= step
        slope = (balance(ahead)[0] - balance(behind)[0]) / (2.0 * step)
        normal = np.zeros_like(point)
        normal[-1] = 1.0
        found = linearised.solve(normal, np.append(slope, float(place == places[-1])))
        expected = np.zeros_like(point)
        expected[place] = 1.0
        assert np.abs(found - expected).max() < 1e-5


def test_the_first_harmonic_has_exact_derivatives() -> None:
    random = np.random.default_rng(5)
    balance, point = balance_and_point(random)
    free, parts, row = (
        balance.free,
        balance.unknowns.parts(point),
        balance.reference.row,
    )
    values = random.normal(size=(2, balance.rank + free.count, 2)) @ [1.0, 1j]

    def at(share: float) -> tuple[np.ndarray, np.ndarray]:
        moved = values[0] + share * values[1]
        pole = parts.pole * (1.0 + share * (0.3 + 0.2j))
        first, last = moved[: balance.rank], moved[balance.rank :]
        left, matrix = free.balance(pole, first, last)
        seen, slopes = free.seen(pole, first, last, row)
        return np.append(left, seen), np.vstack([matrix, slopes])

    step = 1e-5
    change = (at(step)[0] - at(-step)[0]) / (2.0 * step)
    along = np.append(values[1], parts.pole * (0.3 + 0.2j))
    expected = at(0.0)[1] @ along
    size = np.abs(at(0.0)[1]) @ np.abs(along)
    assert np.all(np.abs(change - expected) < 1e-8 * size)


def test_the_far_and_the_near_poles_are_the_whole_structure() -> None:
    balance, point = balance_and_point(np.random.default_rng(4))
    free, parts = balance.free, balance.unknowns.parts(point)
    relative = parts.shape[1] - 1j * parts.shape[2]
    near = free.near
    into = parts.pole * near.viscous + parts.pole**2 * near.inertial
    modal = -(into @ relative) / (parts.pole - near.poles)

    left, _ = free.balance(parts.pole, relative, modal)

    whole = balance.problem.condensed.dynamic_stiffness(np.array([parts.pole]))
    expected = whole[0] @ relative
    size = np.abs(expected).max()
    assert near.poles.size > 0
    assert np.abs(left[: balance.rank] - expected).max() < 1e-10 * size
    none = np.zeros((1, len(balance.problem.condensed.static)), complex)
    motion = balance.problem.condensed.motion(
        np.array([parts.pole]), relative[None], none
    )[0]
    row = balance.reference.row
    value, _ = free.seen(parts.pole, relative, modal, row)
    assert abs(value - row @ motion) < 1e-10 * abs(row @ motion)
    assert math.isclose(parts.amplitude, AMPLITUDE)


def test_high_orders_of_a_tiny_motion_answer_until_nothing_is_left() -> None:
    """Contacts that neither part nor slip are springs: each order is alone."""
    balance, point = balance_and_point(np.random.default_rng(4))
    point[-1] = math.log(TINY)
    residual = balance.residual(point)

    left = balance.residual(point + balance.answer(point, residual, 1))

    high = slice(3 * balance.unknowns.width, None)
    assert np.abs(residual[high]).max() > 1e-5
    assert np.abs(left[high]).max() < 1e-3 * np.abs(residual[high]).max()
    assert left[: high.start] == pytest.approx(residual[: high.start], abs=1e-6)
