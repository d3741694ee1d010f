"""Extreme rigs: two independent methods within one per cent."""

import numpy as np
import pytest

from microslip_mechanics.loads.excitation import Dwell
from rigs import rig_problem
from small_problems import from_rest, marched
from timedomain.integrate import MarchOptions

FREQUENCY = 2.0 * np.pi * 137.0
EXTREMES: dict[str, dict[str, object]] = {
    "a tenth of sigma": {"contact__sigma": 3e-10},
    "no friction": {"friction__mu_dynamic": 0.0},
    "endless friction": {"model": "B", "friction__mu_dynamic": 1e3},
    "hardly any threshold": {"model": "B", "friction__threshold_velocity": 1e-8},
    "hardly any preload": {"preload__force": 1e-4},
    "a strong drive": {"excitation__force": 20.0},
    "no contact damping": {"contact__damping_ratio": 0.0},
}


@pytest.mark.parametrize("name", EXTREMES)
def test_two_methods_agree_within_one_per_cent(name: str) -> None:
    problem = rig_problem(**EXTREMES[name])
    start, dwell = from_rest(problem), Dwell(FREQUENCY, 0.02)

    fast = marched(
        problem, dwell, MarchOptions(5e-5, 1, tolerance=1e-4), start=start, block=1.0
    )
    reference = marched(
        problem,
        dwell,
        MarchOptions(1e-6, 50, method="reference"),
        start=start,
        block=1.0,
    )

    size = np.abs(reference.displacement).max()
    assert np.abs(fast.displacement - reference.displacement).max() < 0.01 * size
    for energy in ("friction", "normal_damping"):
        ends = fast.of(energy)[-1], reference.of(energy)[-1]
        floor = 1e-4 * reference.of("input").max()
        assert abs(ends[0] - ends[1]) < 0.01 * abs(ends[1]) + floor
