"""What is reported of a settled point: corrected, or as it was settled."""

import numpy as np
import pytest

from hbm.balance.refined import Refined
from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import Estimate
from hbm.resolution.report import Report
from systems import Dense

SETTLED, FINER = FourierBasis(7, 128), FourierBasis(15, 256)
POINT, CORRECTED = np.array([1.0, 2.0]), np.array([1.5, 2.0])
CHANGE, SHIFT, ASIDE = 0.5, 0.1, 0.02


def report(error: float, *, corrects: bool) -> Report:
    """Return the report of a point whose corrected one has an error."""
    rest, slope = np.zeros(1), Dense(np.eye(1, 2))
    made = Refined(rest, POINT, CORRECTED, 0.0, 0.0, rest, slope, CORRECTED)
    errors = CHANGE, error, 0.0, 0.0, SHIFT, ASIDE
    estimate = Estimate(*errors, FINER, made, CORRECTED, None, np.zeros((5, 1)))
    return Report(estimate, SETTLED, estimates=True, corrects=corrects, most=255)


def test_by_tolerance_a_point_is_corrected_and_has_what_that_errs() -> None:
    made = report(0.2, corrects=True)

    point, fourier, error = made.kept(POINT)

    assert point is CORRECTED
    assert fourier == FINER
    assert error == 0.2
    assert made.aside == ASIDE


@pytest.mark.parametrize(
    ("error", "corrects"), [(1.0, True), (4.5, True), (0.2, False)]
)
def test_a_correction_that_may_all_be_wrong_moves_no_point(
    error: float, *, corrects: bool
) -> None:
    made = report(error, corrects=corrects)

    point, fourier, told = made.kept(POINT)

    assert point is POINT
    assert fourier == SETTLED
    assert told == CHANGE + error
    assert made.aside == pytest.approx(SHIFT + ASIDE)
