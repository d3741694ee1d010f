"""The detached curve of a nonlinear absorber, to which a fold of the curve leads.

The system is the tuned absorber of a Duffing oscillator by Habib, Detroux, Viguié and
Kerschen (Mech. Syst. Signal Process. 52–53, 2015), whose resonance is doubled by a
detached curve that merges with it as the drive grows.
"""

import functools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hbm.curves.drive_search import MOST, Sought
from hbm.options import CurveOptions
from hbm.solve import detached, frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from timedomain.shooting.comparison import compared

CUBIC, ABSORBER, STIFFNESS, DAMPING = 1.0, 0.0042, 0.0454, 0.0128
MASS, RATIO = 1.0, 0.05
"""of the scene, once more for SciPy's equations"""
OPTIONS = CurveOptions(math.tau * 0.11, math.tau * 0.45)
PERIODS, ASIDE, LEFT = 300, 1.02, 0.05
"""of a march that begins aside of a motion, of which at most that part may be left"""


def absorber(drive: float) -> Problem:
    return problem_of(load_scene("nonlinear-absorber", [f"drive.host={drive}"]))


@functools.cache
def curve(drive: float) -> list[PeriodicResponse]:
    problem = absorber(drive)
    return list(frequency_response(problem, static_equilibrium(problem), OPTIONS))


@functools.cache
def beside(
    drive: float, effort: float = 1.0
) -> tuple[list[PeriodicResponse], list[Sought]]:
    """Return what is detached from the curve, and how it was sought from its folds."""
    problem = absorber(drive)
    rest, known = static_equilibrium(problem), curve(drive)
    found = list(detached(problem, rest, OPTIONS, known, frequencies=0, effort=effort))
    sought = [each for each in found if isinstance(each, Sought)]
    return [each for each in found if not isinstance(each, Sought)], sought


def folds(curve: list[PeriodicResponse]) -> list[float]:
    """Return where a curve folds [Hz]."""
    return sorted(each.frequency / math.tau for each in curve if each.event == "fold")


def marched(response: PeriodicResponse, drive: float, aside: float) -> Array:
    """Return the host's harmonic 1 long after a start beside a response, by SciPy."""
    frequency = response.frequency

    def rate(time: float, state: Array) -> Array:
        host, tuned, speed, other = state
        apart, parting = host - tuned, speed - other
        between = STIFFNESS * apart + ABSORBER * apart**3 + DAMPING * parting
        held = host + CUBIC * host**3 + 0.002 * speed
        pushed = drive * np.sin(frequency * time)
        return np.array(
            [speed, other, (pushed - held - between) / MASS, between / RATIO]
        )

    displacement, velocity = response.at(np.zeros(1))
    begun = aside * np.concatenate([displacement[0], velocity[0]])
    period, last = math.tau / frequency, np.arange(64) / 64
    ended = solve_ivp(
        *(rate, (0.0, (PERIODS + 1) * period), begun, "DOP853"),
        t_eval=(PERIODS + last) * period,
        rtol=1e-8,
        atol=1e-10,
    )
    angles = math.tau * last
    host: Array = 2.0 * np.array([np.cos(angles), np.sin(angles)]) @ ended.y[0] / 64
    return host


def test_a_fold_of_the_curve_leads_to_the_detached_one() -> None:
    other, sought = beside(0.17)

    assert [each.event for each in other].count("detached") == 1
    assert len(folds(curve(0.17))) == 4
    assert max(folds(curve(0.17))) < 0.22
    # it is closed: nothing of it lies beyond its folds
    hertz = [each.frequency / math.tau for each in other]
    assert folds(other) == pytest.approx([min(hertz), max(hertz)], rel=1e-6)
    assert min(hertz) > 0.24
    assert all(each.fold and not each.cause + each.lost for each in sought)
    assert len(sought) == 2 * 6
    assert sought[-1].done == 1.0


@pytest.mark.long
def test_it_grows_with_the_drive_until_it_merges() -> None:
    low, high = folds(beside(0.15)[0]), folds(beside(0.17)[0])

    assert len(low) == len(high) == 2
    assert high[0] < low[0] < low[1] < high[1] < max(folds(curve(0.19)))


def test_a_small_drive_has_no_detached_curve() -> None:
    other, sought = beside(0.11)

    assert other == []
    # both folds go on above, and meet in a cusp below
    assert [each.share for each in sought] == [MOST, 1.0, MOST, 1.0]


def test_a_search_without_the_effort_for_it_says_how_far_folds_were_followed() -> None:
    other, sought = beside(0.17, effort=0.02)

    assert other == []
    assert [each.share > 1.0 for each in sought] == [True, False] * 4
    assert all("10 evaluations, is spent" in each.cause for each in sought)


def test_scipy_keeps_its_stable_motions() -> None:
    stable = [each for each in beside(0.17)[0] if each.unstable == 0 and not each.event]
    left = [float(np.abs(each.multipliers).max()) ** PERIODS for each in stable]
    # at the tip of the curve even a motion that begins close by falls off it
    tip = 0.9 * max(each.frequency for each in stable)
    chosen = [
        each
        for each, part in zip(stable, left, strict=True)
        if part < LEFT and each.frequency < tip
    ]
    assert len(chosen) >= 6
    for response in chosen[:: len(chosen) // 3]:
        host = marched(response, 0.17, ASIDE)
        away = np.linalg.norm(host - response.coefficients[1:3, 0])
        assert away <= LEFT * (ASIDE - 1.0) * np.linalg.norm(host)


@pytest.mark.long
def test_shooting_finds_its_orbits_stable_or_not() -> None:
    problem = absorber(0.17)
    plain = [each for each in beside(0.17)[0] if not each.event][::6]

    assert {each.unstable > 0 for each in plain} == {True, False}
    for response in plain:
        made = compared(problem, response)
        assert made.agrees
        assert made.as_stable
