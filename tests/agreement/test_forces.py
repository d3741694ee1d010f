"""Forces given by their values against the exact response of a linear oscillator."""

import numpy as np
import pytest
import scipy.signal

from microslip_mechanics.loads.excitation import Dwell, LoadHistory
from microslip_mechanics.loads.force_record import ForceRecord
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.loads.sine_test import SineTest, Tone
from microslip_mechanics.system import system
from small_problems import marched, oscillator
from timedomain.integrate import MarchOptions
from timedomain.options import Method
from timedomain.record.start import Start

# 2 ü + 0.5 u̇ + 300 u = preload + 1.5 × drive
SYSTEM = ([1.5], [2.0, 0.5, 300.0])
DRAW = np.random.default_rng(4)
RECORD = ForceRecord(
    0.0, 0.2, np.arange(40) * 0.05, DRAW.normal(size=40), free=1.0, clock=2.0
)
TONES = SineTest(
    0.0, 0.1, (Tone(1.0, 3.0, 4.0, 1.0, "linear"), Tone(3.0, 1.0, 3.0, 2.0)), 1.0
)


@pytest.mark.parametrize("loads", [RECORD, TONES], ids=["record", "tones"])
def test_oscillator_under_any_load_moves_as_linear_theory_says(
    loads: LoadHistory,
) -> None:
    history = marched(oscillator(), loads, MarchOptions(1e-3, 1))

    time = np.concatenate([[0.0], history.time])
    drive = factors_over(loads.segments(), time)[:, 1]
    # exact for a drive with straight lines between the times
    _, exact, _ = scipy.signal.lsim(SYSTEM, drive, time, interp=True)
    size = np.abs(exact).max()
    # second order: (ωh)² of the fastest swing, grown over the march
    np.testing.assert_allclose(
        history.displacement[:, 0], exact[1:], rtol=0.0, atol=2e-3 * size
    )


@pytest.mark.parametrize("method", ["fast", "reference"])
def test_forces_of_different_phases_keep_the_march_on_the_exact_orbit(
    method: Method,
) -> None:
    mass, stiffness = np.diag([1.0, 2.0]), np.array([[40.0, -15.0], [-15.0, 30.0]])
    problem = system(
        mass=mass,
        damping=0.01 * stiffness,
        stiffness=stiffness,
        drive={"x1": 2.0, "x2": (1.0, 1.2)},
    )
    s, period = 4.0j, 2.0 * np.pi / 4.0
    force = np.array([2.0, np.exp(1.2j)])
    orbit = np.linalg.solve(s**2 * mass + (1.0 + 0.01 * s) * stiffness, force)

    history = marched(
        problem,
        Dwell(4.0, 3.0 * period),
        MarchOptions(period / 2000, 10, method=method),
        start=Start(orbit.imag, (s * orbit).imag),
    )

    exact = np.imag(np.exp(4.0j * history.time)[:, None] * orbit)
    assert np.abs(exact[:, 0] - exact[:, 1] * exact[0, 0] / exact[0, 1]).max() > 0.01
    np.testing.assert_allclose(
        history.displacement, exact, atol=2e-5 * np.abs(exact).max()
    )
