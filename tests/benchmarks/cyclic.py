"""One sector beside the whole disk: run ``python tests/benchmarks/cyclic.py``.

The scene bladed-disk with more and more sectors and an engine order that grows with
them, so that all disks move alike. Both curves are traced with fixed harmonics and
samples, a multiple of the sectors: the samples of all sectors then fall on each other.
At every fourth point of the sector's curve the disk is solved anew, from a guess that
is 2 % off. Times are of one thread's processor per point, warm. Exit status 1 if
amplitudes differ by more than 1e-8, or if the sector is not cheaper.
"""

from __future__ import annotations

import dataclasses
import os
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from hbm.curves.cyclic import cyclic_response
from hbm.curves.periodic_response import periodic_response
from hbm.forces.fourier import to_complex, to_real
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.bladed_disk.build import sector
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.cyclic import CyclicProblem
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

SECTORS = (6, 12, 24, 36, 48, 60)
HARMONICS, SAMPLES = 3, 720
EVERY = 4
CLOSE = 1e-8


def main() -> int:
    """Print a row for each disk; return the exit status."""
    print("sectors  points  sector [ms]  disk [ms]   ratio  difference")
    good = True
    for count in SECTORS:
        problem, options = case(count)
        own, curve = timed(partial(cyclic_response, problem, options))
        disk = problem.disk()
        rest = static_equilibrium(disk)
        other, _ = timed(partial(frequency_response, disk, rest, options))
        apart = max(deviation(problem, disk, point) for point in curve[::EVERY])
        print(
            f"{count:7d} {len(curve):7d} {1e3 * own:12.2f} {1e3 * other:10.2f}"
            f" {other / own:7.1f} {apart:11.1e}",
            flush=True,
        )
        good &= apart <= CLOSE and other > own
    print("all targets are met" if good else "a target is missed")
    return 0 if good else 1


def case(count: int) -> tuple[CyclicProblem, CurveOptions]:
    """Return a disk with a sixth as many diameters as sectors, and its curve."""
    scene = load_scene(
        "bladed-disk", [f"sectors={count}", f"drive.engine_order={count // 6}"]
    )
    options = CurveOptions(
        2.0 * np.pi * 150.0,
        2.0 * np.pi * 200.0,
        harmonics=HARMONICS,
        samples=SAMPLES,
        tolerance=1e-10,
        stability=False,
        errors=False,
    )
    return sector(scene.rig), options


def timed(
    trace: Callable[[], Iterator[PeriodicResponse]],
) -> tuple[float, list[PeriodicResponse]]:
    """Return seconds per point of a curve, warm, and the curve."""
    list(trace())
    began = time.process_time()
    curve = list(trace())
    return (time.process_time() - began) / len(curve), curve


def deviation(problem: CyclicProblem, disk: Problem, point: PeriodicResponse) -> float:
    """Return how far the disk's amplitudes are from the sector's, over the largest."""
    whole = around(problem, point)
    solved = periodic_response(
        disk,
        static_equilibrium(disk),
        dataclasses.replace(point, coefficients=0.98 * whole),
        harmonics=HARMONICS,
        samples=SAMPLES,
        tolerance=1e-10,
    ).coefficients
    amplitude = np.hypot(whole[1], whole[2])
    change = np.hypot(solved[1], solved[2]) - amplitude
    return float(np.abs(change).max() / amplitude.max())


def around(problem: CyclicProblem, point: PeriodicResponse) -> Array:
    """Return the coefficients of the disk: each sector leads the one before."""
    waves = to_complex(point.coefficients)
    orders = np.arange(len(waves))[:, None]
    turns = [np.exp(1j * problem.lead * j * orders) for j in range(problem.sectors)]
    return to_real(np.hstack([waves * turn for turn in turns]))


if __name__ == "__main__":
    sys.exit(main())
