"""The march as a whole: divided steps, blocks, rows, options."""

import dataclasses
from collections.abc import Callable
from typing import Literal

import numpy as np
import pytest

from contact_tables import contact_points
from microslip_mechanics.element import Element
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.loads.excitation import Dwell, SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import NORMAL, from_rest, marched, mass_on_contact, oscillator
from timedomain.integrate import IntegrationError, MarchOptions, integrate
from timedomain.record.start import Start


@pytest.mark.parametrize("law", ["coulomb", "gkf"])
@pytest.mark.parametrize("model", ["A", "full"])
def test_a_step_takes_about_two_newton_iterations(model: str, law: str) -> None:
    problem = rig_problem(model=model, friction__law=law)

    history = marched(
        problem,
        Dwell(2.0 * np.pi * 135.0, 0.1),
        MarchOptions(method="reference"),
        start=from_rest(problem),
    )

    # Measured 1.0 to 2.0; with a tangent that is wrong by half more than thirty.
    assert history.iterations / 4000 < 2.5
    assert history.divided == 0


def test_steps_that_do_not_converge_are_divided() -> None:
    problem = rig_problem(friction__mu_dynamic=10.0, model="full")
    dwell, start = Dwell(2.0 * np.pi * 135.0, 0.1), from_rest(problem)

    options = MarchOptions(1e-3, method="reference")
    coarse = marched(problem, dwell, options, start=start)

    assert 0 < coarse.divided < 100
    assert np.isfinite(coarse.displacement).all()


def _hard_push() -> tuple[Problem, Start]:
    """Return the rig with much friction under twenty times its drive, at rest."""
    problem = rig_problem(friction__mu_dynamic=10.0, model="full")
    problem = dataclasses.replace(problem, drive=20.0 * problem.drive)
    return problem, from_rest(problem)


def _rigid_scratch() -> tuple[Problem, Start]:
    """Return a rigid point that scratches with more friction than load, sliding."""
    problem = system(
        mass=[1.0, 1.0],
        stiffness=[[800.0, 400.0], [400.0, 900.0]],
        names=("x", "n"),
        elements=[
            Element(
                RigidCoulomb(mu=10.0, normal_stiffness=1e3, preload=3.0),
                tangents=[("x", "ground")],
                normal=("n", "ground"),
            )
        ],
    )
    return problem, Start(np.array([-0.03, -0.01]), np.array([-2.0, -1.0]))


@pytest.mark.parametrize(
    ("case", "step", "parts"), [(_hard_push, 2e-3, 16), (_rigid_scratch, 0.3, 4)]
)
def test_a_divided_step_is_bit_for_bit_the_march_of_its_parts(
    case: Callable[[], tuple[Problem, Start]], step: float, parts: int
) -> None:
    # What failed, and parts before one that fails, must leave nothing behind.
    problem, start = case()
    dwell = Dwell(2.0 * np.pi * 135.0, step)

    def taken(step: float, parts: int, divisions: int) -> TimeHistory:
        options = MarchOptions(
            step, store_every=parts, divisions=divisions, method="reference"
        )
        return marched(problem, dwell, options, start=start, block=1.0)

    whole = taken(step, 1, 6)

    with pytest.raises(IntegrationError, match="even in"):
        taken(step, 1, parts.bit_length() - 2)
    assert whole.divided == 1
    expected = taken(step / parts, parts, 1)
    assert expected.divided == 0
    np.testing.assert_array_equal(whole.displacement, expected.displacement)
    np.testing.assert_array_equal(whole.energy, expected.energy)


def test_steps_under_a_tiny_threshold_keep_the_energy_balance_undivided() -> None:
    problem = rig_problem(friction__threshold_velocity=1e-8, model="B")
    dwell, start = Dwell(2.0 * np.pi * 135.0, 0.004), from_rest(problem)

    histories = [
        marched(problem, dwell, MarchOptions(step, method="reference"), start=start)
        for step in (2.5e-5, 1.25e-5)
    ]

    # of second order; one step accepted out of balance would show
    coarse, fine = (
        np.abs(each.closing_error).max() / each.of("input")[-1] for each in histories
    )
    assert [each.divided for each in histories] == [0, 0]
    assert fine == pytest.approx(coarse / 4.0, rel=0.05)
    assert coarse < 3e-4


def test_a_step_that_does_not_converge_in_any_parts_ends_the_march() -> None:
    problem = rig_problem(friction__mu_dynamic=10.0, model="full")
    options = MarchOptions(2e-3, divisions=1, method="reference")

    text = (
        r"^the step at t = 0\.0\d* s does not converge, even in 2 parts: "
        r"give a shorter time step, "
        r"a larger threshold velocity or a softer contact$"
    )
    with pytest.raises(IntegrationError, match=text):
        marched(
            problem,
            Dwell(2.0 * np.pi * 135.0, 0.1),
            options,
            start=from_rest(problem),
        )


def test_blocks_before_a_failure_stay_what_they_are() -> None:
    problem = rig_problem(friction__mu_dynamic=10.0, model="full")
    sweep = SweptSine(
        ramp=0.0, start=0.005, end=0.09, duration=0.1, lowest=130.0, highest=138.0
    )
    options = MarchOptions(2e-3, store_every=1, divisions=1, method="reference")
    blocks: list[TimeHistory] = []

    with pytest.raises(IntegrationError, match=r"^the step at t = 0\.0\d* s does not"):
        blocks.extend(
            integrate(problem, sweep, options, start=from_rest(problem), block=2e-3)
        )

    # steps in more parts go on; until then nothing is divided so far
    patient = dataclasses.replace(options, divisions=4)
    whole = marched(problem, sweep, patient, start=from_rest(problem))
    history = joined(blocks, "failed")
    assert 0.004 < history.time[-1] < 0.09
    np.testing.assert_array_equal(
        history.displacement, whole.displacement[: history.time.size]
    )


@pytest.mark.parametrize("model", [{"model": "A"}, {"friction__mu_dynamic": 10.0}])
def test_the_size_of_blocks_changes_no_bit(model: dict[str, object]) -> None:
    problem = rig_problem(**model)
    sweep = SweptSine(
        ramp=0.01, start=0.02, end=0.09, duration=0.1, lowest=130.0, highest=138.0
    )
    options = MarchOptions(2e-4, store_every=3)

    whole = marched(problem, sweep, options, block=1.0)
    parts = marched(problem, sweep, options, block=0.0071)

    one, many = (dataclasses.asdict(each) for each in (whole, parts))
    ends = one.pop("checkpoint"), many.pop("checkpoint")
    for each, other in ((one, many), ends):
        for name, values in each.items():
            np.testing.assert_array_equal(values, other[name], name)


@pytest.mark.kernels
@pytest.mark.parametrize("duration", [1.0, 0.7301, 1.0 / 3.0, 0.7])
@pytest.mark.parametrize("store_every", [1, 7])
def test_rows_are_stored_at_even_times_up_to_exactly_the_end(
    duration: float, store_every: int
) -> None:
    options = MarchOptions(0.01, store_every=store_every)

    history = marched(oscillator(), Dwell(3.0, duration), options, block=0.2)

    assert history.time_step <= 0.01
    assert history.time[-1] == duration
    rows = np.arange(1, len(history.time) + 1)
    np.testing.assert_allclose(
        history.time, rows * store_every * history.time_step, rtol=1e-14
    )


@pytest.mark.kernels
def test_a_row_holds_the_motion_at_its_time() -> None:
    problem, frequency = oscillator(preload=3.0), 5.0
    every = marched(problem, Dwell(frequency, 1.0), MarchOptions(0.01, 1))

    sparse = marched(problem, Dwell(frequency, 1.0), MarchOptions(0.01, 5))

    np.testing.assert_array_equal(sparse.time, every.time[4::5])
    np.testing.assert_array_equal(sparse.displacement, every.displacement[4::5])
    np.testing.assert_array_equal(sparse.velocity, every.velocity[4::5])
    np.testing.assert_array_equal(sparse.energy, every.energy[4::5])


@pytest.mark.kernels
def test_a_march_begins_unloaded_and_at_rest_if_nothing_else_is_said() -> None:
    problem = oscillator(mass=2.0, damping=0.0, stiffness=0.5, preload=3.0, drive=0.0)

    history = marched(problem, Dwell(1.0, 0.1), MarchOptions(1e-3, 1))

    # From rest at x = 0 under 3 N: x = 6 (1 − cos t/2)
    expected = 6.0 * (1.0 - np.cos(history.time / 2.0))
    np.testing.assert_allclose(history.displacement[:, 0], expected, rtol=1e-6)
    assert history.stored_at_start == 0.0


@pytest.mark.kernels
def test_a_block_at_rest_under_a_falling_load_stays_in_contact() -> None:
    points = contact_points(stiffness=300.0, exponent=1.0, damping=0.0, friction=0)
    problem = mass_on_contact(points, direction=NORMAL, preload=3.0)

    history = marched(
        problem, Dwell(1.0, 0.1), MarchOptions(1e-3, 1), start=from_rest(problem)
    )

    np.testing.assert_allclose(history.normal_force, 3.0, rtol=1e-9)
    np.testing.assert_allclose(history.displacement, 0.01, rtol=1e-9)
    np.testing.assert_allclose(history.of("contact"), 0.015, rtol=1e-9)


def test_a_march_does_not_write_to_its_start() -> None:
    start = Start(np.array([0.3]), np.array([1.0]))

    marched(oscillator(), Dwell(1.0, 1.0), MarchOptions(0.01), start=start)

    assert start.displacement[0] == 0.3
    assert start.velocity[0] == 1.0


@pytest.mark.parametrize(
    ("name", "values", "text"),
    [
        (
            "time_step",
            (0.0, -1e-5, np.nan, np.inf),
            "time step {:g} s: give a positive finite one",
        ),
        ("store_every", (0, -1, np.nan), "store every {} steps: give at least 1"),
        (
            "residual",
            (0.0, -1e-9, 1.0, np.nan, np.inf),
            "residual {:g}: give one between 0 and 1, such as 1e-9",
        ),
        (
            "tolerance",
            (0.0, -1e-3, 1e-30, 1.0, np.nan, np.inf),
            "tolerance {:g}: give one between 1e-14 and 1, such as 1e-3",
        ),
        ("divisions", (0, -1, 21, np.nan), "{} divisions of a step: give 1 to 20"),
    ],
)
def test_options_that_no_march_can_use_are_refused(
    name: str, values: tuple[float, ...], text: str
) -> None:
    for value in values:
        with pytest.raises(ValueError, match=f"^{text.format(value)}$"):
            MarchOptions(**{name: value})  # type: ignore[arg-type]


@pytest.mark.parametrize("block", [0.0, -0.1, np.nan, np.inf])
def test_a_block_without_a_length_is_refused(block: float) -> None:
    text = f"^block of {block:g} s: give a positive finite length$"

    with pytest.raises(ValueError, match=text):
        marched(oscillator(), Dwell(3.0, 1.0), MarchOptions(0.01), block=block)


@pytest.mark.parametrize("stop", [1, 3])
def test_march_goes_on_from_a_checkpoint_as_if_it_had_never_stopped(stop: int) -> None:
    problem = rig_problem(model="B")
    sweep = SweptSine(0.005, 0.01, 0.04, 0.05, 125.0, 145.0)
    whole = list(integrate(problem, sweep, MarchOptions(), block=0.01))

    rest = list(
        integrate(
            problem,
            sweep,
            MarchOptions(),
            start=whole[stop].checkpoint,
            block=0.013,
        )
    )

    part, expected = joined(rest, "complete"), joined(whole[stop + 1 :], "complete")
    np.testing.assert_array_equal(part.time, expected.time)
    for name in ("displacement", "velocity", "normal_force", "energy"):
        ours, theirs = getattr(part, name), getattr(expected, name)
        scale = np.abs(theirs).max()
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=1e-12 * scale)
    assert part.stored_at_start == expected.stored_at_start


@pytest.mark.parametrize("method", ["fast", "reference"])
def test_march_does_not_go_on_with_another_step(
    method: Literal["fast", "reference"],
) -> None:
    dwell = Dwell(3.0, 1.0)
    block = next(integrate(oscillator(), dwell, MarchOptions(0.01, method=method)))
    half = MarchOptions(0.005, method=method)

    with pytest.raises(ValueError, match="cannot go on with steps of"):
        next(integrate(oscillator(), dwell, half, start=block.checkpoint, block=0.1))


def test_march_does_not_go_on_from_that_of_another_problem() -> None:
    dwell = Dwell(3.0, 1.0)
    block = next(integrate(oscillator(), dwell, MarchOptions(0.01)))

    with pytest.raises(ValueError, match="it must be one of the same problem"):
        next(
            integrate(
                rig_problem(model="A"), dwell, MarchOptions(), start=block.checkpoint
            )
        )
