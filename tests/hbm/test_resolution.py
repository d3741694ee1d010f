"""The error of a point, where steps at twice the order lead nowhere."""

import math

import numpy as np
import pytest

import hbm.resolution.resolution
from hbm.balance.refined import Refined
from hbm.continuation.newton import correct
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.static import static_equilibrium
from small_problems import oscillator

RANGE = (11.0, 13.0)


@pytest.mark.parametrize("probes", [np.zeros((1, 1)), np.ones((1, 1))])
def test_an_error_is_infinite_where_steps_lead_to_no_point_though_no_probe_moves(
    probes: np.ndarray, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = oscillator(preload=4.0)
    path = along_frequency(problem, static_equilibrium(problem), *RANGE)
    resolution, fourier = PathResolution(path, probes), FourierBasis(1, 32)
    point = np.append(np.zeros(7 * path.rank), RANGE[0])
    upright = np.append(np.zeros(point.size - 1), 1.0)
    found = correct(resolution.at(fourier), point, upright, tolerance=1e-12)

    refined = vars(hbm.resolution.resolution)["refined"]

    def lost(*given: object) -> Refined:
        made: Refined = refined(*given)
        return made._replace(left=math.inf)

    assert resolution.estimate(found, fourier, upright).error < 1e-9
    monkeypatch.setattr("hbm.resolution.resolution.refined", lost)
    assert resolution.estimate(found, fourier, upright).error == math.inf
