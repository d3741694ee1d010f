"""What goes wrong silently elsewhere: each known pitfall is caught or avoided."""

import dataclasses

import numpy as np
import pytest
import scipy.integrate
import scipy.linalg

from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.time_history import TimeHistory
from other_schemes import TRAPEZOID
from rigs import rig_problem
from small_problems import cantilever, from_rest, marched, oscillator, sliding_block
from timedomain.fast.coordinates import modal_coordinates
from timedomain.fast.fast import FastMarch
from timedomain.fast.schemes import MEAN_FORCE, SDIRK2
from timedomain.fast.tables import empty_tables, fill
from timedomain.integrate import MarchOptions
from timedomain.record.closure import closes
from timedomain.record.start import Start, at_rest

LIGHT = 0.002
"""damping ratio"""


def light_beam() -> tuple[Problem, float]:
    """Return a lightly damped beam and its first frequency [rad/s]."""
    beam = cantilever(elements=2, mass_damping=0.0, stiffness_damping=0.0)
    structure = beam.structure
    lowest = np.sqrt(scipy.linalg.eigvalsh(structure.stiffness, structure.mass)[0])
    damping = 2.0 * LIGHT * lowest * structure.mass
    lossy = dataclasses.replace(structure, damping=damping)
    return dataclasses.replace(beam, structure=lossy), float(lowest)


def by_multistep(problem: Problem, dwell: Dwell, template: TimeHistory) -> TimeHistory:
    """Return the march of a linear problem by BDF at a loose tolerance."""
    structure = problem.structure
    count = structure.dofs
    inverse = np.linalg.inv(structure.mass)
    matrix = np.block(
        [
            [np.zeros((count, count)), np.eye(count)],
            [-inverse @ structure.stiffness, -inverse @ structure.damping],
        ]
    )
    push = np.concatenate([np.zeros(count), inverse @ problem.drive])

    def rate(time: float, state: np.ndarray) -> np.ndarray:
        pulled: np.ndarray = matrix @ state + push * np.sin(dwell.frequency * time)
        return pulled

    time = np.linspace(0.0, dwell.duration, 20 * len(template.time) + 1)
    solved = scipy.integrate.solve_ivp(
        rate,
        (0.0, dwell.duration),
        np.zeros(2 * count),
        method="BDF",
        jac=lambda *_: matrix,
        rtol=1e-2,
        atol=1e-6,
        t_eval=time,
    )
    assert solved.success
    moved, moving = solved.y[:count], solved.y[count:]
    powers = [
        np.sin(dwell.frequency * time) * (problem.drive @ moving),
        0.0 * time,
        0.0 * time,
        np.einsum("it,ij,jt->t", moving, structure.damping, moving),
    ]
    stored = [
        0.5 * np.einsum("it,ij,jt->t", moving, structure.mass, moving),
        0.5 * np.einsum("it,ij,jt->t", moved, structure.stiffness, moved),
        0.0 * time,
    ]
    flown = scipy.integrate.cumulative_simpson(powers, x=time, initial=0.0)
    energy = np.vstack([flown, stored])[:, 20::20].T
    return dataclasses.replace(
        template, energy=energy, displacement=(problem.probes.rows @ moved)[:, 20::20].T
    )


@pytest.mark.long
def test_the_energy_balance_does_not_close_on_a_loose_multistep_march() -> None:
    problem, frequency = light_beam()
    dwell = Dwell(frequency, 0.5)
    own = marched(problem, dwell, MarchOptions(1e-4, 1), block=1.0)

    other = by_multistep(problem, dwell, own)

    size = np.abs(own.of("input")).max()  # there is no friction
    assert np.abs(own.closing_error).max() <= 1e-3 * size
    assert closes(own)
    assert not closes(other)
    wrong = np.abs(other.displacement - own.displacement).max()
    assert wrong > 0.1 * np.abs(own.displacement).max()


def explicit(problem: Problem, dwell: Dwell, step: float, start: Start) -> float:
    """Return the energy of friction by symplectic Euler, for one sliding block."""
    points = problem.interface.points
    mass, stiffness = problem.structure.mass[0, 0], problem.structure.stiffness[0, 0]
    limit, threshold = points.dynamic[0] * points.load[0], points.threshold[0]
    place, speed = float(start.displacement[0]), float(start.velocity[0])
    energy = 0.0
    for number in range(round(dwell.duration / step)):
        friction = limit * speed / max(abs(speed), threshold)
        energy += step * friction * speed
        pull = problem.drive[0] * np.sin(dwell.frequency * step * number)
        speed += step * (pull - stiffness * place - friction) / mass
        place += step * speed
    return energy


def test_an_explicit_method_above_the_friction_limit_is_wrong_but_bounded() -> None:
    threshold, mass = 0.01, 2.0
    problem = sliding_block(
        mass=mass, stiffness=8.0, drive=3.0, dynamic=0.3, load=1.7, threshold=threshold
    )
    start, dwell = Start(np.array([0.1]), np.array([1.5])), Dwell(3.0, 8.0)
    limit = 2.0 * mass * threshold / (0.3 * 1.7)

    own = marched(
        problem, dwell, MarchOptions(0.01, 1, tolerance=1e-4), start=start, block=9.0
    ).of("friction")[-1]
    found = [explicit(problem, dwell, share * limit, start) for share in (2.0, 3.0)]

    errors = np.abs(np.array(found) / own - 1.0)
    assert explicit(problem, dwell, 0.002 * limit, start) == pytest.approx(
        own, rel=1e-3
    )
    assert np.all(errors > 0.005)
    assert np.all(errors < 0.05)


def test_a_force_constant_over_a_step_answers_with_the_wrong_sign() -> None:
    coordinates = modal_coordinates(rig_problem())
    modes, contacts = coordinates.modes, coordinates.contacts
    tables = empty_tables(MEAN_FORCE, modes, contacts)
    fill(tables, MEAN_FORCE, modes, contacts, level=0, step=5e-4)
    by_end = tables.forced[0, 0, 1, 1]  # velocities, of forces linear over the step

    constant = tables.swing[0]
    linear = (modes.selection * by_end) @ modes.seen
    mean = tables.compliance[0, 0]

    assert np.linalg.eigvalsh(constant).min() < 0.0
    assert np.linalg.eigvalsh(linear).min() > 0.0
    assert np.linalg.eigvalsh(mean).min() > 0.0


def test_a_mean_force_needs_no_dissipative_step_on_a_stiff_contact() -> None:
    problem = rig_problem(contact__sigma=3e-10)
    step, steps = 5e-5, 400
    marching = FastMarch(
        problem,
        Dwell(2.0 * np.pi * 137.0, 0.02),
        MarchOptions(step, 4),
        steps,
        from_rest(problem),
        schemes=(MEAN_FORCE, MEAN_FORCE),
    )

    history = marching.block(0, steps)

    closing = np.abs(history.closing_error).max()
    assert closing < 0.05 * history.of("input").max()


def test_a_block_of_a_march_starts_at_rest_with_every_scheme() -> None:
    problem = oscillator()
    for scheme in (MEAN_FORCE, SDIRK2, TRAPEZOID):
        marching = FastMarch(
            problem,
            Dwell(3.0, 0.1),
            MarchOptions(0.01, 1),
            10,
            at_rest(problem),
            schemes=(scheme, SDIRK2),
        )
        assert np.isfinite(marching.block(0, 10).energy).all()
