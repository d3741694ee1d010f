"""Free decay in time against the nonlinear mode that predicts it."""

import dataclasses

import numpy as np
import pytest
import scipy.integrate

from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import NonlinearMode, modes_in_range, nonlinear_mode
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import marched
from timedomain.integrate import MarchOptions
from timedomain.record.start import Start

STEPS, ROWS = 1600, 80


def branch(problem: Problem, harmonics: int) -> list[NonlinearMode]:
    """Return the mode, its points of growing amplitude at the end of it."""
    rest = static_equilibrium(problem)
    linear = modes_in_range(problem, rest, 800.0, 900.0)[0]
    options = ModeOptions(1e-4, 1e-2, harmonics=harmonics)
    points = list(nonlinear_mode(problem, rest, linear, options))
    sizes = np.array([abs(point.probes[0]) for point in points])
    first = int(np.flatnonzero(np.diff(sizes) <= 0.0).max(initial=-1)) + 1
    return points[first:]


def seen(history: Array, frequency: float, time: Array) -> tuple[complex, complex]:
    """Return the first harmonic over the first and over the last period."""
    waves = history * np.exp(-1j * frequency * time)
    return 2.0 * complex(waves[:ROWS].mean()), 2.0 * complex(waves[-ROWS:].mean())


@pytest.mark.long
@pytest.mark.parametrize(("wanted", "periods"), [(0.8e-3, 8), (2e-3, 30)])
def test_the_decay_of_a_sliding_rig_follows_its_mode(
    wanted: float, periods: int
) -> None:
    problem = rig_problem(model="A")
    points = branch(problem, 15)
    sizes = np.array([abs(point.probes[0]) for point in points])
    poles = np.array([point.pole for point in points])
    start = points[int(np.abs(sizes - wanted).argmin())]
    period = 2.0 * np.pi / start.pole.imag
    free = dataclasses.replace(problem, drive=np.zeros_like(problem.drive))

    history = marched(
        free,
        Dwell(start.pole.imag, periods * period),
        MarchOptions(period / STEPS, store_every=STEPS // ROWS),
        start=Start(*start.state(0.0)),
    )

    first, last = seen(history.displacement[:, 0], start.pole.imag, history.time)
    elapsed = (periods - 1) * period
    # the mode's slow flow: d log c / dt = s(|c|)
    flow = scipy.integrate.solve_ivp(
        lambda _, c: [
            np.interp(np.exp(c[0]), sizes, poles.real),
            np.interp(np.exp(c[0]), sizes, poles.imag) - start.pole.imag,
        ],
        (0.0, elapsed),
        [np.log(abs(first)), np.angle(first)],
        rtol=1e-8,
    )
    decrement = np.log(abs(last) / abs(first))
    assert decrement < -0.1
    assert flow.y[0, -1] - flow.y[0, 0] == pytest.approx(decrement, rel=0.02)
    turned = np.angle(last / first)
    assert flow.y[1, -1] - flow.y[1, 0] == pytest.approx(turned, abs=0.02)
