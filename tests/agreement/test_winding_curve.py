"""A curve that winds where friction falls with speed: harmonic balance and shooting."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from timedomain.shooting.comparison import compared

TURN = 2.0 * np.pi


@pytest.mark.long
def test_a_winding_curve_is_whole_and_its_orbits_are_found_by_shooting() -> None:
    """Strong friction that falls with speed: the element jumps between its faces.

    Where the curve has its first folds, 127 harmonics and points that Newton's
    iteration nearly has lead past the fold that 255 have, and come to no further one.
    """
    problem = rig_problem(
        model="A",
        friction__law="gkf",
        friction__mu_dynamic=5.0,
        friction__mu_static=10.0,
        friction__threshold_velocity=1e-2,
        preload__force=1.0,
        excitation__force=100.0,
    )
    options = CurveOptions(TURN * 125.0, TURN * 128.5)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    begins = max(n for n, each in enumerate(found) if each.event == "restart")
    piece = found[begins:]
    folds = [n for n, each in enumerate(piece) if each.event == "fold"]
    assert found[begins].frequency < found[begins - 1].frequency
    assert piece[-1].frequency == TURN * 128.5
    assert len(folds) >= 2
    behind = [each for each in piece[folds[-1] :] if not each.event]
    for place in (128.15, 128.24, 128.4):
        response = min(behind, key=lambda each: abs(each.frequency / TURN - place))
        other = compared(problem, response)
        assert response.unstable
        assert other.as_estimated
        assert other.difference < 2e-4  # measured: 8e-6 to 6e-5
        assert other.as_stable
