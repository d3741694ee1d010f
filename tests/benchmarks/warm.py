"""Time curve and sweep of each model, warm: python tests/benchmarks/warm.py.

Seconds are this machine's, on this day; the ratios beside them carry further. Each pair
is run in turn, three times, and the median is printed. The last column is how many
times as long a sweep takes by tolerance if another beside it tells its errors.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import trace_curve
from microslip.studies.sweep import march_sweep, marched, swept_sine

MODELS = ("A", "B", "full")


def main() -> None:
    """Print a row for each model and law."""
    print("model  law       curve [s]  8 harmonics [s]  sweep [s]  sweep/curve  told")
    for law in ("coulomb", "gkf"):
        for model in MODELS:
            scene = load_scene("two-blades", [f"model={model}", f"friction.law={law}"])
            coarse = load_scene(
                "two-blades",
                [f"model={model}", f"friction.law={law}", "curve.harmonics=8"],
            )
            told = [_tolerant(scene, estimate=each) for each in (False, True)]
            runs = (_curve(scene), _curve(coarse), _sweep(scene), *told)
            for run in runs:
                run()
            rounds = [[_seconds(run) for run in runs] for _ in range(3)]
            curve, eight, sweep, alone, both = (
                statistics.median(column) for column in zip(*rounds, strict=True)
            )
            print(
                f"{model:5s}  {law:8s} {curve:10.3f} {eight:16.3f} {sweep:10.2f}"
                f" {sweep / curve:12.1f} {both / alone:5.2f}",
                flush=True,
            )


def _curve(scene: Scene) -> Callable[[], object]:
    problem = problem_of(scene)
    return lambda: trace_curve(problem, scene.curve)


def _sweep(scene: Scene) -> Callable[[], object]:
    problem, sweep = problem_of(scene), swept_sine(scene.sweep)
    return lambda: march_sweep(problem, sweep, scene.march)


def _tolerant(scene: Scene, *, estimate: bool) -> Callable[[], object]:
    problem, sweep = problem_of(scene), swept_sine(scene.sweep)
    return lambda: list(
        marched(problem, sweep, scene.march, tolerance=1e-3, estimate=estimate)
    )


def _seconds(run: Callable[[], object]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
