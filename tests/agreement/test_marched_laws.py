"""Each law of the catalogue: harmonic balance against time integration."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from law_examples import CASES, driven
from microslip_mechanics.static import static_equilibrium
from timedomain.verify import agreement, march_periods

FREQUENCIES = (6.5, 8.6)
"""below and near resonances [rad/s]"""
SLOW = ("iwan", "elastic, one tangent")
"""laws of which others are made, or that are made of others"""
SETTLED = 25
"""periods in which what begins on an orbit that is none leaves it"""


@pytest.mark.slow(seconds=90)  # the other worker finds its machine code
@pytest.mark.parametrize(
    "case",
    [pytest.param(case, marks=[pytest.mark.long] * (case in SLOW)) for case in CASES],
)
def test_amplitudes_agree_within_half_a_percent(case: str) -> None:
    problem = driven(case)
    options = CurveOptions(*FREQUENCIES, error=1e-3)
    found = list(frequency_response(problem, static_equilibrium(problem), options))

    for response in (found[0], found[-1]):
        blocks = list(
            march_periods(problem, response, periods=SETTLED, steps_per_period=400)
        )
        compared = agreement(problem, response, blocks)

        assert response.unstable <= 0
        assert np.all(compared.deviation < 5e-3), compared
