"""Forces and dissipation of laws against closed forms, in harmonic balance."""

import numpy as np
import pytest
import scipy.integrate

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.contact_cycle import ContactCycle
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import contact_table
from microslip_mechanics.laws.area_contact import AreaContact
from microslip_mechanics.laws.dampers import LinearDamper, QuadraticDamper
from microslip_mechanics.laws.iwan import Iwan
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import CubicSpring, PolynomialSpring
from microslip_mechanics.laws.row import Law
from microslip_mechanics.laws.unilateral import UnilateralSpring

FREQUENCY = 7.0
IWAN = Iwan(10.0, 2e6, -0.6, 0.2, sliders=40, smallest=1e-3)


def cycled(
    law: Law, amplitude: float, samples: int = 4096
) -> tuple[Array, ContactCycle]:
    """Return the force's coefficients and the cycle of w = amplitude sin ωt."""
    rows = law.rows({"between": 1})
    basis = np.zeros((3 * len(rows), 1))
    for place, row in enumerate(rows):
        basis[3 * place + (0 if row.normal else 1)] = 1.0
    table = contact_table([row.point for row in rows])
    balance = AlternatingFrequencyTime(table, basis, FourierBasis(5, samples))
    motion = np.zeros((11, 1))
    motion[2] = amplitude
    force = balance(motion, FREQUENCY)
    return force[:, 0], balance.cycle(motion, FREQUENCY)


def test_cubic_spring_has_three_quarters_of_its_cube() -> None:
    force, cycle = cycled(CubicSpring(200.0), 0.3)

    assert force[2] == pytest.approx(0.75 * 200.0 * 0.3**3, rel=1e-12)
    assert force[6] == pytest.approx(-0.25 * 200.0 * 0.3**3, rel=1e-12)
    assert cycle.friction == 0.0


def test_polynomial_is_the_sum_of_its_powers() -> None:
    force, _ = cycled(PolynomialSpring({1: 5.0, 2: 40.0, 3: 200.0}), 0.3)

    assert force[0] == pytest.approx(40.0 * 0.3**2 / 2.0, rel=1e-12)
    assert force[2] == pytest.approx(5.0 * 0.3 + 0.75 * 200.0 * 0.3**3, rel=1e-12)


@pytest.mark.parametrize("gap", [0.0, 0.1, 0.25])
def test_unilateral_spring_has_its_describing_function(gap: float) -> None:
    force, _ = cycled(UnilateralSpring(80.0, gap=gap), 0.3)

    turn = np.arcsin(gap / 0.3)
    closed = 0.3 / np.pi * (np.pi / 2 - turn + np.sin(turn) * np.cos(turn))
    closed -= 2.0 * gap / np.pi * np.cos(turn)
    assert force[2] == pytest.approx(80.0 * closed, rel=1e-5)


def test_preload_is_the_force_at_rest() -> None:
    law = UnilateralSpring(80.0, preload=3.0, exponent=1.5)

    force, _ = cycled(law, 0.0)

    assert force[0] == pytest.approx(3.0, rel=1e-12)


def test_dampers_dissipate_what_their_closed_forms_say() -> None:
    speed = FREQUENCY * 0.3

    _, linear = cycled(LinearDamper(0.4), 0.3)
    _, quadratic = cycled(QuadraticDamper(0.4), 0.3)

    assert linear.normal_damping == pytest.approx(np.pi * 0.4 * 0.3 * speed, rel=1e-12)
    closed = 8.0 / 3.0 * 0.4 * 0.3 * speed**2
    assert quadratic.normal_damping == pytest.approx(closed, rel=1e-6)


def test_area_contact_has_a_twelfth_of_its_width_squared_in_rotation() -> None:
    law = AreaContact(9.0, 0.2, 0.4)

    rows = law.rows({"normal": 1, "rotations": 2})

    stiffness = [row.point.stiffness for row in rows]
    assert stiffness == pytest.approx([9.0, 9.0 * 0.04 / 12, 9.0 * 0.16 / 12])
    assert [row.normal for row in rows] == [
        ("normal", 0), ("rotations", 0), ("rotations", 1)
    ]  # fmt: skip


def backbone(motion: float) -> float:
    """Return Segalman's force on first loading [N]."""
    chi, least = IWAN.chi, min(motion, IWAN.largest_slip)
    below = IWAN.density * least ** (chi + 2.0) / (chi + 2.0)
    above = IWAN.stiffness - IWAN.density * least ** (chi + 1.0) / (chi + 1.0)
    return float(below + above * least)


def loss(amplitude: float) -> float:
    """Return Segalman's dissipation in a cycle of microslip [J]."""
    chi = IWAN.chi
    power = IWAN.density * amplitude ** (chi + 3.0)
    return float(4.0 * power / ((chi + 2.0) * (chi + 3.0)))


def first_loading(motion: float) -> float:
    stiffness, slip = IWAN.spectrum
    return float((stiffness * np.minimum(slip, motion)).sum())


def test_iwan_has_its_stiffness_and_its_slip_force() -> None:
    stiffness, slip = IWAN.spectrum

    assert stiffness.sum() == pytest.approx(IWAN.stiffness, rel=1e-12)
    assert (stiffness * slip).sum() == pytest.approx(IWAN.slip_force, rel=1e-12)
    assert backbone(2.0 * IWAN.largest_slip) == pytest.approx(
        IWAN.slip_force, rel=1e-12
    )


def test_iwan_is_exact_at_its_edges_and_within_its_stated_error_between() -> None:
    for edge in IWAN.edges[1:]:
        assert first_loading(edge) == pytest.approx(backbone(edge))
    motions = np.linspace(0.0, 1.2 * IWAN.largest_slip, 5001)[1:]
    away = [first_loading(each) - backbone(each) for each in motions]
    largest = max(away) / IWAN.slip_force

    assert min(away) > -1e-12 * IWAN.slip_force
    assert largest == pytest.approx(IWAN.backbone_error, rel=0.02)
    assert largest < 3e-3


def test_error_of_iwans_backbone_falls_with_the_square_of_the_sliders() -> None:
    errors = [Iwan(10.0, 2e6, -0.6, 0.2, sliders=n).backbone_error for n in (20, 40)]

    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)


@pytest.mark.parametrize("share", [0.02, 0.1, 0.5, 0.99])
def test_iwan_dissipates_microslips_power_law(share: float) -> None:
    amplitude = share * IWAN.largest_slip

    _, cycle = cycled(IWAN, amplitude)

    assert cycle.friction == pytest.approx(loss(amplitude), rel=0.02)


@pytest.mark.parametrize("share", [0.005, 0.3, 1.0, 3.0])
@pytest.mark.parametrize("beta", [0.0, 2.0])
def test_iwan_tells_how_far_the_energy_of_a_cycle_is_off(
    share: float, beta: float
) -> None:
    law = Iwan(10.0, 2e6, -0.5, beta, smallest=1e-3)
    amplitude = share * law.largest_slip

    _, cycle = cycled(law, amplitude, samples=2**15)

    def lost(slip: float) -> float:
        return float(4.0 * law.density * slip ** (law.chi + 1.0) * (amplitude - slip))

    most = min(amplitude, law.largest_slip)
    exact, _ = scipy.integrate.quad(lost, 0.0, most, epsrel=1e-10)
    last = law.stiffness * beta / (1.0 + beta) * law.largest_slip
    exact += 4.0 * last * max(amplitude - law.largest_slip, 0.0)
    away = cycle.friction / exact - 1.0
    assert law.energy_error(amplitude) == pytest.approx(away, abs=1e-3)


def test_error_of_iwans_energy_falls_with_the_square_of_the_sliders() -> None:
    errors = []
    for sliders in (20, 40, 80):
        law = Iwan(10.0, 2e6, -0.5, 0.0, sliders=sliders)
        shares = np.linspace(0.5, 1.0, 500) * law.largest_slip
        errors.append(max(abs(law.energy_error(float(each))) for each in shares))

    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.15)
    assert errors[0] == pytest.approx(0.02, rel=0.02)  # as the law's help says


def test_iwan_in_macroslip_adds_the_rigid_loop() -> None:
    amplitude = 20.0 * IWAN.largest_slip
    stiffness, slip = IWAN.spectrum

    _, cycle = cycled(IWAN, amplitude, samples=2**15)

    closed = 4.0 * float((stiffness * slip * (amplitude - slip)).sum())
    assert cycle.friction == pytest.approx(closed, rel=1e-3)


def test_jenkins_dissipates_its_parallelogram() -> None:
    _, cycle = cycled(Jenkins(50.0, 0.5), 0.03)

    assert cycle.friction == pytest.approx(4.0 * 0.5 * (0.03 - 0.01), rel=1e-4)
