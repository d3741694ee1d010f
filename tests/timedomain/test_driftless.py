"""Marches of structures that nothing clamps: they stay where they are."""

import numpy as np
import pytest

from free_structures import DRIVE, MASSES, chain
from microslip.scenes.experiments import March
from microslip.studies.decay import measured, released
from microslip.studies.dwell import amplitudes, dwelling
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell, LoadHistory, SweptSine
from microslip_mechanics.loads.sine_test import SineTest, Tone
from microslip_mechanics.results.joined import joined
from rigs import rig_problem
from small_problems import marched
from timedomain.integrate import MarchOptions
from timedomain.record.driftless import driftless
from timedomain.record.start import loaded

PUSH, WHOLE = sum(DRIVE.values()), sum(MASSES)
HERTZ = 6.0
OMEGA = 2.0 * np.pi * HERTZ


def centre(displacement: Array) -> Array:
    """Return where the centre of mass of a chain is, shape (times,)."""
    middle: Array = displacement @ np.array(MASSES) / WHOLE
    return middle


def test_a_sine_alone_moves_it_to_and_fro() -> None:
    velocity = driftless(chain(), Dwell(OMEGA, 1.0 / HERTZ))

    # the integral of sin ωt has the mean 1/ω
    np.testing.assert_allclose(velocity, -PUSH / (WHOLE * OMEGA), rtol=1e-8)


@pytest.mark.parametrize(
    "history",
    [
        SweptSine(0.0, 0.5, 4.5, 5.0, 5.0, 8.0),
        SweptSine(0.5, 0.5, 4.5, 4.5, 8.0, 5.0),
        SineTest(0.0, 0.25, (Tone(6.0, 6.0, 2.0, 1.0), Tone(6.0, 7.0, 2.0, 0.5)), 0.5),
    ],
)
def test_a_sweep_does_not_drift_while_it_is_driven(history: LoadHistory) -> None:
    problem = chain()

    swept = marched(
        problem, history, MarchOptions(5e-4, 1), start=loaded(problem, history)
    )

    # at rest, the centre would have gone 5 m/s² / ω times the time: some 0.1 m
    driven = (swept.time >= 0.5) & (swept.time <= 4.25)
    gone = centre(swept.displacement)[driven]
    drift = np.polyfit(swept.time[driven], gone, 1)[0]
    assert abs(drift) < 0.1 * PUSH / (WHOLE * OMEGA)


def test_a_dwell_becomes_steady_and_is_the_response_of_the_matrices() -> None:
    problem = chain(slider=False)
    march = March(1.0 / HERTZ / 400.0 * 1.0001, 10)

    periods = list(dwelling(problem, OMEGA, march, tolerance=1e-4, most=2000))

    structure, force = problem.structure, problem.drive
    dynamic = (
        structure.stiffness + 1j * OMEGA * structure.damping - OMEGA**2 * structure.mass
    )
    exact = np.abs(np.linalg.solve(dynamic, force))
    found = amplitudes(joined([each.history for each in periods], "complete"), OMEGA)
    assert periods[-1].distance <= 1e-4
    np.testing.assert_allclose(found, exact, atol=3e-4 * exact.max())


def test_where_it_is_does_not_matter_to_a_dwell() -> None:
    # steps of 1/60 of a period leave some drift
    march = March(1.0 / HERTZ / 60.0 * 1.0001, 10)

    *_, last = dwelling(chain(), OMEGA, march, tolerance=1e-6, most=200)

    assert last.distance <= 1e-6


def test_what_is_let_go_decays_where_it_is() -> None:
    problem = chain(slider=False)
    march = March(1.0 / HERTZ / 200.0 * 1.0001, 1)
    *_, last = dwelling(problem, OMEGA, march, tolerance=1e-3, most=500)
    end = last.history.checkpoint
    assert end is not None
    rows = released(problem, end, march, frequency=OMEGA, periods=40)
    found = measured(problem, joined(list(rows), "complete"), 0)

    # the slowest mode, which decays last, of the unclamped chain
    squares = np.linalg.eigvals(
        np.linalg.solve(problem.structure.mass, problem.structure.stiffness)
    ).real
    slowest = np.sqrt(np.sort(squares)[1])
    assert found.frequency[-1] == pytest.approx(slowest, rel=2e-3)


def test_what_is_held_begins_at_rest() -> None:
    sweep = SweptSine(0.0, 0.5, 4.5, 5.0, 5.0, 8.0)

    assert not driftless(rig_problem(rope=None), sweep).any()
    assert not driftless(chain(held=1e-3), sweep).any()
    # harmonic balance refuses what its stiffness drives away, a march shows it
    assert not driftless(chain(held=-0.1), sweep).any()
