"""The extremes of amplitudes against those of all pairs of residual tractions."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from hbm.continuation.arc import upright
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.curves.reached import GAIN
from hbm.curves.residual_range import FOURIER, ResidualRange
from hbm.curves.tracer import Tracer
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.solve import frequency_response
from lap_joint import lap_joint
from microslip import curve, scene
from microslip_mechanics.static import static_equilibrium


def test_no_pair_of_tractions_leads_farther() -> None:
    problem = scene("platform-damper", ["element.neighbour.mu=0.1"])
    frequency = 2.0 * np.pi * 278.0  # the wedge sticks to one platform at least
    rest, rows = static_equilibrium(problem), problem.probes.rows
    options = CurveOptions(frequency, 1.001 * frequency, harmonics=15, samples=256)
    path = along_frequency(problem, rest, options.start, options.end)
    tracer = Tracer(problem, path, options)
    tolerance = tracer.control.tolerance
    point = next(iter(tracer.pieces)).point
    balance, here = tracer.curve.resolution.at(FOURIER).at_frequency(point)
    springs = problem.interface.points.tangential

    low, high = ResidualRange(tracer.curve.resolution, rows, tolerance).at(point)[:, 0]

    amplitude = np.hypot(*(balance.motion(here)[1:3] @ rows.T))[0]
    shares = []
    for pair in itertools.product(np.linspace(-100.0, 100.0, 9), repeat=2):
        bent = np.zeros((2, 3))
        bent[:, 1] = np.array(pair) / springs
        other = balance.with_problem(replace(balance.problem, bent=bent))
        made = correct(other, here, upright(here), tolerance=tolerance)
        if made.outcome is Outcome.CONVERGED:
            size = np.hypot(*(other.motion(made.point)[1:3] @ rows.T))[0]
            shares.append(size / amplitude - 1.0)
    assert len(shares) > 40
    assert min(shares) < -0.02
    assert max(shares) > 0.05
    assert low < min(shares) + GAIN
    assert high > max(shares) - GAIN


def test_other_curves_at_the_same_frequency_are_no_extremes() -> None:
    # those between two folds are more than half an amplitude away
    problem = scene("chain")
    options = CurveOptions(
        2.0 * np.pi * 0.2455,
        2.0 * np.pi * 0.2612,
        harmonics=7,
        samples=256,
        errors=False,
        events=False,
        residual_range=True,
    )

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    ranges = [np.abs(each.residual_range).max(initial=0.0) for each in curve]
    unstable = [each.unstable > 0 for each in curve]
    assert any(unstable)
    assert max(ranges) < 0.3
    assert not np.any(np.array(ranges)[unstable])


def test_without_drive_tractions_change_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("hbm.structure.linear_curve.EVENLY", 4)  # points

    still = curve(lap_joint(4, bolts=2000.0, drive=0.0), 60.0, 61.0)

    assert still.ending == "complete"
    assert not still.amplitude.any()
    assert not still.amplitude_highest.any()
