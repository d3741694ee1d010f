"""What a march says of its energies."""

from dataclasses import replace

from microslip.commands.sweep_tables import energy_table
from microslip_mechanics.results.time_history import TimeHistory


def test_an_energy_that_rounding_makes_is_none(small_history: TimeHistory) -> None:
    energy = small_history.energy.copy()
    energy[-1, small_history.energies.index("normal_damping")] = -1.8e-20

    lines = energy_table(replace(small_history, energy=energy)).splitlines()

    (damping,) = [line for line in lines if "damping" in line and "normal" in line]
    assert damping.split()[-1] == "0"
    (friction,) = [line for line in lines if "friction" in line]
    assert float(friction.split()[-1]) > 0.0
