"""What pruning saves on the rig: python tests/benchmarks/pruning.py [HARMONICS ...].

Each row is one curve with fixed harmonics, in processor time: the scene as it is, the
same scene through the unknowns and kernels of the full model with nothing left out, and
the full model itself, pruned, with other motions. The rows after it are the adaptive
curve of model A and the same in its own six coordinates, all orders and whole periods.
"""

from __future__ import annotations

import os
import sys
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import trace_curve
from microslip.studies.explain.unpruned import (
    difference,
    path_of,
    timed,
    unpruned_path_of,
)

MODELS = ("A", "B", "full")


def main() -> None:
    """Print a row for each model and number of harmonics."""
    print(
        "model  harmonics  unknowns  pruned [s]  unknowns  unpruned [s]   ratio  apart"
    )
    for harmonics in [int(word) for word in sys.argv[1:]] or [15, 31]:
        for model in MODELS:
            _fixed(model, harmonics)
    _adaptive()


def _fixed(model: str, harmonics: int) -> None:
    """Print the row of one model with fixed harmonics."""
    scene = load_scene("two-blades", [f"model={model}", f"curve.harmonics={harmonics}"])
    counts = [
        int(each.mask(harmonics).sum())
        for each in (path_of(scene), unpruned_path_of(scene))
    ]
    some, every = timed(scene)
    print(
        f"{model:5s} {harmonics:10d} {counts[0]:9d} {some.seconds:11.2f} "
        f"{counts[1]:9d} {every.seconds:13.2f} {every.seconds / some.seconds:7.1f}  "
        f"{difference(some, every):.1e}",
        flush=True,
    )


def _adaptive() -> None:
    """Print what the curve of model A costs at its tolerance, with and without."""
    scene = load_scene("two-blades", ["model=A"])
    spent = []
    for pruned in (True, False):
        began = time.process_time()
        traced = trace_curve(problem_of(scene), scene.curve, pruned=pruned)
        spent.append(time.process_time() - began)
        print(
            f"A at its tolerance, {'' if pruned else 'un'}pruned: {spent[-1]:.1f} s, "
            f"up to {traced.curve.harmonics.max():.0f} harmonics",
            flush=True,
        )
    print(f"ratio {spent[1] / spent[0]:.1f}")


if __name__ == "__main__":
    main()
