"""The set-valued step: sliding blocks that stop, and stay where they are."""

import cmath
import math
from typing import Any

import numpy as np
import pytest

from law_examples import SLIDING, driven
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.loads.given_loads import Drive
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.first_order.first_order import first_order
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

LIMIT = 0.4


def block(stiffness: float, drive: Drive | None = None, **directions: Any) -> Problem:
    return system(
        mass=[2.0, 2.0],
        stiffness=np.diag([stiffness, stiffness]).tolist(),
        names=("x", "y"),
        elements=[Element(RigidCoulomb(mu=0.2, load=LIMIT / 0.2), **directions)],
        drive=drive,
    )


def marched(
    problem: Problem, start: Start, seconds: float, step: float, frequency: float = 1.0
) -> TimeHistory:
    options = MarchOptions(step, store_every=1)
    blocks = integrate(problem, Dwell(frequency, seconds), options, start=start)
    return joined(list(blocks), "complete")


@pytest.mark.parametrize("step", [1e-2, 1e-3])
def test_a_sliding_block_stops_where_its_energy_is_spent(step: float) -> None:
    velocity = np.array([0.3, 0.4])
    history = marched(block(0.0, **SLIDING), Start(np.zeros(2), velocity), 4.0, step)
    # along its velocity: m v²/2 = µN s, and it takes m v / µN
    distance, duration = 2.0 * 0.25 / 2.0 / LIMIT, 2.0 * 0.5 / LIMIT
    path = distance * velocity / 0.5
    assert history.displacement[-1] == pytest.approx(path, abs=0.3 * step)
    after = history.time > duration + 2.0 * step
    assert np.abs(history.velocity[after]).max() < 1e-12
    assert history.of("friction")[-1] == pytest.approx(0.25, abs=0.3 * step)


def decay(step: float) -> TimeHistory:
    """Return a free vibration of 2 kg on 8 N/m that begins 0.97 m away."""
    along: dict[str, Any] = {"tangents": [("x", "ground")]}
    start = Start(np.array([0.97, 0.0]), np.zeros(2))
    return marched(block(8.0, **along), start, 5.5 * np.pi, step)


def test_a_free_vibration_loses_as_much_each_half_period_until_it_sticks() -> None:
    # by 2 µN/k = 0.1 m a half period of π/2 s
    history = decay(np.pi / 2.0 / 400.0)
    turns = history.displacement[399 : 399 + 9 * 400 : 400, 0]
    expected = (0.97 - 0.1 * np.arange(1, 10)) * np.where(np.arange(9) % 2, 1.0, -1.0)
    assert turns == pytest.approx(expected, abs=2e-3)
    # within µN/k = 0.05 m of the middle it stays
    shown = history.displacement[-200:, 0]
    assert np.ptp(shown) < 1e-12
    assert abs(shown[-1]) == pytest.approx(0.03, abs=2e-3)
    stored = 0.5 * 8.0 * (0.97**2 - shown[-1] ** 2)
    assert history.of("friction")[-1] == pytest.approx(stored, rel=2e-3)
    assert abs(history.closing_error[-1]) < 1e-3


def test_errors_fall_with_the_step() -> None:
    # steps that do not divide the half periods
    def left(count: int) -> Array:
        history = decay(np.pi / 2.0 / count)
        time = np.linspace(0.1, 3.9 * np.pi, 500)
        half = np.minimum((time // (np.pi / 2.0)).astype(int), 9)
        size = 0.92 - 0.1 * half
        exact = 0.05 * np.where(half % 2, -1.0, 1.0) + size * np.cos(2.0 * time)
        found = np.interp(time, history.time, history.displacement[:, 0])
        away: Array = found - exact
        return away

    errors = [np.abs(left(count)).max() for count in (41, 161, 641)]
    assert errors[0] < 2e-2
    assert errors[1] < 0.1 * errors[0]
    assert errors[2] < 0.1 * errors[1]


def stepped(along: complex, across: complex, stiffness: float, steps: int) -> Array:
    """Return the velocity x + iy of 2 kg on a rough plane over four periods of 1 s.

    Time stepping of first order after Moreau (1988): a free step, then the friction
    that stops it, or its limit. The force is Re(``along`` e^{iφ}) + i Re(``across``
    e^{iφ}) with φ = 2πt − π/2.
    """
    length, place, velocity, found = 1.0 / steps, 0j, 0j, []
    for step in range(4 * steps):
        turn = -1j * cmath.exp(2j * math.pi * length * (step + 0.5))
        pushed = complex((along * turn).real, (across * turn).real)
        middle = place + 0.5 * length * velocity
        free = velocity + length * (pushed - stiffness * middle) / 2.0
        stopped = length * LIMIT / 2.0
        after = free * max(0.0, 1.0 - stopped / max(abs(free), 1e-300))
        place += 0.5 * length * (velocity + after)
        velocity = after
        found.append(velocity)
    return np.array(found)


@pytest.mark.parametrize("stiffness", [0.0, 60.0])
@pytest.mark.parametrize(
    ("along", "across"), [(0.55, 0.0), (1.0, 0.7j), (0.6, 0.15 + 0.26j)]
)
def test_a_driven_block_moves_as_another_time_stepping_has_it(
    along: complex, across: complex, stiffness: float
) -> None:
    drive = {"x": cmath.polar(along), "y": cmath.polar(across)}
    history = marched(
        block(stiffness, drive=drive, **SLIDING),
        Start(np.zeros(2), np.zeros(2)),
        4.0,
        1.0 / 400.0,
        frequency=2.0 * np.pi,
    )

    other = stepped(along, across, stiffness, 20_000)[49::50]

    velocity = history.velocity @ [1.0, 1j]
    away = np.abs(velocity[-other.size :] - other).max()
    assert away < 5e-4 * np.abs(other).max()  # measured 3.7e-4


def test_a_pushed_block_that_sticks_does_not_move_at_all() -> None:
    problem = driven("rigid coulomb")
    drive = 0.1 * problem.drive
    problem = Problem(
        problem.structure, problem.interface, problem.preload, drive, problem.probes
    )
    start = Start(np.zeros(3), np.zeros(3))
    options = MarchOptions(2e-3, store_every=1)
    blocks = list(integrate(problem, Dwell(7.0, 5.0), options, start=start))
    history = joined(blocks, "complete")
    # the point slides along x and y
    assert np.abs(history.displacement[:, :2]).max() < 1e-10
    assert np.abs(history.displacement[:, 2]).max() > 1e-3


@pytest.mark.kernels  # without the JIT, which does not look whether an index is there
def test_what_the_contact_does_not_see_moves_beside_it() -> None:
    springs, drive = [8.0, 30.0, 50.0, 70.0], {"x": 3.0, "b": 1.0, "c": 2.0}
    slider = Element(RigidCoulomb(mu=0.2, load=2.0), tangents=[("x", "ground")])
    made = [
        system(
            mass=[2.0] * count,
            stiffness=np.diag(springs[:count]).tolist(),
            names=("x", "a", "b", "c")[:count],
            elements=[slider],
            drive={name: drive[name] for name in drive if name in "xabc"[:count]},
        )
        for count in (1, 4)
    ]

    alone, among = (
        marched(each, Start(*np.zeros((2, size))), 1.0, 1e-2, frequency=2.0)
        for each, size in zip(made, (1, 4), strict=True)
    )

    x, *_, b, c = among.displacement.T
    np.testing.assert_allclose(x, alone.displacement[:, 0], rtol=1e-9)
    for spring, force, found in ((50.0, 1.0, b), (70.0, 2.0, c)):
        own = math.sqrt(spring / 2.0)
        rest = np.sin(2.0 * among.time) - 2.0 / own * np.sin(own * among.time)
        exact = force / (spring - 8.0) * rest
        assert found == pytest.approx(exact, abs=2e-3 * np.abs(exact).max())
    assert np.abs(x).max() > 0.05


def test_marches_of_rigid_friction_go_on_from_their_checkpoints() -> None:
    problem = driven("rigid coulomb, variable load")
    options = MarchOptions(2e-3, store_every=5)
    whole = list(integrate(problem, Dwell(7.0, 4.0), options, block=1.0))
    rest = list(
        integrate(
            problem, Dwell(7.0, 4.0), options, start=whole[1].checkpoint, block=1.0
        )
    )
    for one, two in zip(whole[2:], rest, strict=True):
        np.testing.assert_array_equal(one.displacement, two.displacement)


def test_there_is_no_first_order_form() -> None:
    problem = driven("rigid coulomb")
    with pytest.raises(ValueError, match="element: rigid friction is set-valued"):
        first_order(problem, Dwell(7.0, 4.0), motion=1.0, energy=1.0)


def test_a_variable_normal_load_leaves_the_second_order() -> None:
    problem = system(
        mass=[1.0, 1.0],
        stiffness=[1e4, 2e4],
        damping=[2.0, 2.0],
        names=("x", "n"),
        elements=[
            Element(
                RigidCoulomb(mu=0.3, normal_stiffness=1e4, preload=3.0),
                tangents=[("x", "ground")],
                normal=("n", "ground"),
            )
        ],
        drive={"x": (3.0, 0.0), "n": (2.0, 1.0)},
    )
    rest = static_equilibrium(problem).displacement
    turn = 2.0 * math.pi * 14.0

    def ends(steps: int) -> tuple[float, float, float]:
        options = MarchOptions(1.0 / 14.0 / steps, store_every=steps // 64)
        dwell = Dwell(turn, 10.25 / 14.0)
        blocks = integrate(problem, dwell, options, start=Start(rest, np.zeros(2)))
        history = joined(list(blocks), "complete")
        closing = float(np.abs(history.closing_error).max())
        return history.displacement[-1, 0], history.of("friction")[-1], closing

    found = np.array([ends(steps) for steps in (512, 1024, 2048)])

    changes = np.abs(np.diff(found, axis=0))
    # motion and energy; of first order they were halved
    assert (changes[0] / changes[1]) == pytest.approx(4.0, abs=0.5)
    assert found[0, 2] / found[1, 2] == pytest.approx(4.0, abs=0.2)
