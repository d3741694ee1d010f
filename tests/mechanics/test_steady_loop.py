"""Derivatives of friction that remembers, over a period that repeats itself."""

import numpy as np
import pytest

from hbm.forces.fourier import derivative, waves
from law_examples import driven
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.elastic import ElasticFriction, elastic_traction
from microslip_mechanics.contact.loop_gradient import LoopGradient, Waves, loop_gradient
from microslip_mechanics.contact.memory import pressed
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.steady_loop import steady_loop

pytestmark = pytest.mark.kernels

HARMONICS, SAMPLES, OMEGA = 3, 40, 7.0
STEP = 1e-6
"""of a coefficient, over the size of all"""
LEAN = 0.002 * np.array([0.0, 1.0, 0.0])


def series() -> Waves:
    """Return the Fourier terms at the samples."""
    value, _ = waves(HARMONICS, SAMPLES)
    slope = -derivative(value)
    return Waves(np.ascontiguousarray(value.T), np.ascontiguousarray(slope.T))


def loop(
    points: ContactPoints,
    coefficients: Array,
    gradient: LoopGradient,
    omega: float = OMEGA,
    axes: tuple[bool, bool, bool] = (True, True, True),
) -> tuple[Array, Array]:
    """Return the tractions of a motion, (2, samples), and (∂/∂ω) ω of them.

    A mean of the motion along the tangents bends the slider besides.
    """
    terms = series()
    moved = np.ascontiguousarray((terms.value @ coefficients).T)
    moving = np.ascontiguousarray(omega * (terms.slope @ coefficients).T)
    lean = LEAN + coefficients[0] * [0.0, 1.0, 1.0]
    return steady_loop(
        points, 0, moved, moving, terms, omega, np.array(axes), lean, gradient
    )


def whole(gradient: LoopGradient) -> Array:
    """Return derivatives of tractions by coefficients, (2, 3, samples, 2H + 1)."""
    terms = series()
    rest = np.moveaxis(gradient.rest[gradient.run], 0, 2)
    now, rate = gradient.now[..., None], gradient.rate[..., None]
    found: Array = now * terms.value + rate * terms.slope + rest
    return found


@pytest.mark.parametrize("case", ["elastic", "dahl", "lugre"])
@pytest.mark.parametrize(
    "size", [2e-5, 2e-3, 0.05, 0.3], ids=["creeps", "sticks", "slips", "slides"]
)
def test_derivatives_are_those_of_differences(case: str, size: float) -> None:
    points = driven(case).interface.points
    random = np.random.default_rng(3)
    motion = size * random.standard_normal((2 * HARMONICS + 1, 3)) * [0.1, 1.0, 1.0]
    motion[0, 0] = 0.02

    agree(points, motion, size)


@pytest.mark.parametrize("case", ["dahl", "lugre"])
def test_bristles_that_creep_pull_to_neither_side_along_their_way(case: str) -> None:
    points = driven(case).interface.points
    motion = np.zeros((2 * HARMONICS + 1, 3))
    motion[0, 0] = 0.02
    # a period forgets a fiftieth, and the middle of the way is not the mean in time
    motion[1, 1], motion[3, 1] = 1e-4, 4e-5

    traction, _ = loop(points, motion, loop_gradient(SAMPLES, 0))

    # of ∮ dT = 0 and ∮ dw = 0 under a constant load ∮ T |dw| = 0 is left
    way = series().value @ motion[:, 1]
    slides = np.abs(np.diff(way, append=way[0]))
    between = 0.5 * (traction[0] + np.roll(traction[0], -1))
    assert abs(between @ slides) < 2e-3 * (np.abs(between) @ slides)


def test_derivatives_know_where_a_slider_came_to_stick_for_good() -> None:
    points = driven("elastic").interface.points
    limit = 0.3 * (2.0 + 30.0 * 0.02) / 40.0
    motion = np.zeros((2 * HARMONICS + 1, 3))
    motion[0, 0] = 0.02
    # it goes 1.2 limits to one side of its mean and 0.6 to the other: less than two
    motion[1, 1], motion[3, 1] = 0.8 * limit, 0.4 * limit

    agree(points, motion, limit)


def test_derivatives_of_one_direction_are_those_among_all() -> None:
    points = driven("elastic").interface.points
    motion = np.zeros((2 * HARMONICS + 1, 3))
    motion[:3, 1] = 0.0, 0.05, 0.02
    every, alone = (loop_gradient(SAMPLES, len(motion)) for _ in range(2))
    alone.rest[:] = np.nan

    loop(points, motion, every)
    loop(points, motion, alone, axes=(False, True, False))

    np.testing.assert_array_equal(whole(alone)[0, 1], whole(every)[0, 1])
    assert np.isfinite(whole(every)).all()


def test_a_straight_loop_has_few_runs() -> None:
    points = driven("elastic").interface.points
    motion = np.zeros((2 * HARMONICS + 1, 3))
    motion[:3, 1] = 0.0, 0.05, 0.02
    gradient = loop_gradient(SAMPLES, len(motion))

    loop(points, motion, gradient, axes=(True, True, False))

    # it sticks and slides, twice each, besides the run with which a period begins
    assert gradient.run.max() <= 5
    assert (np.diff(gradient.run) >= 0).all()


def agree(points: ContactPoints, motion: Array, size: float) -> None:
    """Compare derivatives with differences."""
    none, parts = loop_gradient(SAMPLES, 0), loop_gradient(SAMPLES, len(motion))

    _, by_frequency = loop(points, motion, parts)

    gradient = whole(parts)
    scale = np.abs(gradient).max()
    for term, axis in np.ndindex(motion.shape):
        change = np.zeros_like(motion)
        change[term, axis] = STEP * size
        more, less = (loop(points, motion + s * change, none)[0] for s in (1.0, -1.0))
        expected = (more - less) / (2.0 * STEP * size)
        found = gradient[:, axis, :, term]
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-5 * scale)
    faster, slower = (
        loop(points, motion, none, OMEGA * (1.0 + s * STEP))[0] for s in (1.0, -1.0)
    )
    expected = (faster - slower) / (2.0 * STEP)
    np.testing.assert_allclose(by_frequency, expected, atol=1e-5 * scale * size)


def marched(points: ContactPoints, path: Array) -> tuple[Array, list[float]]:
    """Return the traction at all samples in the end, and its changes by periods.

    The point slides along two tangents, ``path`` being of shape ``(samples, 2)``, under
    the load of a face that rests at zero.
    """
    law = ElasticFriction(float(points.tangential[0]), float(points.dynamic[0]))
    load = pressed(points, 0, 0.0, 0.0)[0].load
    made, by = np.zeros((2, SAMPLES)), np.zeros((2, 10))
    changes = list[float]()
    traction, slide = law.stiffness * (path[0] - path.mean(axis=0) + LEAN[1:]), path[0]
    while not changes or changes[-1] > 1e-13 * np.abs(made).max():
        before = traction
        for place, there in enumerate(path):
            old, new = traction, np.zeros(2)
            pulled = float(there[0] - slide[0]), float(there[1] - slide[1])
            elastic_traction(law, pulled, load, load, old, new, by)
            traction, slide, made[:, place] = new, there, new
        changes.append(float(np.abs(traction - before).max()))
    return made, changes


@pytest.mark.parametrize("across", [0.3, 0.6])
def test_slips_along_two_tangents_are_followed_until_they_repeat_themselves(
    across: float,
) -> None:
    # a slip at each end of a narrow way turns the traction a little, from both sides
    points = driven("elastic").interface.points
    motion = np.zeros((2 * HARMONICS + 1, 3))
    motion[1, 1], motion[2, 2] = 0.0151, across * 0.0151
    motion[1, 2], motion[3, 2] = 0.3 * motion[2, 2], 0.2 * motion[2, 2]

    made, _ = loop(points, motion, loop_gradient(SAMPLES, 0))

    expected, changes = marched(points, series().value @ motion[:, 1:])
    assert len(changes) > 100
    assert changes[20] > 1e-4
    np.testing.assert_allclose(made, expected, rtol=0.0, atol=1e-11)
    agree(points, motion, 0.0151)
