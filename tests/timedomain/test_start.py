"""Where a march begins: at rest under what loads the structure by then."""

import numpy as np
import pytest

from microslip_mechanics.element import Element
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import marched
from timedomain.integrate import MarchOptions
from timedomain.record.start import loaded

QUIET = {"start": 1.0, "end": 2.0, "duration": 2.0, "lowest": 3.0, "highest": 4.0}


def pressed(pull: float) -> Problem:
    """Return a mass on a spring that a preloaded contact pushes, and a force pulls."""
    stop = HuntCrossleyContact(stiffness=1e5, damping=0.5, preload=20.0)
    return system(
        mass=[1.0],
        stiffness=[1e3],
        damping=[1.0],
        elements=[Element(stop, between=("x1", "ground"))],
        drive={"x1": 1.0},
        preload={"x1": pull},
    )


@pytest.mark.parametrize(("ramp", "grown"), [(0.0, 1.0), (0.5, 0.0)])
def test_a_march_begins_where_its_loads_balance(ramp: float, grown: float) -> None:
    problem, sweep = pressed(4.0), SweptSine(ramp, **QUIET)

    begin = loaded(problem, sweep)
    still = marched(problem, sweep, MarchOptions(1e-3, 1), start=begin)

    # k x + F(x) = the pull that is there by then: what neither spring nor pull holds
    # the contact does
    force = still.normal_force[0, 0]
    assert 1e3 * begin.displacement[0] + force == pytest.approx(4.0 * grown, abs=1e-4)
    before = still.time < (QUIET["start"] if ramp == 0.0 else 1e-2)
    moved = np.abs(still.displacement[before, 0] - begin.displacement[0])
    # the blow from zero displacement moved it by twice as much as it rests aside
    assert moved.max() < (1e-9 if ramp == 0.0 else 2e-2) * abs(begin.displacement[0])


def test_a_march_of_the_rig_begins_where_nothing_has_moved() -> None:
    begin = loaded(rig_problem(), SweptSine(0.5, **QUIET))

    assert not begin.displacement.any()
    assert not begin.velocity.any()
