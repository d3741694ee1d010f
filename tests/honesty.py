"""True errors of points of a curve against what the curve says of them."""

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_tables import contact_points
from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import NORMAL, mass_on_contact, sliding_block

TURN = 2.0 * np.pi


def block() -> Problem:
    """Return a block on a spring that rubs: sticks, sticks and slides, slides."""
    return sliding_block(
        stiffness=300.0, damping=0.5, drive=1.5, load=1.0, dynamic=0.3, threshold=1e-3
    )


def falling() -> Problem:
    """Return the block with friction that falls with the speed."""
    return sliding_block(
        stiffness=300.0,
        damping=2.0,
        drive=1.5,
        load=1.0,
        dynamic=0.3,
        static=0.5,
        stribeck=0.05,
        threshold=1e-3,
        friction=2,
    )


def bouncing() -> Problem:
    """Return a mass on Hunt and Crossley's contact that it leaves near resonance."""
    points = contact_points(
        friction=0, stiffness=2e4, exponent=1.5, damping=50.0, damping_exponent=0.5
    )
    return mass_on_contact(
        points, direction=NORMAL, damping=20.0, preload=3.0, drive=2.0
    )


def jenkins() -> Problem:
    """Return a mass on a spring and a slider, marched from sample to sample."""
    return problem_of(load_scene("jenkins"))


@dataclass(frozen=True)
class Variant:
    """A problem, its range of frequencies [rad/s] and a reference's resolution."""

    make: Callable[[], Problem]
    start: float
    end: float
    harmonics: int = 255
    samples: int = 4096


VARIANTS = {
    "block": Variant(block, 6.0, 20.0),
    "falling": Variant(falling, 6.0, 20.0),
    "bouncing": Variant(bouncing, 10.0, 40.0),
    "A": Variant(lambda: rig_problem(model="A"), TURN * 125.0, TURN * 145.0),
    "A, GKF": Variant(
        lambda: rig_problem(model="A", friction__law="gkf"), TURN * 125.0, TURN * 145.0
    ),
    "B": Variant(lambda: rig_problem(model="B"), TURN * 125.0, TURN * 145.0),
    "B, GKF": Variant(
        lambda: rig_problem(model="B", friction__law="gkf"), TURN * 125.0, TURN * 145.0
    ),
    "full": Variant(rig_problem, TURN * 125.0, TURN * 145.0, 127, 4096),
    "jenkins": Variant(jenkins, TURN * 14.0, TURN * 22.0, 63, 8192),
}


def amplitudes(problem: Problem, response: PeriodicResponse) -> Array:
    """Return the first harmonic of each probe [m]."""
    seen = response.coefficients[1:3] @ problem.probes.rows.T
    found: Array = np.hypot(*seen)
    return found


def pairs(name: str) -> tuple[tuple[PeriodicResponse, PeriodicResponse], ...]:
    """Return about 20 points by an error of 1e-3, each beside a reference."""
    return solved_again(name, 1e-3, 20)


@functools.cache
def solved_again(
    name: str, error: float, count: int
) -> tuple[tuple[PeriodicResponse, PeriodicResponse], ...]:
    """Return about ``count`` points of a curve, each beside a reference."""
    variant = VARIANTS[name]
    problem = variant.make()
    rest = static_equilibrium(problem)
    options = CurveOptions(variant.start, variant.end, error=error, contact_errors=True)
    traced = frequency_response(problem, rest, options)
    # At a fold, where events lie, no reference has the same frequency.
    curve = [response for response in traced if not response.event]
    places = np.unique(np.linspace(0, len(curve) - 1, count).round().astype(int))
    return tuple(
        (
            curve[place],
            periodic_response(
                problem,
                rest,
                curve[place],
                harmonics=variant.harmonics,
                samples=variant.samples,
                tolerance=1e-7,
            ),
        )
        for place in places
    )


@functools.cache
def errors(name: str, *, error: float = 1e-3, count: int = 20) -> tuple[Array, Array]:
    """Return estimated and true errors of about ``count`` points, relative."""
    problem = VARIANTS[name].make()
    estimated, true = [], []
    for point, reference in solved_again(name, error, count):
        exact, found = amplitudes(problem, reference), amplitudes(problem, point)
        true.append(np.abs(found - exact).max() / exact.max())
        estimated.append(point.error)
    return np.array(estimated), np.array(true)
