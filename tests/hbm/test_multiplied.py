"""The matrix of a factor over a period, beside products at all samples."""

import numpy as np
import pytest

from hbm.forces.fourier import derivative, waves
from hbm.forces.multiplied import multiplied

pytestmark = pytest.mark.kernels


@pytest.mark.parametrize(("harmonics", "samples"), [(1, 6), (3, 40), (9, 512)])
def test_its_columns_are_products_with_each_term(harmonics: int, samples: int) -> None:
    now, rate = np.random.default_rng(harmonics).standard_normal((2, samples))
    value, analysis = waves(harmonics, samples)
    slope = -derivative(value)

    found = multiplied(now, rate, harmonics)

    expected = analysis @ (now * value + rate * slope).T
    np.testing.assert_allclose(found, expected, atol=1e-13)
