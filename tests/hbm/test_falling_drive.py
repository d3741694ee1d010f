"""A first point just above the slip limit: a drive that falls leads to it."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.comparison import compared

TURN = 2.0 * np.pi
STIFFNESS, LIMIT, HERTZ = 1e6, 50.0, 10.0
"""of the slider [N/m] and [N], and the frequency of the drive [Hz]"""


def slider(drive: float, spring: float = 1e4) -> Problem:
    """Return an undamped mass of 1 kg on a spring [N/m] and a slider, driven [N]."""
    return system(
        names=["x"],
        mass=[1.0],
        stiffness=[spring],
        elements=[Element(Jenkins(STIFFNESS, LIMIT), ("x", "ground"), name="s")],
        drive={"x": drive},
    )


@pytest.mark.parametrize("drive", [53.0, 54.0])
def test_a_slider_that_hardly_slips_without_damping_has_a_first_point(
    drive: float,
) -> None:
    # it rings as it sticks, at the 16th harmonic, which nothing damps
    problem = slider(drive)
    options = CurveOptions(TURN * HERTZ, TURN * 1.2 * HERTZ, events=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    assert first.frequency == TURN * HERTZ
    assert compared(problem, first).agrees
    work = TURN / 2.0 * drive * np.abs(first.coefficients[1, 0])  # of the drive [J]
    assert first.friction_energy == pytest.approx(work, rel=1e-2)
