"""Contacts that damping lets go of before their faces part."""

import numpy as np
import pytest

from contact_tables import linear_contact
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.forces.release import released
from microslip_mechanics.contact.points import ContactPoints

pytestmark = pytest.mark.kernels

FREQUENCY, STIFFNESS, DAMPING = 11.0, 3.0, 0.1


def stop(damping: float = DAMPING) -> ContactPoints:
    """Return a spring beside a dashpot of faces that do not stick together."""
    return linear_contact(STIFFNESS, damping, clamped=True)


def moved(before: tuple[float, float], behind: tuple[float, float]) -> float:
    """Return the share at which it lets go between two depths and speeds."""
    displacement, velocity = np.zeros((3, 2)), np.zeros((3, 2))
    displacement[0], velocity[0] = zip(before, behind, strict=True)
    return released(stop(), 0, displacement, velocity, 0, 1)


def test_it_lets_go_where_spring_and_dashpot_are_in_balance() -> None:
    # 3 (0.02 − 0.015 s) = 0.1 (0.4 + 0.2 s)
    assert moved((0.02, -0.4), (0.005, -0.6)) == pytest.approx(0.02 / 0.065)


def test_it_presses_again_before_it_has_opened() -> None:
    assert moved((0.005, -0.6), (0.02, -0.4)) == pytest.approx(1.0 - 0.02 / 0.065)


@pytest.mark.parametrize(
    ("before", "behind"),
    [
        ((0.02, 0.4), (0.03, 0.2)),  # presses
        ((0.005, -0.6), (-0.01, -0.6)),  # let go
        ((-0.01, 0.4), (0.01, 0.4)),  # touches
    ],
)
def test_what_presses_or_does_not_keeps_to_it(
    before: tuple[float, float], behind: tuple[float, float]
) -> None:
    assert moved(before, behind) == 0.0


def test_forces_do_not_leap_where_its_release_passes_a_sample() -> None:
    # it lets go c ω / k = 0.04 before the faces part, less than a sample
    fourier, motion = FourierBasis(3, 64), np.zeros((7, 3))
    contact = AlternatingFrequencyTime(stop(0.01), np.eye(3), fourier)
    motion[1:3, 0] = 0.02, 0.005
    forces = []
    for motion[0, 0] in np.linspace(-0.006, -0.003, 401):
        forces.append(contact(motion, FREQUENCY).copy())

    steps = np.abs(np.diff(forces, axis=0)).max(axis=(1, 2))
    assert steps.max() < 1.2 * np.median(steps)
