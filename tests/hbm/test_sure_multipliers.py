"""When the multipliers of an orbit as it is reported are known well enough."""

from typing import cast

import numpy as np
import pytest

from hbm.fourier import FourierBasis
from hbm.multipliers import Multipliers
from hbm.resolution import PathResolution
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array, ComplexArray

COARSE, REPORTED = FourierBasis(7, 64), FourierBasis(15, 128)
LIFTS, STAYS = np.array([0.0, 0.0]), np.array([1.0, 1.0])


@pytest.fixture
def sought(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the harmonics of the finer orbits that are sought from now on.

    An orbit with H harmonics has the multiplier 1.1 + (its first component) / H².
    """
    harmonics: list[int] = []

    def finer(_: Multipliers, point: Array, fourier: FourierBasis) -> Array:
        harmonics.append(fourier.harmonics)
        return point

    def at(_: Multipliers, point: Array, fourier: FourierBasis) -> ComplexArray:
        return np.array([1.1 + point[0] / fourier.harmonics**2, 1.0, 0.9, 0.1 + 0j])

    monkeypatch.setattr(Multipliers, "finer", finer)
    monkeypatch.setattr(Multipliers, "at", at)
    return harmonics


def sure(
    change: float, lifts: Array, *, falls: bool, monkeypatch: pytest.MonkeyPatch
) -> tuple[ComplexArray, FourierBasis, bool]:
    """Return what is known where the leading multiplier is 1.1 + ``change`` / H²."""
    monkeypatch.setattr(Multipliers, "_falls", lambda *_: falls)
    multipliers = Multipliers(
        cast(PathResolution, None), None, cast(StepControl, None), fixed=False
    )
    point = np.array([change, 0.0, 1.0])
    return multipliers.sure(point, REPORTED, lifts, (point, COARSE))


@pytest.mark.parametrize(
    ("change", "lifts", "falls", "expected"),
    [
        (0.05, LIFTS, False, []),  # they differ by 8e-4
        (0.1, LIFTS, False, [31]),  # by 1.6e-3
        (5.0, LIFTS, False, [31, 63]),
        (0.05, STAYS, True, [31]),  # there the orbit itself is in doubt
        (5.0, STAYS, False, []),
    ],
)
def test_finer_orbits_are_sought_where_the_reported_one_says_too_little(
    change: float,
    lifts: Array,
    falls: bool,
    expected: list[int],
    sought: list[int],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    _, fourier, confirmed = sure(change, lifts, falls=falls, monkeypatch=monkeypatch)

    assert sought == expected
    assert fourier.harmonics == (expected[-1] if expected else REPORTED.harmonics)
    assert confirmed


def test_a_multiplier_that_one_resolution_lacks_asks_for_more(
    sought: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A slider that never slips with few harmonics, and does with more."""

    def at(_: Multipliers, __: Array, fourier: FourierBasis) -> ComplexArray:
        known = np.array([0.9, 0.8, 0.1 + 0j])
        return known if fourier.harmonics > REPORTED.harmonics else known[:2]

    monkeypatch.setattr(Multipliers, "at", at)

    known, _, _ = sure(0.0, STAYS, falls=True, monkeypatch=monkeypatch)

    assert known.size == 3
    assert sought == [31, 63]
