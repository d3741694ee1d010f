"""Energy of normal damping of contacts that open, against a closed form."""

import numpy as np
import pytest

from contact_tables import contact_points
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis

pytestmark = pytest.mark.kernels

FREQUENCY, AMPLITUDE, DAMPING, STIFFNESS = 11.0, 0.02, 0.8, 3.0


def taken(samples: int, *, exponent: float, aside: float) -> float:
    """Return what damping takes out of A cos θ − A cos(aside), over a half circle's."""
    points = contact_points(
        friction=0,
        stiffness=STIFFNESS,
        exponent=1.0,
        damping=DAMPING,
        damping_exponent=exponent,
    )
    contact = AlternatingFrequencyTime(points, np.eye(3), FourierBasis(1, samples))
    motion = np.zeros((3, 3))
    motion[:2, 0] = -AMPLITUDE * np.cos(aside), AMPLITUDE
    cycle = contact.cycle(motion, FREQUENCY)
    return cycle.normal_damping / (DAMPING * FREQUENCY * AMPLITUDE**2)


@pytest.mark.parametrize("aside", [0.4, 1.0, 1.9])
def test_a_dashpot_between_faces_takes_out_what_its_arc_says(aside: float) -> None:
    # ∫ sin² θ over the arc in contact
    exact = aside - np.sin(2.0 * aside) / 2.0

    errors = [
        abs(taken(samples, exponent=0.0, aside=aside) / exact - 1.0)
        for samples in (64, 256, 1024)
    ]

    # samples alone, which do not see where the faces touch, err by 32, 8 and 1 %
    assert errors[0] < 3e-2  # measured 2.2e-2 for the shortest arc, of 8 samples
    assert errors[2] < errors[0] / 100.0


def test_damping_that_grows_as_a_root_is_seen_as_well() -> None:
    fine = taken(1 << 12, exponent=0.25, aside=1.0)

    assert taken(128, exponent=0.25, aside=1.0) == pytest.approx(
        fine, rel=5e-3
    )  # 3.4e-3
