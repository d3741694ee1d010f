"""Errors of a mode's points that have the most harmonics, where it winds."""

from collections.abc import Iterator

import numpy as np
import pytest

from hbm.continuation.arc import upright
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import Small, correct
from hbm.forces.fourier import FourierBasis
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import MOST, modes_in_range, nonlinear_mode
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.resolution.resolution import Resolution
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

FINER, SAMPLES = (127, 191, 255), 2048
"""harmonics by whose steps a finer point is sought"""


class Remembering(AdaptiveBalance):
    """One that remembers what was settled last, and in which plane."""

    latest: "Remembering"

    def __init__(self, resolution: Resolution, *given: object, **more: object) -> None:
        super().__init__(resolution, *given, **more)  # type: ignore[arg-type]
        self.resolution = resolution
        Remembering.latest = self

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
        *,
        share: float = 1.0,
        across: bool = False,
    ) -> Correction:
        self.normal = normal
        self.found = super().settle(
            correction, normal, tolerance, small, share=share, across=across
        )
        return self.found


def exhausted(largest: float) -> Iterator[tuple[float, Array, Array]]:
    """Yield told error, point and normal where model A's mode has the most harmonics.

    From some amplitude [m] on it is no longer followed.
    """
    problem = rig_problem(model="A")
    rest = static_equilibrium(problem)
    (linear,) = modes_in_range(problem, rest, 800.0, 900.0)
    for mode in nonlinear_mode(problem, rest, linear, ModeOptions(1e-5, largest)):
        system = Remembering.latest
        if system.settled.harmonics == MOST:
            point, *_ = system.report.kept(system.found.point)
            yield mode.damping_error, point, system.normal


def error(resolution: Resolution, point: Array, normal: Array) -> float:
    """Return that of the damping beside a finer point in a plane, if that is known."""
    room = (2 * FINER[-1] + 1) * resolution.rank + 1 - point.size
    finer, row = (
        np.concatenate([each[:-1], np.zeros(room), each[-1:]])
        for each in (point, normal)
    )
    for harmonics in FINER:
        balance = resolution.at(FourierBasis(harmonics, SAMPLES))
        found = correct(balance, finer, row, tolerance=1e-9, max_iterations=60)
        finer = found.point
    if found.outcome is not Outcome.CONVERGED:
        return np.inf
    (known,), (true,) = resolution.amplitudes((point, finer))[:, :1]
    return float(abs(true / known - 1.0))


def test_errors_with_the_most_harmonics_are_told_and_cover_the_true_ones(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("hbm.modes.modes.AdaptiveBalance", Remembering)

    told, true = [], []
    for place, (bound, point, normal) in enumerate(exhausted(4.5e-4)):
        told.append(bound)
        if place % 2 == 0:
            resolution = Remembering.latest.resolution
            known = error(resolution, point, upright(point))
            if known > bound:  # beside a fold
                known = min(known, error(resolution, point, normal))
            true.append(known)

    assert len(told) >= 30
    assert max(told) < 0.1
    ratios = np.array(told[::2]) / true
    assert np.mean(ratios >= 1.0) >= 0.95
    assert np.median(ratios) <= 10.0
