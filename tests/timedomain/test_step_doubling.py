"""The error of a march, told by one with steps of twice the length beside."""

from dataclasses import replace

import numpy as np
import pytest

from microslip_mechanics.element import Element
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.loads.excitation import Dwell, SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import marched, oscillator
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.checkpoint import at_end
from timedomain.record.start import Start
from timedomain.step_doubling import CAUTION

SWEEP = SweptSine(0.0, 0.0, 2.0, 2.0, 3.0, 8.0)
STIFF, SOFT = (
    Element(
        RegularisedCoulomb(load=1.0, mu=mu, threshold_velocity=velocity),
        tangents=[("x1", "ground")],
    )
    for mu, velocity in ((0.8, 1e-4), (0.3, 1e-2))
)
SLIDER = Element(Jenkins(limit=0.3, stiffness=500.0), between=("x1", "ground"))


def rubbing(element: Element, preload: float = 0.0) -> Problem:
    """Return a mass on a spring and a friction contact, and one that is pressed."""
    return system(
        mass=[1.0, 1.0],
        stiffness=np.diag([1000.0, 1e4]),
        damping=np.diag([0.632, 20.0]),
        elements=[element],
        drive={"x1": 1.0},
        preload={"x2": preload},
    )


def swing(moved: np.ndarray) -> float:
    """Return half of the way between a probe's extremes."""
    return float(np.ptp(moved, axis=0).max() / 2.0)


@pytest.mark.parametrize(
    "element",
    [
        STIFF,
        SOFT,
        SLIDER,
        Element(RigidCoulomb(load=1.0, mu=0.3), tangents=[("x1", "ground")]),
    ],
    ids=["stiff", "soft", "slider", "rigid"],
)
def test_the_estimates_cover_what_a_finer_march_shows(element: Element) -> None:
    problem, fine = rubbing(element), 2e-5
    true = marched(problem, SWEEP, MarchOptions(fine, 50))
    exact, moved = true.of("friction")[-1], swing(true.displacement)

    for step in (1e-3, 5e-4):
        told = marched(problem, SWEEP, MarchOptions(step, 1, estimate=True))

        energy, rows = told.of("friction")[-1], round(1e-3 / step)
        # the curvature of forces told a sixtieth of the stiff contact's error
        assert abs(energy - exact) <= told.energy_error[-1] < 0.04 * energy
        assert (np.diff(told.energy_error) >= 0.0).all()  # from block to block, too
        peak = swing(told.displacement[rows - 1 :: rows]) / moved
        assert abs(peak - 1.0) <= told.peak_error[-1] < 0.04


def test_a_linear_decay_has_the_error_of_its_closed_form_and_order() -> None:
    problem = oscillator(drive=0.0)
    structure = problem.structure.dense
    omega = float(np.sqrt(structure.stiffness[0, 0] / structure.mass[0, 0]))
    decay = float(structure.damping[0, 0] / structure.mass[0, 0]) / 2.0
    damped, period = np.sqrt(omega**2 - decay**2), 2.0 * np.pi / omega

    for steps in (200, 400):
        options = MarchOptions(period / steps, 2, method="reference", estimate=True)
        start = Start(np.ones(1), np.zeros(1))
        told = marched(problem, Dwell(1.0, 4.0 * period), options, start=start)
        phase = damped * told.time
        exact = np.cos(phase) + decay / damped * np.sin(phase)
        exact *= np.exp(-decay * told.time)
        least = told.displacement.min() - exact.min()
        missed = abs(least) / (1.0 - exact.min())
        # of second order: twice the step has four times the error; 2 % and 3 % off, as
        # rows do not fall on the extreme
        assert told.peak_error[-1] == pytest.approx(CAUTION * 3.0 * missed, rel=0.05)


def bouncing(omega: float) -> tuple[Problem, Dwell]:
    """Return a mass on a soft spring that bounces on a stop, from where it touches."""
    stop = Element(UnilateralSpring(stiffness=1e4), between=("x1", "ground"))
    problem = system(
        mass=[1.0],
        stiffness=[[1.0]],
        damping_ratio=0.01,
        elements=[stop],
        drive={"x1": 1.0},
    )
    return problem, Dwell(omega, 60.0)


@pytest.mark.long
@pytest.mark.parametrize("omega", [2.8, 3.0])
def test_where_motions_part_a_tolerance_tells_more_than_its_steps_do(
    omega: float,
) -> None:
    problem, dwell = bouncing(omega)
    known = marched(problem, dwell, MarchOptions(0.1, 1, 1e-6, estimate=True))
    assert known.peak_error[-1] > 1e-2  # nobody knows it better, with any steps

    for tolerance in (1e-2, 1e-3):
        options = MarchOptions(0.1, 1, tolerance)
        told = marched(problem, dwell, replace(options, estimate=True))

        away = abs(swing(told.displacement) / swing(known.displacement) - 1.0)
        assert away <= told.peak_error[-1] + known.peak_error[-1]
        alone = marched(problem, dwell, options)
        np.testing.assert_array_equal(alone.displacement, told.displacement)
        assert alone.peak_error[-1] < 0.3 * told.peak_error[-1]


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_a_regular_motion_is_told_about_its_tolerance(tolerance: float) -> None:
    options = MarchOptions(1e-2, 1, tolerance, estimate=True)
    exact = marched(rubbing(SOFT), SWEEP, MarchOptions(1e-2, 1, 1e-8))

    told = marched(rubbing(SOFT), SWEEP, options)

    away = abs(swing(told.displacement) / swing(exact.displacement) - 1.0)
    assert away <= told.peak_error[-1] <= 3.0 * tolerance
    energy = exact.of("friction")[-1]
    assert abs(told.of("friction")[-1] - energy) <= told.energy_error[-1]


@pytest.mark.parametrize("tolerance", [1e-2, None])
def test_without_friction_its_energy_has_no_error(tolerance: float | None) -> None:
    problem, _ = bouncing(0.7)
    options = MarchOptions(1e-2, 1, tolerance, estimate=True)

    told = marched(problem, Dwell(0.7, 9.0), options)

    assert not told.of("friction").any()
    assert told.energy_error.size == told.time.size
    assert not told.energy_error.any()
    assert told.peak_error[-1] > 0.0  # the stop does err


@pytest.mark.parametrize(
    "options",
    [
        MarchOptions(5e-5, 1),
        MarchOptions(5e-5, 2),
        MarchOptions(5e-5, 1, method="reference"),
        MarchOptions(5e-5, 2, method="reference"),
        MarchOptions(5e-5, 1, 1e-3),
    ],
    ids=["odd", "even", "reference, odd", "reference, even", "tolerance"],
)
def test_a_march_with_estimates_goes_on_as_if_it_had_never_stopped(
    options: MarchOptions,
) -> None:
    problem = rig_problem(model="B")
    sweep = SweptSine(0.005, 0.01, 0.04, 0.05, 125.0, 145.0)
    options = replace(options, estimate=True)
    blocks = list(integrate(problem, sweep, options, block=0.01))

    after = integrate(problem, sweep, options, start=blocks[1].checkpoint, block=0.01)

    part, expected = joined(list(after), "complete"), joined(blocks[2:], "complete")
    for name in ("time", "displacement", "energy", "energy_error", "peak_error"):
        np.testing.assert_array_equal(getattr(part, name), getattr(expected, name))
    assert len(expected.time) % 2 == 0


@pytest.mark.parametrize("tolerance", [None, 1e-3])
def test_a_march_without_estimates_does_not_go_on_with_them(
    tolerance: float | None,
) -> None:
    dwell = Dwell(3.0, 1.0)
    options = MarchOptions(0.01, tolerance=tolerance)
    block = next(integrate(oscillator(), dwell, options))
    told = replace(options, estimate=True)

    with pytest.raises(ValueError, match="cannot go on"):
        next(integrate(oscillator(), dwell, told, start=block.checkpoint))


def test_the_motion_is_that_of_a_march_without_estimates() -> None:
    problem = rubbing(SLIDER)
    options = MarchOptions(1e-3, 2)

    alone = marched(problem, SWEEP, options)
    told = marched(problem, SWEEP, replace(options, estimate=True))

    np.testing.assert_array_equal(alone.displacement, told.displacement)
    assert alone.energy_error.size == 0
    assert told.checkpoint is not None
    assert alone.checkpoint is not None
    begin, same = (at_end(problem, end) for end in (told.checkpoint, alone.checkpoint))
    assert begin.traction is not None
    assert np.any(begin.traction)
    np.testing.assert_array_equal(begin.traction, same.traction)


@pytest.mark.parametrize("preload", [0.0, 1e5])
def test_what_a_growing_preload_moved_hides_no_error(preload: float) -> None:
    # the pressed mass swings by metres while its load grows, and is still at 2 s
    sweep = SweptSine(0.1, 2.0, 4.0, 4.0, 3.0, 8.0)
    options = MarchOptions(1e-3, 1, method="reference", estimate=True)

    told = marched(rubbing(SOFT, preload), sweep, options)
    alone = marched(rubbing(SOFT), sweep, options)

    # 10 m of rest beside 10 mm of motion
    assert told.peak_error[-1] == pytest.approx(alone.peak_error[-1], rel=0.1)
