"""When the multipliers of an orbit as it is reported are known well enough."""

import numpy as np
import pytest

from hbm.fourier import FourierBasis
from hbm.multipliers import Multipliers
from hbm.options import CurveOptions
from hbm.solve import frequency_response, with_multipliers
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

HERTZ = 2.0 * np.pi


@pytest.fixture
def sought(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the harmonics of the finer orbits that are sought from now on."""
    harmonics: list[int] = []
    finer = Multipliers.finer

    def noted(self: Multipliers, point: Array, fourier: FourierBasis) -> Array | None:
        harmonics.append(fourier.harmonics)
        return finer(self, point, fourier)

    monkeypatch.setattr(Multipliers, "finer", noted)
    return harmonics


def test_rattling_contacts_whose_multipliers_are_known_need_no_finer_orbit(
    sought: list[int],
) -> None:
    problem = rig_problem(model="full")
    rest = static_equilibrium(problem)
    options = CurveOptions(HERTZ * 134.85, HERTZ * 135.0)

    first = next(frequency_response(problem, rest, options))
    assert sought == []

    # what knows of no coarser orbit seeks a finer one
    again = with_multipliers(problem, rest, first, options)
    assert max(sought) > first.harmonics
    np.testing.assert_allclose(
        np.abs(first.multipliers[:3]), np.abs(again.multipliers[:3]), atol=1e-4
    )


def test_rattling_contacts_whose_multipliers_change_still_need_one(
    sought: list[int],
) -> None:
    problem = rig_problem(model="full")
    options = CurveOptions(HERTZ * 135.1, HERTZ * 135.3)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    assert max(sought) > first.harmonics
