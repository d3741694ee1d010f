"""What comes in from beyond a range that begins or ends between two folds."""

from dataclasses import replace

import numpy as np
import pytest

from hbm.curves.parameter_curves import parameter_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import cubic_oscillator
from timedomain.shooting.comparison import compared

DAMPING, DRIVE, WITHIN = 0.2, 1.0, 2.0
"""the last between both folds [rad/s]"""
PROBLEM = cubic_oscillator(damping=DAMPING, drive=DRIVE)


def curve(start: float, end: float) -> list[PeriodicResponse]:
    options = CurveOptions(start, end, harmonics=1, samples=1024)
    rest = static_equilibrium(PROBLEM)
    return list(frequency_response(PROBLEM, rest, options))


def amplitudes(frequency: float) -> list[float]:
    """Return those that balance the drive with one harmonic, in rising order.

    Their squares A are the roots of A ((1 − ω² + ¾A)² + d²ω²) = F².
    """
    linear, damped = 1.0 - frequency**2, (DAMPING * frequency) ** 2
    roots = np.roots([9.0 / 16.0, 1.5 * linear, linear**2 + damped, -(DRIVE**2)])
    return [float(np.sqrt(each)) for each in sorted(roots.real)]


def amplitude(response: PeriodicResponse) -> float:
    return float(np.hypot(*response.coefficients[1:3, 0]))


def test_a_curve_that_arrives_loud_has_the_quiet_response_of_the_end_as_well() -> None:
    found = curve(0.5, WITHIN)

    ends = sorted(amplitude(each) for each in found if each.frequency == WITHIN)
    assert ends == pytest.approx(amplitudes(WITHIN), rel=1e-6)
    assert [each.event for each in found].count("restart") == 1
    quiet = next(each for each in found if each.event == "restart")
    assert amplitude(quiet) == min(ends, key=lambda each: abs(each - amplitude(quiet)))
    # it comes in from the end, folds, and leaves there as the unstable one
    behind = found[found.index(quiet) :]
    assert [each.event for each in behind].count("fold") == 1
    assert behind[-1].frequency == WITHIN
    assert behind[-1].unstable == 1


def test_where_both_meet_within_the_range_nothing_is_added() -> None:
    found = curve(0.5, 3.0)

    assert [each.event for each in found].count("fold") == 2
    assert "restart" not in [each.event for each in found]


def test_a_curve_that_begins_quiet_has_the_loud_response_of_the_start_as_well() -> None:
    found = curve(WITHIN, 4.0)

    starts = sorted(amplitude(each) for each in found if each.frequency == WITHIN)
    assert starts == pytest.approx(amplitudes(WITHIN), rel=1e-6)
    assert amplitude(found[0]) == min(starts)
    # what folds below the start comes in unstable, folds within, and leaves loud
    behind = found[[each.event for each in found].index("restart") :]
    assert [each.event for each in behind if each.event == "fold"] == ["fold"]
    assert behind[0].unstable == 1
    assert behind[-1].unstable == 0
    assert amplitude(behind[-1]) == max(starts)


def test_a_curve_that_leaves_unstable_is_looked_for_beyond_that_end_too() -> None:
    start, end = 1.65, 2.1  # folds are at 1.634 and 2.206

    found = curve(start, end)

    for place in start, end:
        ends = sorted(amplitude(each) for each in found if each.frequency == place)
        assert ends == pytest.approx(amplitudes(place), rel=1e-6)


def test_what_folds_farther_beyond_the_start_is_left_alone() -> None:
    found = curve(2.15, 2.6)

    assert "restart" not in [each.event for each in found]


def test_what_comes_in_at_a_sharp_fold_is_found_again_with_as_many_harmonics() -> None:
    problem = system(
        mass=[1.0],
        stiffness=[1000.0],
        damping_ratio=0.03,
        elements=[Element(UnilateralSpring(stiffness=1e3, gap=5e-4), ("x1", "ground"))],
        drive={"x1": 0.1},
    )
    start, end = 2.0 * np.pi * 5.5995, 2.0 * np.pi * 5.8
    rest = static_equilibrium(problem)

    found = frequency_response(problem, rest, CurveOptions(start, end))

    starts = [each for each in found if each.frequency == start]
    assert [each.unstable for each in starts] == [0, 1, 0]
    shot = [compared(problem, each) for each in starts]
    assert [each.as_estimated for each in shot] == [True] * 3
    assert max(each.difference for each in shot) < 2e-3


@pytest.mark.parametrize("end", [2.206, 2.21])  # the fold is at 2.2113
def test_a_range_is_left_where_the_curve_passes_its_end_first(end: float) -> None:
    options = CurveOptions(1.0, end)

    found = list(frequency_response(PROBLEM, static_equilibrium(PROBLEM), options))

    first = found[: [each.event for each in found].index("restart")]
    ends = sorted(amplitude(each) for each in found if each.frequency == end)
    assert [first[-1].frequency, first[-1].unstable] == [end, 0]
    assert amplitude(first[-1]) == ends[-1]
    assert len(ends) == 3
    # a peak beyond the end is none of the range
    assert all(1.0 <= each.frequency <= end for each in found)


def test_a_fold_that_more_harmonics_have_beyond_the_end_is_none_of_the_range() -> None:
    stop = UnilateralSpring(stiffness=2215.0, gap=5e-4)
    problem = system(
        mass=[1.0],
        stiffness=[1000.0],
        damping_ratio=0.00786,
        elements=[Element(stop, ("x1", "ground"))],
        drive={"x1": 0.377},
    )
    rest = static_equilibrium(problem)
    options = CurveOptions(6.0, 60.0, error=2e-3, stability=False)
    folds = [
        each.frequency
        for each in frequency_response(problem, rest, options)
        if each.event == "fold" and each.frequency < 20.0
    ]

    for end in (share * fold for fold in folds for share in (0.99999, 0.9999)):
        found = list(frequency_response(problem, rest, replace(options, end=end)))
        assert max(each.frequency for each in found) == end


def along_drive(
    start: float, end: float, *, possible: float = np.inf
) -> list[tuple[float, float, str]]:
    """Return drives, amplitudes at one frequency and events; up to a possible drive."""

    def driven(force: float) -> Problem:
        if force > possible:
            raise KeyError(force)
        return cubic_oscillator(damping=DAMPING, drive=force)

    options = CurveOptions(start, end, harmonics=1, samples=1024)
    found = parameter_response(driven, WITHIN, options)
    return [(each.parameter, amplitude(each), each.event) for each in found]


def balanced(drive: float) -> list[float]:
    """Return the amplitudes that balance a drive, as above."""
    linear, damped = 1.0 - WITHIN**2, (DAMPING * WITHIN) ** 2
    roots = np.roots([9.0 / 16.0, 1.5 * linear, linear**2 + damped, -(drive**2)])
    return sorted(float(np.sqrt(each.real)) for each in roots if abs(each.imag) < 1e-9)


# folds of the drive are at 0.798 and 2.356
@pytest.mark.parametrize(("start", "end"), [(0.2, 2.0), (2.2, 1.0), (1.0, 2.0)])
def test_drives_that_end_between_folds_have_all_responses(
    start: float, end: float
) -> None:
    found = along_drive(start, end)

    for place in (start, end):
        seen = sorted(size for drive, size, _ in found if drive == place)
        assert seen == pytest.approx(balanced(place), rel=1e-6)
    assert "restart" in [event for *_, event in found]


def test_where_there_are_no_problems_beyond_the_end_nothing_comes_back() -> None:
    found = along_drive(0.2, 2.0, possible=2.2)

    assert "restart" not in [event for *_, event in found]
    assert [size for drive, size, _ in found if drive == 2.0] == pytest.approx(
        balanced(2.0)[:1]
    )


SOFTENS, STIFFENS, LITTLE = 1.0, 1.0 / 0.6, 0.02
"""what of the square of the natural frequency goes with that of the amplitude and with
its fourth power, and drive and damping of the mass that has them"""


def softening() -> Problem:
    """Return a mass whose resonance bends to the left, then to the right."""
    spring = PolynomialSpring(
        coefficients={3.0: -SOFTENS / 0.75, 5.0: STIFFENS / 0.625}
    )
    return system(
        mass=[1.0],
        stiffness=[1.0],
        damping=[[LITTLE]],
        elements=[Element(spring, ("x1", "ground"))],
        drive={"x1": LITTLE},
    )


def bent(frequency: float) -> list[float]:
    """Return the amplitudes of that mass in one harmonic, in rising order.

    Their squares A are the roots of A ((1 − ω² − A + βA²)² + d²ω²) = F².
    """
    spring = np.poly1d([STIFFENS, -SOFTENS, 1.0 - frequency**2])
    square = np.poly1d([(LITTLE * frequency) ** 2])
    roots = (np.poly1d([1.0, 0.0]) * (spring**2 + square) - LITTLE**2).roots
    real = roots.real[(abs(roots.imag) < 1e-9) & (roots.real > 0.0)]
    return sorted(np.sqrt(real).tolist())


# folds are at 0.904 and 0.931, which the curve passes as it bends to the left, and at
# 0.938 and 1.122
@pytest.mark.parametrize(
    ("start", "end"), [(0.925, 1.05), (0.93, 1.05), (0.925, 1.0), (1.05, 0.925)]
)
def test_curves_that_return_from_both_ends_have_all_responses_there(
    start: float, end: float
) -> None:
    problem = softening()
    options = CurveOptions(start, end, harmonics=1, samples=1024, stability=False)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    for place in (start, end):
        seen = sorted(amplitude(each) for each in found if each.frequency == place)
        assert seen == pytest.approx(bent(place), rel=1e-6)
        assert len(seen) == 3
    # what comes in passes between both, and nothing else has to be sought there
    assert [each.event for each in found].count("restart") == 2
