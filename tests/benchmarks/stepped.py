"""A curve beside stepped time marching: run ``python tests/benchmarks/stepped.py``.

Marching at each frequency of the curve begins on the orbit of the point before, as in a
stepped sine, and ends when the amplitude is within the curve's tolerance of where it
settles, as far as the change from period to period tells. Steps per period are as many
as leave an error of that tolerance at the largest amplitude. Eight stable points of the
curve are marched; their mean stands for all. Times are of one thread's processor, warm.
The curve is timed with its multipliers and without them; marches have none, so that the
ratio is to the latter.
"""

from __future__ import annotations

import itertools
import os
import sys
import time
from collections.abc import Iterator
from dataclasses import replace

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from hbm.solve import frequency_response
from microslip.scenes.experiments import Curve
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import curve_options
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

MODELS, LAWS = ("A", "B", "full"), ("coulomb", "gkf")
TARGET = 100.0
"""marching over curve"""
SAMPLE = 8
ROWS = 32
"""stored per period"""
FEWEST_STEPS, MOST_STEPS = 32, 4096
"""per period"""
MOST_PERIODS = 4000


def main() -> int:
    """Print a row for each model and law; return the exit status."""
    print(
        "model  law      points  curve [s]  with multipliers  steps/period  periods"
        "  not settled"
        "  march [s/point]  marched curve [s]  ratio"
    )
    met = True
    for law in LAWS:
        for model in MODELS:
            met &= compared(model, law) >= TARGET
    print(f"ratios: marched over curve, the target is {TARGET:g}; {SAMPLE} points are")
    print("marched, their mean is multiplied by the number of points of the curve;")
    print(f"a point that has not settled after {MOST_PERIODS} periods counts as it is")
    print("all targets are met" if met else "a target is missed")
    return 0 if met else 1


def compared(model: str, law: str) -> float:
    """Print one row; return how many times longer marching takes."""
    scene = load_scene("two-blades", [f"model={model}", f"friction.law={law}"])
    problem, tolerance = problem_of(scene), scene.curve.tolerance
    responses, whole = timed(problem, scene.curve, stability=True)
    _, curve = timed(problem, scene.curve, stability=False)
    points = [each for each in responses if not each.event]
    pairs = spread(points)
    largest = int(np.argmax([amplitude(problem, each) for _, each in pairs]))
    steps = enough_steps(problem, *pairs[largest], tolerance)
    start = time.process_time()
    settled = [settle(problem, *pair, steps, tolerance) for pair in pairs]
    march = (time.process_time() - start) / len(pairs)
    periods = float(np.mean([count for count, _ in settled]))
    late = sum(count >= MOST_PERIODS for count, _ in settled)
    ratio = march * len(points) / curve
    print(
        f"{model:5s}  {law:7s} {len(points):7d} {curve:10.3f} {whole:17.3f} {steps:13d}"
        f" {periods:8.0f} {late:12d} {march:16.3f} {march * len(points):18.1f}"
        f" {ratio:6.0f}",
        flush=True,
    )
    return ratio


def timed(
    problem: Problem, curve: Curve, *, stability: bool
) -> tuple[list[PeriodicResponse], float]:
    """Return a curve and the processor time that it takes warm [s]."""
    options = replace(curve_options(curve), stability=stability)

    def traced() -> list[PeriodicResponse]:
        return list(frequency_response(problem, static_equilibrium(problem), options))

    traced()  # compiles
    start = time.process_time()
    return traced(), time.process_time() - start


Pair = tuple[PeriodicResponse, PeriodicResponse]
"""where a march begins, and the response that it looks for"""


def spread(points: list[PeriodicResponse]) -> list[Pair]:
    """Return stable points spread evenly over the curve, each after its neighbour."""
    stable = [
        (before, after)
        for before, after in itertools.pairwise(points)
        if before.unstable == after.unstable == 0
    ]
    places = np.linspace(0, len(stable) - 1, SAMPLE).round().astype(int)
    return [stable[place] for place in places]


def amplitude(problem: Problem, response: PeriodicResponse) -> float:
    """Return the largest first-harmonic amplitude of a probe [m]."""
    seen = response.seen(problem.probes.rows)
    return float(np.hypot(seen[1], seen[2]).max())


def enough_steps(
    problem: Problem,
    before: PeriodicResponse,
    wanted: PeriodicResponse,
    tolerance: float,
) -> int:
    """Return the steps per period from which on twice as many change little."""
    steps = FEWEST_STEPS
    _, coarse = settle(problem, before, wanted, steps, tolerance)
    while steps < MOST_STEPS:
        _, fine = settle(problem, before, wanted, 2 * steps, tolerance)
        if abs(fine - coarse) <= tolerance * fine:
            return steps
        steps, coarse = 2 * steps, fine
    return steps


def settle(
    problem: Problem,
    before: PeriodicResponse,
    wanted: PeriodicResponse,
    steps: int,
    tolerance: float,
) -> tuple[int, float]:
    """Return the number of periods until the amplitude settles, and where [m].

    Successive changes that shrink by a ratio r leave r / (1 − r) of the last one. The
    ratio is taken over several periods, the largest of them, for transients beat.
    """
    history: list[float] = []
    for size in periods(problem, before, wanted.frequency, steps):
        history.append(size)
        changes = np.abs(np.diff(history[-25:]))
        if changes.size < 24:
            continue
        early, late = changes[:12].max(), changes[12:].max()
        ratio = min((late / early) ** (1.0 / 12.0), 0.9999) if early > 0.0 else 0.0
        if late * ratio / (1.0 - ratio) <= tolerance * size:
            break
    return len(history), history[-1]


def periods(
    problem: Problem, before: PeriodicResponse, frequency: float, steps: int
) -> Iterator[float]:
    """Yield the largest amplitude of a probe in each period of a march [m]."""
    period = 2.0 * np.pi / frequency
    displacement, velocity = before.at(np.zeros(1))
    phase = 2.0 * np.pi * np.arange(1, ROWS + 1) / ROWS
    rotation = np.exp(-1j * phase) * 2.0 / ROWS
    for block in integrate(
        problem,
        Dwell(frequency, MOST_PERIODS * period),
        MarchOptions(period / steps, store_every=steps // ROWS),
        start=Start(displacement[0], velocity[0]),
        block=period,
    ):
        yield float(np.abs(rotation @ block.displacement).max())


if __name__ == "__main__":
    sys.exit(main())
