"""Integrators at the same steps: run ``python tests/benchmarks/integrators.py``.

A sweep of 0.4 s through the resonance, for each model. Errors are those of the
energy that friction takes out and of the largest amplitude, over an extrapolation of
average acceleration, the reference method, to a step of zero. Seconds are of one
thread's processor, warm. With ``--points`` the cost of a step is printed over the
number of contact points, with ``--whole`` that of the scene's whole sweep.
"""

from __future__ import annotations

import dataclasses
import os
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.sweep import swept_sine
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.loads.excitation import LoadHistory, SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from other_schemes import ESDIRK3, TR_BDF2, TRAPEZOID
from timedomain.fast.fast import FastMarch
from timedomain.fast.schemes import MEAN_FORCE, SDIRK2, Scheme
from timedomain.integrate import IntegrationError, MarchOptions, integrate
from timedomain.record.start import at_rest

SCHEMES = (MEAN_FORCE, TRAPEZOID, TR_BDF2, SDIRK2, ESDIRK3)
ROW = 2.5e-4
PARTS = (4, 8)
"""steps per stored row"""
TOLERANCES = (1e-2, 1e-3, 1e-4)
SWEEP = SweptSine(
    ramp=0.02, start=0.05, end=0.45, duration=0.5, lowest=135.0, highest=139.0
)
RIGS = {
    "A": ["model=A"],
    "B": ["model=B"],
    "full stiff": [],
    "full soft": ["contact.sigma=3e-7"],
}
POINTS = (2, 8, 32, 128, 512)


def main() -> None:
    """Print what is asked for."""
    if "--points" in sys.argv:
        per_point()
    elif "--whole" in sys.argv:
        whole()
    else:
        compared()


def compared() -> None:
    """Print a row for each model, law, integrator and step."""
    print("model       law      integrator            step [us]  energy    peak    s")
    for law in ("coulomb", "gkf"):
        for model, changes in RIGS.items():
            scene = load_scene("two-blades", [*changes, f"friction.law={law}"])
            problem = problem_of(scene)
            exact = _extrapolated(problem)
            for name, step, run in _runs(problem):
                measured, seconds = _timed(run)
                error = np.abs(measured / exact - 1.0)
                print(
                    f"{model:11s} {law:8s} {name:22s} {step:8.2f} {error[0]:9.1e}"
                    f" {error[1]:8.1e} {seconds:6.2f}",
                    flush=True,
                )


def _extrapolated(problem: Problem) -> Array:
    """Return friction's energy and the peak, by the reference method."""
    coarse, fine = (_measured(_reference(problem, ROW / parts)) for parts in (32, 64))
    extrapolated: Array = fine + (fine - coarse) / 3.0
    return extrapolated


def _runs(
    problem: Problem,
) -> Iterator[tuple[str, float, Callable[[], TimeHistory]]]:
    """Yield name, step and a march for each integrator."""
    for parts in PARTS:
        step = ROW / parts
        for scheme in SCHEMES:
            yield scheme.name, 1e6 * step, partial(_fixed, problem, scheme, step)
        yield "reference", 1e6 * step, partial(_reference, problem, step)
    for tolerance in TOLERANCES:
        options = MarchOptions(ROW, 1, tolerance)
        yield (
            f"tolerance {tolerance:.0e}",
            np.nan,
            partial(_whole, problem, SWEEP, options),
        )


def _fixed(problem: Problem, scheme: Scheme, step: float) -> TimeHistory:
    """March with steps of one scheme alone."""
    steps = round(SWEEP.duration / step)
    options = MarchOptions(step, round(ROW / step))
    marching = FastMarch(
        problem, SWEEP, options, steps, at_rest(problem), schemes=(scheme, scheme)
    )
    return marching.block(0, steps)


def _reference(problem: Problem, step: float) -> TimeHistory:
    options = MarchOptions(step, round(ROW / step), method="reference")
    return _whole(problem, SWEEP, options)


def _whole(problem: Problem, loads: LoadHistory, options: MarchOptions) -> TimeHistory:
    return joined(list(integrate(problem, loads, options, block=10.0)), "complete")


def _measured(history: TimeHistory) -> Array:
    return np.array(
        [history.of("friction")[-1], np.abs(history.displacement).max(axis=0)[0]]
    )


def _timed(run: Callable[[], TimeHistory]) -> tuple[Array, float]:
    """Return what a march measures and its seconds; not a number where it fails."""
    start = time.process_time()
    try:
        measured = _measured(run())
    except IntegrationError:
        measured = np.full(2, np.nan)
    return measured, time.process_time() - start


def whole() -> None:
    """Print the cost of the scene's whole sweep, and of one twice as long."""
    print("model       law      tolerance    s   twice as long  friction [J]")
    for law in ("coulomb", "gkf"):
        for model, changes in RIGS.items():
            scene = load_scene("two-blades", [*changes, f"friction.law={law}"])
            problem, options = problem_of(scene), MarchOptions(2.5e-5, 10, 1e-3)
            seconds, energies = [], []
            for slower in (1.0, 1.0, 2.0):
                loads = swept_sine(scene.sweep, slower=slower)
                start = time.process_time()
                history = _whole(problem, loads, options)
                seconds.append(time.process_time() - start)
                energies.append(history.of("friction")[-1])
            print(
                f"{model:11s} {law:8s} {options.tolerance:8.0e} {seconds[1]:7.2f}"
                f" {seconds[2]:9.2f} {energies[1]:18.6e}",
                flush=True,
            )


def per_point() -> None:
    """Print the cost of a step of the full rig over the number of contact points."""
    problem = problem_of(load_scene("two-blades"))
    print("points  us per step  us per step and point")
    for count in POINTS:
        made = _with_points(problem, count)
        options = MarchOptions(2.5e-5, 10)
        for _ in range(2):
            start = time.process_time()
            history = _whole(made, SWEEP, options)
            seconds = time.process_time() - start
        steps = SWEEP.duration / history.time_step
        cost = 1e6 * seconds / steps
        print(f"{count:6d} {cost:11.2f} {cost / count:14.3f}", flush=True)


def _with_points(problem: Problem, count: int) -> Problem:
    """Return the rig with other points: some of its own, or each of them in parts."""
    own, copies = problem.interface, -(-count // problem.interface.count)
    chosen = (
        np.array([0, 4])[:count]
        if count < own.count
        else np.repeat(np.arange(own.count), copies)
    )
    columns = {name: column[chosen] for name, column in own.points._asdict().items()}
    for name in ("stiffness", "damping"):
        columns[name] = columns[name] / copies
    rows = own.displacement.reshape(own.count, 3, -1)[chosen]
    names = tuple(f"{own.names[each]} {place}" for place, each in enumerate(chosen))
    interface = Interface(
        ContactPoints(**columns), rows.reshape(3 * len(chosen), -1), names
    )
    return dataclasses.replace(problem, interface=interface)


if __name__ == "__main__":
    main()
