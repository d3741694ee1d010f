"""One beam with a spring at its tip, in more and more unknowns: run
``python tests/benchmarks/size.py``.

A clamped beam carries a cubic spring to the ground at its tip. The same curve is traced
with 15, 500 and 3333 elements (30, 1000 and 19 998 degrees of freedom); the first two
bend in one plane, the last has all six motions of each node. Times are of one thread's
processor, medians of repeated runs. Exit status 1 if curves differ by more than 1e-5,
if the number of unknowns grows, or if a point costs more than twice as much.
"""

from __future__ import annotations

import dataclasses
import os
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np
import scipy.sparse

from hbm.balance.relative_problem import relative_problem
from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import TWO_SIDED, PointLaw, contact_table
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.reduction.reduction import reduced
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import response_curve
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.beam import RectangularSection, beam_matrices
from microslip_mechanics.structures.structure import Structure

HERTZ = 2.0 * np.pi
SECTION = RectangularSection(0.02, 0.01, 2.1e11, 0.3, 7800.0)
LENGTH = 0.5
DOWN = ("uz", "ry")
ALL = ("ux", "uy", "uz", "rx", "ry", "rz")
CASES = ((15, DOWN), (500, DOWN), (3333, ALL))
CUBIC = 2e10
"""of the spring at the tip [N/m³]"""
FORCE = 8.0
"""amplitude at the tip [N]"""
LOWEST, HIGHEST = 28.0 * HERTZ, 48.0 * HERTZ
RESOLVED = 4000.0 * HERTZ
CLOSE, COSTLY = 1e-5, 2.0
"""targets: largest difference of the curves, and ratio of costs by point"""


class Case(NamedTuple):
    """What one size has shown."""

    dofs: int
    coordinates: int
    unknowns: int
    reduction: float
    """[s]"""
    point: float
    """[s]"""
    points: int
    curve: list[PeriodicResponse]
    problem: Problem


def main() -> int:
    """Print a row for each size; return the exit status."""
    cases = [measured(elements, motions) for elements, motions in CASES]
    first = cases[0]
    print(
        "     dofs  coordinates  unknowns  reduction [s]  points  point [ms]"
        "  difference"
    )
    good = True
    for case in cases:
        difference = deviation(first, case)
        print(
            f"{case.dofs:9d} {case.coordinates:12d} {case.unknowns:9d}"
            f" {case.reduction:14.3f} {case.points:7d} {1e3 * case.point:11.2f}"
            f" {difference:11.1e}",
            flush=True,
        )
        good &= difference <= CLOSE
        good &= case.unknowns == first.unknowns
        good &= 1.0 / COSTLY <= case.point / first.point <= COSTLY
    print("all targets are met" if good else "a target is missed")
    return 0 if good else 1


def beam(elements: int, motions: tuple[str, ...]) -> Problem:
    """Return the beam with its spring, sparse."""
    count = len(motions)
    elastic, inertial = beam_matrices(SECTION, LENGTH / elements)
    kept = [6 * end + ALL.index(motion) for end in (0, 1) for motion in motions]
    places = count * np.arange(elements)[:, None] + np.arange(2 * count)
    rows = np.repeat(places, 2 * count, axis=1).ravel()
    columns = np.tile(places, (1, 2 * count)).ravel()
    size = count * (elements + 1)

    def assembled(element: Array) -> scipy.sparse.csc_array:
        values = np.tile(element[np.ix_(kept, kept)].ravel(), elements)
        whole = scipy.sparse.csc_array((values, (rows, columns)), shape=(size, size))
        return scipy.sparse.csc_array(whole[count:, count:])

    mass, stiffness = assembled(inertial), assembled(elastic)
    tip = np.zeros(size - count)
    tip[size - 2 * count + motions.index("uz")] = 1.0
    law = PointLaw(normal=TWO_SIDED, stiffness=CUBIC, exponent=3.0)
    names = tuple(f"{n + 1}.{m}" for n in range(elements) for m in motions)
    return Problem(
        Structure(mass, 2.0 * mass + 2e-5 * stiffness, stiffness, names),
        Interface(contact_table([law]), np.outer([1.0, 0.0, 0.0], tip), ("spring",)),
        np.zeros(tip.size),
        FORCE * tip,
        Probes(("tip",), tip[None]),
    )


def measured(elements: int, motions: tuple[str, ...]) -> Case:
    """Return the curve of one size and what it costs."""
    problem = beam(elements, motions)
    small = reduced(problem, RESOLVED)
    rest = static_equilibrium(small.problem)
    unknowns = relative_problem(small.problem, rest).rank
    options = CurveOptions(
        LOWEST, HIGHEST, harmonics=7, samples=128, tolerance=1e-10, stability=False
    )

    def traced() -> list[PeriodicResponse]:
        return list(frequency_response(small.problem, rest, options))

    curve = traced()
    return Case(
        problem.structure.dofs,
        small.problem.structure.dofs,
        unknowns * (2 * 7 + 1),
        seconds(lambda: reduced(problem, RESOLVED), 3),
        seconds(traced, 5) / len(curve),
        len(curve),
        curve,
        small.problem,
    )


def deviation(first: Case, case: Case) -> float:
    """Return the largest relative difference of amplitudes at the first's frequencies.

    Each point of the first curve is solved for with the other structure, from the
    nearest point of its own curve.
    """
    rest = static_equilibrium(case.problem)
    own, near = (
        response_curve(each.problem, each.curve, "").amplitude[:, 0]
        for each in (first, case)
    )
    frequencies = np.array([point.frequency for point in case.curve])
    found = []
    for point, amplitude in zip(first.curve, own, strict=True):
        apart = np.abs(frequencies / point.frequency - 1.0)
        apart += np.abs(near / amplitude - 1.0)
        start = case.curve[int(apart.argmin())]
        response = periodic_response(
            case.problem,
            rest,
            dataclasses.replace(start, frequency=point.frequency),
            harmonics=7,
            samples=128,
            tolerance=1e-10,
        )
        seen = response.seen(case.problem.probes.rows)
        found.append(abs(np.hypot(seen[1, 0], seen[2, 0]) / amplitude - 1.0))
    return float(max(found))


def seconds(run: Callable[[], object], times: int) -> float:
    """Return the median time of runs on one processor."""
    found = []
    for _ in range(times):
        start = time.process_time()
        run()
        found.append(time.process_time() - start)
    return statistics.median(found)


if __name__ == "__main__":
    sys.exit(main())
