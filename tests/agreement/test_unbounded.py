"""Resonance without damping: friction bounds it up to 4 R / π (Den Hartog, 1931)."""

import numpy as np
import pytest

from hbm.errors import UnboundedError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system

LIMIT, RESONANCE = 0.3, 100.0
"""of the slider [N], and where its body would swing freely [rad/s]"""


def curve(drive: float) -> tuple[list[PeriodicResponse], str]:
    """Return the responses of an undamped body on a slider, and why they end."""
    slider = Element(Jenkins(stiffness=1e5, limit=LIMIT), between=("x", "ground"))
    problem = system(
        names=["x"],
        mass=[1.0],
        stiffness=[[RESONANCE**2]],
        elements=[slider],
        drive={"x": drive},
    )
    options = CurveOptions(0.9 * RESONANCE, 1.1 * RESONANCE, error=1e-2, events=False)
    found: list[PeriodicResponse] = []
    try:
        found.extend(frequency_response(problem, static_equilibrium(problem), options))
    except UnboundedError as error:
        return found, str(error)
    return found, "complete"


def test_friction_bounds_a_resonance_that_drives_less_than_it_takes() -> None:
    found, ending = curve(0.9 * 4.0 * LIMIT / np.pi)

    assert ending == "complete"
    largest = max(np.hypot(*each.coefficients[1:3, 0]) for each in found)
    assert largest < 1e-2


def test_a_resonance_that_drives_more_than_friction_takes_is_told() -> None:
    found, ending = curve(1.5 * 4.0 * LIMIT / np.pi)

    assert ending.startswith("the response is not bounded at 15.9154")
    assert "damping" in ending
    frequencies = np.array([each.frequency for each in found])
    assert frequencies.min() == pytest.approx(0.9 * RESONANCE)
    assert frequencies.max() == pytest.approx(1.1 * RESONANCE)
    below = frequencies[frequencies < RESONANCE]
    above = frequencies[frequencies > RESONANCE]
    assert above.min() - below.max() < 1e-4 * RESONANCE
