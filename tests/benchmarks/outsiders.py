"""microslip's march beside others: run ``python tests/benchmarks/outsiders.py``.

Needs ``pip install '.[bench]'``. All are given the same equations (first_order.py), a
compiled right-hand side and its exact Jacobian, and begin on the same orbit; a window
of the scene's swept sine is marched with a ladder of tolerances or of steps.
The error is the largest one of the energy taken out by friction, over the window, by
that energy at its end; two methods at tight settings tell what is right, and how well
it is known. Costs at the errors asked for are interpolated between the cheapest runs.
Times are of one thread's processor, warm, per simulated second; windows of half and of
twice the length show that they do not depend on it. Errors grow with the window until
it is as long as the motion remembers (0.6 s at 0.2 % damping): ``--window 1`` tells.
"""

from __future__ import annotations

import argparse
import dataclasses
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from benchmarks.dop853 import DOP853, real_limit
from benchmarks.outside_methods import (
    METHODS,
    REFERENCES,
    Case,
    Method,
    by_fixed_dop853,
)
from benchmarks.work_precision import OURS, Run, cost_at, drawn, row, written
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.static import static_equilibrium
from timedomain.first_order.first_order import first_order
from timedomain.record.start import Start

HERTZ = 2.0 * np.pi
CHECKS = 20
"""times of a window at which energies are compared"""
MOTION, ENERGY = 0.1, 1e-3
"""units of the state: it is of order one"""
ASKED = (1e-3, 1e-6)
"""errors at which costs are compared"""
TARGETS = {
    "scipy Radau": (100.0, None),
    "LSODA": (300.0, None),
    "CVODE BDF order 2": (20.0, None),
    "compiled DOP853": (10.0, 3.0),
}
"""cost over microslip's at the errors asked for"""
LENGTHS = {"microslip Newmark": (2.5e-5,), "CVODE BDF order 2": (1e-6, 1.0)}
"""settings at which windows of other lengths are marched"""
WRONG = 0.1
"""error from which on a run that reports success is a trap"""
ABOVE = (0.9, 1.0, 1.02, 1.05, 1.1, 1.2, 1.5, 2.0)
"""steps over that of the friction limit"""


def main() -> int:
    """Print, write and draw the comparison; return 1 if a target is missed."""
    given = arguments()
    case = windowed(given.model, given.set, given.begin, given.window)
    low, high = case.sweep.lowest, case.sweep.highest
    print(f"model {given.model}: {low:.2f} to {high:.2f} Hz in {given.window:g} s")
    exact, doubt = reference(case)
    print(f"friction takes out {exact[-1]:.9g} J; two references differ by {doubt:.1e}")
    if doubt > 0.1 * min(ASKED):
        print(f"that allows no statement on errors below {10.0 * doubt:.0e}")
    runs = [
        run
        for name, method in METHODS.items()
        if any(part in name for part in given.methods)
        for run in ladder(name, method, case, exact, given.budget)
    ]
    written(runs, Path(f"{given.output}.csv"))
    drawn(
        runs,
        f"Model {given.model}, {low:.1f} to {high:.1f} Hz",
        Path(f"{given.output}.png"),
    )
    met = compared(runs, [asked for asked in ASKED if doubt <= 0.1 * asked])
    traps(runs)
    explicit(case, exact)
    doubled(given.model, given.set, given.begin, given.window)
    return 0 if met else 1


def arguments() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(description="microslip beside general solvers")
    parser.add_argument("--model", choices=("full", "A", "B"), default="full")
    parser.add_argument("--begin", type=float, default=134.5, metavar="HZ")
    parser.add_argument("--window", type=float, default=0.3, metavar="SECONDS")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument(
        "--methods", nargs="+", default=[""], help="parts of the names of those to run"
    )
    parser.add_argument(
        "--budget",
        type=float,
        default=30.0,
        help="CPU seconds of a run after which tighter ones are left out",
    )
    parser.add_argument("-o", "--output", default="outsiders", help="without suffix")
    return parser.parse_args()


def windowed(model: str, values: Sequence[str], low: float, window: float) -> Case:
    """Return a window of the scene's sweep that begins on the orbit there."""
    scene = load_scene("two-blades", [f"model={model}", *values])
    problem, whole = problem_of(scene), scene.sweep
    rate = np.log(whole.highest / whole.lowest) / (whole.end - whole.start)
    high = low * float(np.exp(rate * window))
    options = CurveOptions(
        HERTZ * low, HERTZ * 1.001 * low, harmonics=15, stability=False
    )
    orbit = next(frequency_response(problem, static_equilibrium(problem), options))
    displacement, velocity = orbit.at(np.zeros(1))
    sweep = SweptSine(0.0, 0.0, window, window, low, high)
    form = first_order(problem, sweep, motion=MOTION, energy=ENERGY)
    return Case(
        problem,
        sweep,
        Start(displacement[0], velocity[0]),
        np.linspace(0.0, window, CHECKS + 1),
        form,
        *form.compiled(),
    )


def reference(case: Case) -> tuple[Array, float]:
    """Return the energy over time by the first reference, and how far the second is."""
    first, second = (method(case).friction for method in REFERENCES)
    return first, far(second, first)


def far(friction: Array, exact: Array) -> float:
    """Return the largest error of an energy over the exact one at the end."""
    return float(np.abs(friction - exact).max() / exact[-1])


def ladder(
    name: str, method: Method, case: Case, exact: Array, budget: float
) -> list[Run]:
    """Print and return the runs of one method, from loose to tight."""
    runs: list[Run] = []
    warm(method, case)
    ended: set[float] = set()
    for setting in method.settings:
        if setting[-1] in ended and len(setting) > 1:
            continue
        began = time.process_time()
        march = method.run(case, *setting)
        spent = time.process_time() - began
        error = far(march.friction, exact)
        cost = spent / case.sweep.duration
        run = Run(name, setting, cost, error, march.closing, march.success)
        print(row(run), flush=True)
        runs.append(run)
        too_long = spent > budget and error < WRONG  # what is loose may well crawl
        if too_long or error < 0.3 * min(ASKED):
            if len(setting) == 1:
                break
            ended.add(setting[-1])
    return runs


def warm(method: Method, case: Case) -> None:
    """Have everything compiled."""
    short = 1e-3 * case.times
    sweep = dataclasses.replace(
        case.sweep, end=float(short[-1]), duration=float(short[-1])
    )
    method.run(
        dataclasses.replace(case, times=short, sweep=sweep), *method.settings[-1]
    )


def compared(runs: Sequence[Run], errors: Sequence[float]) -> bool:
    """Print costs and ratios; return whether all targets are met."""
    met = True
    names = list(dict.fromkeys(run.name for run in runs))
    for place, asked in enumerate(errors):
        costs = {
            name: cost_at([run for run in runs if run.name == name], asked)
            for name in names
        }
        own = [costs[name] for name in names if name.startswith(OURS)]
        fast = float(np.nanmin(own)) if np.isfinite(own).any() else float("nan")
        print(f"\nat an error of {asked:g}: CPU s per simulated s, over microslip's")
        for name, cost in costs.items():
            target = TARGETS.get(name, (None, None))[place]
            wanted = f"  target {target:g}" if target else ""
            print(f"{name:18s}{cost:10.3f}{cost / fast:10.2f}{wanted}")
            met &= target is None or cost / fast >= target
    print("\nall targets are met" if met else "\na target is missed")
    return met


def traps(runs: Sequence[Run]) -> None:
    """Print what is wrong and reports success, with what energy closure says."""
    print(f"\nwrong by {100 * WRONG:g} % and more, with success reported:")
    for run in runs:
        if run.success and not run.error < WRONG:
            print(row(run))


def explicit(case: Case, exact: Array) -> None:
    """Print what a fixed explicit step just above the friction limit does."""
    matrix = case.tangent(0.0, case.state)
    limit = real_limit(DOP853) / -float(np.linalg.eigvals(matrix).real.min())
    print(
        f"\nDOP853 with fixed steps; friction limits them at the start to {limit:.2e} s"
    )
    for above in ABOVE:
        march = by_fixed_dop853(case, above * limit)
        print(
            f"{above:6.2f} of that: error {far(march.friction, exact):8.1e}"
            f"  closing error {march.closing:8.1e}"
        )


def doubled(model: str, values: Sequence[str], low: float, window: float) -> None:
    """Print the cost per simulated second of half the window, and of twice it."""
    print("\nCPU s per simulated s in windows of other lengths")
    for name, setting in LENGTHS.items():
        costs = []
        for length in (0.5 * window, window, 2.0 * window):
            case, method = windowed(model, values, low, length), METHODS[name]
            warm(method, case)
            began = time.process_time()
            method.run(case, *setting)
            costs.append((length, (time.process_time() - began) / length))
        shown = ", ".join(f"{length:g} s: {cost:.3f}" for length, cost in costs)
        print(f"{name:18s}  {shown}")


if __name__ == "__main__":
    sys.exit(main())
