"""What few harmonics have beyond a fold is taken back where more have no such point."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.studies.gathered import gathered
from microslip_mechanics.element import Element
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.comparison import compared

HERTZ = 2.0 * np.pi
SPAN = (128.2, 128.7)
"""in which 63 harmonics have two folds, at 128.577 and 128.587 Hz, that 31 pass by"""


def clapping() -> Problem:
    """Return two masses with faces between them, which are hardly pressed."""
    faces = HuntCrossleyContact(
        stiffness=1.58e8,
        exponent=1.5,
        damping=5.24e8,
        damping_exponent=1.5,
        preload=0.108,
        clamped=True,
    )
    return system(
        names=["a", "b"],
        mass=[[0.034415, 0.00199], [0.00199, 0.042036]],
        stiffness=[[100123.26, -75485.85], [-75485.85, 103424.52]],
        damping=[[0.12707, -0.02146], [-0.02146, 0.07886]],
        elements=[Element(faces, ("a", "b"))],
        drive={"a": 1.2740137},
    )


def test_points_that_more_harmonics_do_not_have_are_taken_back() -> None:
    problem = clapping()
    start, end = (HERTZ * each for each in SPAN)
    options = CurveOptions(start, end, stability=False)

    traced = list(frequency_response(problem, static_equilibrium(problem), options))
    kept, ending = gathered(traced)

    motions = {id(each.coefficients) for each in kept}
    gone = [each for each in traced if id(each.coefficients) not in motions]
    assert ending == "complete"
    assert len(gone) == sum(each.replaces for each in traced) > 0
    # the last of what is gone lies beyond the fold, where no orbit is near
    with pytest.raises(ShootingError, match="does not bring end and beginning"):
        compared(problem, gone[-1])
    # what is kept, before and behind the fold and between both, shooting finds again
    fold = max(each.frequency for each in kept if each.event == "fold")
    near = [each for each in kept if 128.57 < each.frequency / HERTZ < 128.61]
    beside = [each for each in near if abs(each.frequency - fold) > HERTZ * 1e-4]
    shot = [compared(problem, each) for each in beside[::8]]
    assert len(shot) > 2
    assert [each.as_estimated for each in shot] == [True] * len(shot)
