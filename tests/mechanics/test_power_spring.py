"""A spring of any power: its energy is the work of its force."""

import numpy as np
import pytest

from microslip_mechanics.contact.power_spring import (
    PowerSpring,
    power_energy,
    power_force,
)

pytestmark = pytest.mark.kernels


@pytest.mark.parametrize("exponent", [1.0, 2.0, 2.5, 3.0, 5.0])
def test_the_energy_of_a_power_spring_is_the_work_of_its_force(exponent: float) -> None:
    spring = PowerSpring(3e6, exponent, 0.0, 0.0)
    for reached in (-2e-3, 2e-3):
        places = np.linspace(0.0, reached, 20001)
        forces = [power_force(spring, float(place), 0.0)[0] for place in places]
        work = float(np.trapezoid(forces, places))
        assert power_energy(spring, reached) == pytest.approx(work, rel=1e-6)
    assert power_energy(PowerSpring(3e6, 2.0, 0.0, 0.0), -2e-3) == pytest.approx(-8e-3)
