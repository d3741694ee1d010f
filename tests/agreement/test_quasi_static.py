"""Sweeps that slow down against the frequency response curve."""

import numpy as np
import pytest

from convergence import observed_order
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import marched
from timedomain.integrate import MarchOptions


@pytest.mark.long
@pytest.mark.slow
def test_slower_sweeps_dissipate_what_the_curve_predicts() -> None:
    problem = rig_problem(model="A")
    options = CurveOptions(2.0 * np.pi * 125.0, 2.0 * np.pi * 145.0)
    rest = static_equilibrium(problem)
    curve = list(frequency_response(problem, rest, options))
    hertz = np.array([each.frequency for each in curve]) / (2.0 * np.pi)
    rate = np.log(145.0 / 125.0) / 6.0
    # f cycles per second, each taking E, while df = k f dt: ∫ E df / k.
    taken = np.array([each.friction_energy for each in curve])
    predicted = np.trapezoid(taken, hertz) / rate

    slower, errors = [1.0, 2.0, 4.0, 8.0], []
    for factor in slower:
        end = 2.0 + 6.0 * factor
        sweep = SweptSine(1.0, 2.0, end, end, 125.0, 145.0)
        history = marched(problem, sweep, MarchOptions(5e-5), block=1.0)
        errors.append(history.of("friction")[-1] / factor / predicted - 1.0)

    # Measured 46 %, 26 %, 13 %, 7 % more: the transients' share falls with duration.
    assert np.all(np.diff(errors) < 0.0)
    order = observed_order([1.0 / factor for factor in slower], errors)
    assert order == pytest.approx(0.9, abs=0.2)
    assert 0.0 < errors[-1] < 0.1
