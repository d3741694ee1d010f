"""Curves of several threads at once are those of one after the other."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from hbm.forces.by_thread import ByThread
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.static import static_equilibrium

TURN = 2.0 * np.pi


@pytest.fixture
def impatient() -> Iterator[None]:
    """Let threads take turns after a few microseconds."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def _curve(_: int) -> np.ndarray:
    problem = problem_of(load_scene("jenkins", []))
    options = CurveOptions(14.0 * TURN, 22.0 * TURN, harmonics=31, stability=False)
    curve = frequency_response(problem, static_equilibrium(problem), options)
    return np.array([point.coefficients for point in curve])


@pytest.mark.usefixtures("impatient")
def test_threads_do_not_write_to_the_samples_of_each_other() -> None:
    alone = _curve(0)

    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(_curve, range(4)))

    for each in together:
        np.testing.assert_array_equal(each, alone)


def test_each_thread_has_room_of_its_own_and_keeps_it() -> None:
    room = ByThread(np.zeros)

    with ThreadPoolExecutor(1) as thread:
        other = thread.submit(room, 3).result()

    assert room(3) is room(3)
    assert other is not room(3)
