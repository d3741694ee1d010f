"""Curves where few harmonics fold early, so that their tangents mislead."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system

TURN = 2.0 * np.pi
FOLDS = (15.020673, 14.632303, 23.503856, 23.483958)
"""with 31 harmonics and 1024 samples throughout [Hz]"""


def clattering() -> Problem:
    """Return two masses whose lower branch folds 0.14 Hz too early with 3 harmonics."""
    return system(
        names=["x1", "x2"],
        mass=[1.0, 0.7],
        stiffness=[[20e3, -8e3], [-8e3, 11e3]],
        damping_ratio=0.01,
        elements=[
            Element(Jenkins(stiffness=5e3, limit=1.0), between=("x1", "ground")),
            Element(
                HuntCrossleyContact(
                    stiffness=2e6, exponent=1.5, damping=1e5, preload=2.0
                ),
                between=("x2", "x1"),
            ),
        ],
        preload={"x2": 1.0},
        drive={"x1": (0.5, np.radians(90.0)), "x2": (0.8, np.radians(-40.0))},
    )


@pytest.mark.parametrize("error", [1e-3, 3e-3])
def test_a_fold_of_few_harmonics_turns_no_curve_round(error: float) -> None:
    problem = clattering()
    options = CurveOptions(TURN * 12.0, TURN * 30.0, error=error, stability=False)
    curve = list(frequency_response(problem, static_equilibrium(problem), options))
    assert curve[-1].frequency == pytest.approx(TURN * 30.0)
    folds = [each.frequency / TURN for each in curve if each.event == "fold"]
    assert folds == pytest.approx(FOLDS, abs=2e-3)
    assert {each.event for each in curve} == {"", "fold", "peak"}
