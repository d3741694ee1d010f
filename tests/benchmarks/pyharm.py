"""microslip beside pyHarm-os: run ``python tests/benchmarks/pyharm.py``.

pyHarm-os 1.2.2 has requirements of its own, so it runs in an environment of its own:
``--pyharm PYTHON`` names the interpreter of one that is there; without it a temporary
one is made from the package index. Both sides are given the same matrices, elements,
loads, harmonics and samples, and run in turn on one thread; times are of the processor
per accepted point, warm. pyHarm solves each curve by all of its solvers that are named
here, and the fastest counts. Events are located on microslip's curves, Floquet
multipliers and errors are not computed. At pyHarm's points microslip solves anew, and
amplitudes are compared. Exit status 1 if a target is missed or amplitudes differ.
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import json
import os
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from benchmarks.pyharm_cases import Case, Evaluation, blisk, chain, contacts, duffing
from benchmarks.pyharm_side import median
from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

PACKAGE = "pyharm-os==1.2.2"
REPEATS = 3
CLOSE = 1e-4
"""largest relative difference of amplitudes; pyHarm stops at residuals of about 1e-8"""
TARGETS = {"duffing": 4.0, "chain": 10.0, "blisk": 30.0, "contacts": 100.0}
CASES = {"duffing": duffing, "chain": chain, "blisk": blisk}
ONE_THREAD = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1",
}


def main() -> int:
    """Print a row for each system; return the exit status."""
    parser = argparse.ArgumentParser(description="microslip beside pyHarm-os")
    parser.add_argument("--pyharm", type=Path, metavar="PYTHON")
    parser.add_argument("--only", nargs="+", choices=TARGETS, default=list(TARGETS))
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        python = given.pyharm or installed(Path(folder))
        print(
            "system     microslip [ms]  pyHarm [ms]   ratio  target  difference"
            "  points  pyHarm: solver, points, tried, end"
        )
        met = [row(name, python, Path(folder)) for name in given.only]
    print("all targets are met" if all(met) else "a target is missed")
    return 0 if all(met) else 1


def installed(folder: Path) -> Path:
    """Return the interpreter of a new environment with pyHarm."""
    venv.create(folder / "pyharm", with_pip=True)
    python = folder / "pyharm" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", PACKAGE], check=True)
    return python


def answered(python: Path, folder: Path, case: dict[str, Any]) -> dict[str, Any]:
    """Return what pyHarm makes of a case; it may write settings into ``folder``."""
    side = Path(__file__).parent / "pyharm_side.py"
    done = subprocess.run(
        [python, side],
        input=json.dumps([case]),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        cwd=folder,
        env={**os.environ, **ONE_THREAD, "HOME": str(folder), "PYTHONPATH": ""},
    )
    (answer,) = json.loads(done.stdout)
    return dict(answer)


def row(name: str, python: Path, folder: Path) -> bool:
    """Print what one system shows; return whether it is as good as wanted."""
    if name == "contacts":
        own, other, difference, text = evaluated(python, folder, contacts())
    else:
        own, other, difference, text = traced(python, folder, CASES[name]())
    ratio = other / own
    print(
        f"{name:9s} {1e3 * own:15.3f} {1e3 * other:12.3f} {ratio:7.1f}"
        f" {TARGETS[name]:7g} {difference:11.1e}  {text}",
        flush=True,
    )
    return ratio >= TARGETS[name] and difference <= CLOSE


Measured = tuple[float, float, float, str]
"""seconds of both sides, difference of amplitudes, more about it"""


def traced(python: Path, folder: Path, case: Case) -> Measured:
    """Return what a curve costs per point."""
    options = CurveOptions(
        case.lowest,
        case.highest,
        harmonics=case.harmonics,
        samples=case.samples,
        stability=False,
        errors=False,
    )
    rest = static_equilibrium(case.problem)
    curve = list(frequency_response(case.problem, rest, options))  # compiles
    points = [point for point in curve if not point.event]
    spent = []
    for _ in range(REPEATS):
        began = time.process_time()
        list(frequency_response(case.problem, rest, options))
        spent.append(time.process_time() - began)
    other = answered(python, folder, case.told(REPEATS))
    apart, lost = deviation(case, points, np.array(other["curve"]))
    return (
        float(np.median(spent)) / len(points),
        other["seconds"],
        apart,
        f"{len(points):6d}  {other['solver']}, {other['points']}, {other['tried']}"
        f", to {other['reached']:.2f} rad/s; {lost} of them not found again",
    )


def deviation(
    case: Case, points: list[PeriodicResponse], curve: Array
) -> tuple[float, int]:
    """Return the largest difference of amplitudes at pyHarm's points, over the largest.

    microslip solves anew at each of them within the range; the second number counts
    those where it finds no response beside pyHarm's.
    """
    shape = (-1, 2 * case.harmonics + 1, case.problem.structure.dofs)
    waves, frequencies = curve[:, :-1].reshape(shape), curve[:, -1]
    largest = float(np.hypot(waves[:, 1], waves[:, 2]).max())
    rest, found, lost = static_equilibrium(case.problem), [0.0], 0
    for wave, frequency in zip(waves, frequencies, strict=True):
        if case.lowest <= frequency <= case.highest:
            guess = dataclasses.replace(
                points[0], frequency=frequency, coefficients=wave
            )
            try:
                own = periodic_response(
                    case.problem,
                    rest,
                    guess,
                    harmonics=case.harmonics,
                    samples=case.samples,
                    tolerance=1e-10,
                ).coefficients
            except ContinuationError:
                lost += 1
                continue
            change = np.hypot(own[1], own[2]) - np.hypot(wave[1], wave[2])
            found.append(float(np.abs(change).max()) / largest)
    return max(found), lost


def evaluated(python: Path, folder: Path, case: Evaluation) -> Measured:
    """Return what one residual and Jacobian cost.

    pyHarm's are those of the whole structure, microslip's those that the contacts see:
    its residual is the load on them, its Jacobian the inverse of their flexibility.
    """
    problem = case.problem
    relative = relative_problem(problem, static_equilibrium(problem))
    balance = HarmonicBalance(relative, FourierBasis(case.harmonics, case.samples))
    point = balance.point(case.motion @ relative.selection.T, case.frequency)
    turn = itertools.count()

    def run() -> tuple[Array, Array]:
        point[-1] = case.frequency * (1.0 + 1e-3 * (next(turn) % 2))  # as on a curve
        residual, linearised = balance(point)
        return residual, linearised.jacobian

    run()
    own = median(run, 2 * REPEATS + 1)
    point[-1] = case.frequency
    residual, linearised = balance(point)
    told = case.told(balance.motion(point), REPEATS)
    seconds = answered(python, folder, told)["seconds"]
    seen = np.kron(np.eye(len(case.motion)), relative.selection)
    force = np.load(folder / "residual.npy")
    apart = np.abs(seen.T @ residual - force).max() / np.abs(force).max()
    flexible = seen @ np.linalg.solve(np.load(folder / "jacobian.npy"), seen.T)
    one = np.abs(flexible @ linearised.jacobian - np.eye(len(seen))).max()
    return own, seconds, max(float(apart), float(one)), f"{seen.shape} unknowns"


if __name__ == "__main__":
    sys.exit(main())
