"""The error of contacts that are marched from sample to sample, an accident by itself.

References have the same harmonics and thirty-two times the samples of a point.
"""

from dataclasses import replace

import numpy as np
import pytest

from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from memory_problems import CONTACTS, masses
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium

FREQUENCIES = np.linspace(5.0, 9.0, 41)
"""[rad/s], about the resonance of stuck and of sliding contacts"""
COARSE, FINEST = FourierBasis(7, 64), 4096


def errors(problem: Problem) -> tuple[Array, Array]:
    """Return estimated errors of points along a curve, and what marches err."""
    path = along_frequency(problem, static_equilibrium(problem), *FREQUENCIES[[0, -1]])
    made = PathResolution(path, problem.probes.rows, marched=True)
    solved = COARSE.coefficients * path.rank
    point = np.zeros(COARSE.doubled.coefficients * path.rank + 1)
    upright = np.append(np.zeros(point.size - 1), 1.0)
    estimated, true = [], []
    for point[-1] in FREQUENCIES:
        found = correct(made.at(COARSE), point, upright, tolerance=1e-10)
        assert found.outcome is Outcome.CONVERGED
        estimate = made.estimate(found, COARSE, upright)
        finest = made.at(replace(estimate.fourier, samples=FINEST))
        exact = correct(finest, estimate.corrected, upright, tolerance=1e-10)
        assert exact.outcome is Outcome.CONVERGED
        sizes = made.amplitudes((estimate.corrected, exact.point))
        estimated.append(estimate.error)
        true.append(np.abs(sizes[0] - sizes[1]).max() / sizes[1].max())
        point[:solved] = found.point[:solved]
    return np.array(estimated), np.array(true)


@pytest.mark.parametrize(("law", "seen", "drive"), CONTACTS)
def test_more_samples_tell_what_two_numbers_of_them_hide(
    law: PointLaw, seen: Array, drive: Array
) -> None:
    estimated, true = errors(masses(law, seen, drive))

    # Doubled samples alone bound 41 to 93 % of these.
    assert np.mean(true <= estimated + 1e-12) >= 0.9
    assert np.median(estimated / true) <= 10.0
