"""When the multipliers of an orbit as it is reported are known well enough."""

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from contact_tables import FRICTION_LAWS
from hbm.continuation.step_control import StepControl
from hbm.events.finer_orbits import FinerOrbits
from hbm.events.multipliers import Multipliers
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from hbm.stability.stability import small_motions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from small_problems import sliding_block

COARSE, REPORTED = FourierBasis(7, 64), FourierBasis(15, 128)
MANY = 12
"""coordinates: as many as those of the full rig"""
LIFTS, STAYS = np.array([0.0, 0.0]), np.array([1.0, 1.0])


@pytest.fixture
def sought(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return the harmonics of the finer orbits that are sought from now on.

    An orbit with H harmonics has the multiplier 1.1 + (its first component) / H².
    """
    harmonics: list[int] = []

    def finer(
        _: FinerOrbits, point: Array, fourier: FourierBasis, *__: object
    ) -> Array:
        harmonics.append(fourier.harmonics)
        return point

    def at(_: Multipliers, point: Array, fourier: FourierBasis) -> ComplexArray:
        return np.array([1.1 + point[0] / fourier.harmonics**2, 1.0, 0.9, 0.1 + 0j])

    monkeypatch.setattr(FinerOrbits, "finer", finer)
    monkeypatch.setattr(Multipliers, "at", at)
    return harmonics


def at_rank(rank: int, *, fixed: bool = False) -> Multipliers:
    """Return the multipliers of so many coordinates."""
    resolution = cast(PathResolution, SimpleNamespace(rank=rank))
    orbits = FinerOrbits(resolution, cast(StepControl, None))
    return Multipliers(resolution, None, orbits, fixed=fixed)


def sure(
    change: float,
    lifts: Array,
    *,
    falls: bool,
    monkeypatch: pytest.MonkeyPatch,
    rank: int = MANY,
) -> tuple[ComplexArray, FourierBasis, bool]:
    """Return what is known where the leading multiplier is 1.1 + ``change`` / H²."""
    monkeypatch.setattr(Multipliers, "_falls", lambda *_: falls)
    point = np.array([change, 0.0, 1.0])
    return at_rank(rank).sure(point, REPORTED, lifts, (point, COARSE))


@pytest.mark.parametrize(
    ("change", "lifts", "falls", "expected"),
    [
        (0.05, LIFTS, False, []),  # they differ by 8e-4
        (0.1, LIFTS, False, [31]),  # by 1.6e-3
        (5.0, LIFTS, False, [31, 63]),
        (0.05, STAYS, True, [31]),  # there the orbit itself is in doubt
        (5.0, STAYS, False, []),
        (5.0, np.array([0.0, 1.0]), False, [31, 63]),  # half of the points
        (5.0, np.array([0.0, 1.0, 1.0]), False, []),
        (5.0, np.empty(0), False, []),
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


@pytest.mark.parametrize(
    ("given", "fixed", "expected"), [(20, False, [41, 63]), (20, True, [])]
)
def test_harmonics_beside_the_given_ones_are_sought_up_to_a_number(
    given: int, fixed: bool, expected: list[int], sought: list[int]
) -> None:
    point, fourier = np.array([50.0, 0.0, 1.0]), FourierBasis(given, 128)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Multipliers, "_falls", lambda *_: False)
        at_rank(MANY, fixed=fixed).sure(point, fourier, LIFTS)

    assert sought == expected


@pytest.mark.parametrize(
    ("rank", "falls", "expected"),
    [
        (1, False, [31, 63, 127, 255, 511, 1023]),
        (2, False, [31, 63, 127, 255, 511]),
        (4, False, [31, 63, 127, 255]),
        (9, False, [31, 63]),
        (1, True, [31, 63]),
    ],
)
def test_few_coordinates_that_rattle_are_looked_at_with_many_harmonics(
    rank: int,
    falls: bool,
    expected: list[int],
    sought: list[int],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    known, fourier, _ = sure(
        1e5, LIFTS, falls=falls, monkeypatch=monkeypatch, rank=rank
    )

    assert sought == expected
    assert fourier.harmonics == expected[-1]
    assert known.size == 4  # stability is the same with the last two


@pytest.mark.parametrize(
    ("turned", "expected"), [(1e-4, []), (5e-4, [31]), (2e-3, [31, 63])]
)
def test_a_pair_that_turns_about_zero_is_not_known(
    turned: float,
    expected: list[int],
    sought: list[int],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A pair of a constant modulus, which it leaves once it is real."""

    def at(_: Multipliers, __: Array, fourier: FourierBasis) -> ComplexArray:
        angle = turned * fourier.harmonics
        return np.array([0.8 * np.exp(1j * angle), 0.8 * np.exp(-1j * angle)])

    monkeypatch.setattr(Multipliers, "at", at)

    sure(0.0, LIFTS, falls=False, monkeypatch=monkeypatch)

    assert sought == expected


@pytest.mark.parametrize(("apart", "known"), [(0.15, 0), (0.05, 2)])
def test_stability_that_turns_on_the_harmonics_is_not_known(
    apart: float, known: int, sought: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    def at(_: Multipliers, __: Array, fourier: FourierBasis) -> ComplexArray:
        leaves = fourier.harmonics in (15, 63)
        return np.array([1.0 + apart * (0.5 if leaves else -0.5), 0.1 + 0j])

    monkeypatch.setattr(Multipliers, "at", at)

    found, _, _ = sure(0.0, LIFTS, falls=False, monkeypatch=monkeypatch)

    assert sought == [31, 63]
    assert found.size == known


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


@pytest.mark.parametrize("falls", [True, False])
def test_an_orbit_that_no_finer_one_confirms_is_in_doubt_where_friction_falls(
    falls: bool, sought: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    def lost(_: Multipliers, __: Array, fourier: FourierBasis, *___: object) -> None:
        sought.append(fourier.harmonics)

    monkeypatch.setattr(FinerOrbits, "finer", lost)

    known, fourier, confirmed = sure(1.0, LIFTS, falls=falls, monkeypatch=monkeypatch)

    assert sought == [31, 63]  # none of them is found
    assert confirmed == (not falls)
    # the multipliers stay those of the orbit as it is
    assert fourier == REPORTED
    assert known[0] == 1.1 + 1.0 / REPORTED.harmonics**2


def test_one_orbit_that_is_found_at_last_confirms(
    sought: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    def late(
        _: FinerOrbits, point: Array, fourier: FourierBasis, *__: object
    ) -> Array | None:
        sought.append(fourier.harmonics)
        return point if fourier.harmonics == 63 else None

    monkeypatch.setattr(FinerOrbits, "finer", late)

    _, fourier, confirmed = sure(1.0, STAYS, falls=True, monkeypatch=monkeypatch)

    assert (sought, fourier.harmonics, confirmed) == ([31, 63], 63, True)


def of(problem: Problem) -> Multipliers:
    """Return the multipliers along the frequency of a problem with one coordinate."""
    path = along_frequency(problem, static_equilibrium(problem), 1.0, 2.0)
    resolution = PathResolution(path, np.ones((1, 1)))
    motions = small_motions(problem)
    orbits = FinerOrbits(resolution, StepControl())
    return Multipliers(resolution, lambda _: motions, orbits, fixed=False)


SPEED, SLOW, NEAR, FAST = 0.3, 0.1, 0.38, 0.5
"""of a block [m/s], and thresholds below, a little above and above"""


@pytest.mark.parametrize(
    ("law", "static", "threshold", "stribeck", "doubted"),
    [
        # friction rises up to the threshold, falls by 1/e within the Stribeck velocity
        ("gkf", 0.6, SLOW, SLOW, True),
        ("gkf", 0.6, SLOW, FAST, True),
        ("gkf", 0.6, FAST, SLOW, True),
        ("gkf", 0.6, NEAR, FAST, True),  # more harmonics may slide
        ("gkf", 0.6, FAST, FAST, False),
        ("gkf", 0.3, SLOW, SLOW, False),  # no static friction above the dynamic
        ("coulomb", 0.6, SLOW, SLOW, False),  # knows no static friction
    ],
)
def test_an_orbit_is_doubted_where_it_is_fast_enough_for_friction_to_fall(
    law: str,
    static: float,
    threshold: float,
    stribeck: float,
    doubted: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = sliding_block(
        stiffness=3.0,
        drive=1.0,
        friction=FRICTION_LAWS[law],
        dynamic=0.3,
        static=static,
        threshold=threshold,
        stribeck=stribeck,
        viscous=0.0,
        load=1.0,
    )
    monkeypatch.setattr(FinerOrbits, "finer", lambda *_: None)
    point = np.zeros(2 * COARSE.harmonics + 2)
    point[2], point[-1] = SPEED / 1.5, 1.5  # a sine of amplitude speed over frequency

    _, _, confirmed = of(problem).sure(point, COARSE, np.empty(0))

    assert confirmed != doubted
