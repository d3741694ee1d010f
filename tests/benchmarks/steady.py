"""Where is a motion steady? python tests/benchmarks/steady.py [--hertz HZ] [--case N].

Combinations of ``microslip grid two-blades`` under a drive that is no less than the
preload, all or those of the given numbers, are marched from rest. For each a line tells
by how much of itself a period still changes the state, and after how many periods it
repeats itself best; then how many are steady. All take half an hour.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections import defaultdict
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.grid import Case, cases
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import loaded

PERIODS, STEPS, STORED = 1500, 320, 10
SEEN, LONGEST = 100, 24
"""last periods that are compared, and most of them that a motion may take to repeat"""
STEADY = 2e-5
"""change of the state by a period, over its size"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hertz", type=float, nargs="+", default=[125.0, 136.5])
    parser.add_argument("--periods", type=int, default=PERIODS)
    parser.add_argument("--case", type=int, nargs="*")
    options = parser.parse_args()
    all_cases = cases(load_scene("two-blades", ()))
    numbers = options.case or [
        number for number, each in enumerate(all_cases) if each.drive >= each.preload
    ]
    for hertz in options.hertz:
        steady: dict[float, list[bool]] = defaultdict(list)
        for number in numbers:
            case = all_cases[number]
            change = told(number, case, hertz, options.periods)
            steady[round(case.drive / case.preload)].append(change <= STEADY)
        for ratio, found in sorted(steady.items()):
            print(
                f"{hertz:g} Hz, drive over preload {ratio:g}: "
                f"{sum(found)} of {len(found)} steady",
                flush=True,
            )


def told(number: int, case: Case, hertz: float, periods: int) -> float:
    """Print what becomes of one case; return how much a period changes the state."""
    problem = problem_of(load_scene("two-blades", case.overrides))
    states = marched(problem, hertz, periods)
    changes = {
        each: change(states, each) for each in range(1, min(LONGEST, len(states) - 1))
    }
    least = min(changes, key=changes.__getitem__)
    print(
        f"{number:3d} {case.law:7s} sigma {case.sigma:g} V_lim {case.threshold:g} "
        f"mu {case.friction:g} preload {case.preload:g} N drive {case.drive:g} N, "
        f"{hertz:g} Hz: a period changes {changes[1]:.1e}, {least} of them "
        f"{changes[least]:.1e}",
        flush=True,
    )
    return changes[1]


def marched(problem: Problem, hertz: float, periods: int) -> Array:
    """Return the last states at ends of periods, weighted by mass, (SEEN, 2 dofs)."""
    frequency, period = math.tau * hertz, 1.0 / hertz
    root = np.linalg.cholesky(problem.structure.dense.mass).T
    drive, states = Dwell(frequency, periods * period), list[Array]()
    for block in integrate(
        problem,
        drive,
        MarchOptions(period / STEPS, STORED),
        start=loaded(problem, drive),
        block=period,
    ):
        end = block.checkpoint
        assert end is not None
        state = root @ end.displacement, root @ end.velocity / frequency
        states = [*states[1 - SEEN :], np.concatenate(state)]
    return np.array(states)


def change(states: Array, periods: int) -> float:
    """Return by how much of itself so many periods change a state at the most."""
    size = float(np.linalg.norm(states, axis=1).mean())
    away = states[periods:] - states[:-periods]
    return float(np.linalg.norm(away, axis=1).max()) / size


if __name__ == "__main__":
    main()
