"""Compare stability three ways: python tests/benchmarks/stability.py [variant …].

At 20 points and more of each variant's curve: multipliers of harmonic balance, those of
the time domain, and what a march makes of a small disturbance. The exit status is 1 if
routes differ by more than 1e-3, or if a march leaves what is stable or the reverse. A
march is not one of the truncated orbit: where it contradicts, next to a bifurcation,
the orbit is looked at again with more harmonics, and the most that were needed are
printed.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from hbm.curves.periodic_response import periodic_response, with_multipliers
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from small_motions.multipliers import floquet_multipliers, monodromy
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

MODELS = {
    "A": ["model=A"],
    "B": ["model=B"],
    "stiff": ["model=full", "contact.sigma=3e-9"],
    "soft": ["model=full", "contact.sigma=3e-7"],
}
VARIANTS = {
    f"{model}, {law}": [*values, f"friction.law={law}"]
    for model, values in MODELS.items()
    for law in ("coulomb", "gkf")
}
HERTZ = 2.0 * np.pi
LOWEST, HIGHEST = 133.5, 136.5
"""range of the curves [Hz]: resonance and both flanks"""
FULL, MOST = 31, 255
"""harmonics of the full model, and most of any: where its stiff contacts rattle, an
orbit with 15, whose amplitude is known to 1e-3, has multipliers that differ by 0.2 from
those of the march; on the soft one an amplitude known to 1e-3 takes 255, which few
points' stability needs"""
POINTS = 20
ACCEPTED = 1e-3
"""difference of the largest multipliers"""
LEADING = 4
"""multipliers that a march is compared in"""
PERIODS, STEPS = 20, 600
"""of a march, and its steps per period"""
MARCHED = 5e-3
"""error of a multiplier that a march shows"""
DISTURBANCE = 1e-6
"""of the orbit's size"""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One point of a curve seen by all three."""

    hertz: float
    harmonics: int
    balance: Array
    """moduli by harmonic balance, shape (LEADING,)"""
    march: Array
    """by a march of two neighbouring motions"""
    difference: float
    """of the largest modulus, harmonic balance against the time domain"""
    others: float
    """largest of the LEADING moduli's differences"""

    @property
    def agrees(self) -> bool:
        """Whether the largest multipliers of both routes are the same."""
        return self.difference <= ACCEPTED

    @property
    def kept(self) -> bool:
        """Whether the march leaves what is unstable, and nothing else."""
        predicted, seen = self.balance.max(), self.march.max()
        if (predicted > 1.0) == (seen > 1.0):
            return True
        return bool(max(abs(predicted - 1.0), abs(seen - predicted)) <= MARCHED)


def compared(problem: Problem, point: PeriodicResponse) -> Comparison:
    """Return one point seen by all three, with the harmonics that a march confirms."""
    rest = static_equilibrium(problem)
    seen = _seen(problem, point)
    while not seen.kept and point.harmonics < MOST:
        point = periodic_response(
            problem,
            rest,
            point,
            harmonics=2 * point.harmonics + 1,
            samples=2 * point.samples,
        )
        around = CurveOptions(
            HERTZ * LOWEST, HERTZ * HIGHEST, harmonics=point.harmonics
        )
        point = with_multipliers(problem, rest, point, around)
        seen = _seen(problem, point)
    return seen


def _seen(problem: Problem, point: PeriodicResponse) -> Comparison:
    """Return one orbit seen by harmonic balance, time domain and march."""
    other = np.abs(floquet_multipliers(problem, point, steps=1024).values)
    own = np.abs(point.multipliers)
    apart = np.abs(own[:LEADING] - other[:LEADING])
    return Comparison(
        point.frequency / HERTZ,
        point.harmonics,
        own[:LEADING],
        marched(problem, point),
        float(apart[0]),
        float(apart.max()),
    )


def marched(problem: Problem, point: PeriodicResponse) -> Array:
    """Return moduli of multipliers that a march of two motions shows, (LEADING,).

    One begins on the orbit, one beside it, along the leading eigenvectors; their
    difference after each period is seen along the left eigenvectors.
    """
    carried = monodromy(problem, point, steps=512)
    values, right = np.linalg.eig(carried)
    left = np.linalg.inv(right)
    order = np.argsort(-np.abs(values))[:LEADING]
    displacement, velocity = (each[0] for each in point.at(np.zeros(1)))
    size = np.abs(np.concatenate([displacement, velocity])).max()
    aside = right[:, order] / np.abs(right[:, order]).max(axis=0)
    away = DISTURBANCE * size * aside.sum(axis=1).real
    moved, moving = np.split(away, 2)
    first = _strobed(problem, point, Start(displacement, velocity))
    second = _strobed(problem, point, Start(displacement + moved, velocity + moving))
    seen = np.abs(np.vstack([away, second - first]) @ left[order].T)
    # what grows is taken until it is tenfold: the first march leaves the orbit, too
    fastest = max(float(np.abs(values).max()), 10.0 ** (1.0 / PERIODS))
    periods = max(1, round(np.log(10.0) / np.log(fastest)))
    grown: Array = (seen[periods] / seen[0]) ** (1.0 / periods)
    return grown


def _strobed(problem: Problem, point: PeriodicResponse, start: Start) -> Array:
    """Return (displacement, velocity) after each period, (PERIODS, 2 dofs)."""
    dofs = problem.structure.dofs
    names = tuple(str(place) for place in range(dofs))
    period = HERTZ / point.frequency
    history = joined(
        list(
            integrate(
                replace(problem, probes=Probes(names, np.eye(dofs))),
                Dwell(point.frequency, PERIODS * period),
                MarchOptions(period / STEPS, store_every=STEPS),
                start=start,
                block=PERIODS * period,
            )
        ),
        "complete",
    )
    return np.hstack([history.displacement, history.velocity])


def chosen(curve: list[PeriodicResponse], count: int) -> list[PeriodicResponse]:
    """Return points spread along a curve, with three or more of each unstable piece."""
    places = set(np.linspace(0, len(curve) - 1, count).round().astype(int).tolist())
    unstable = np.array([point.unstable > 0 for point in curve])
    edges = np.flatnonzero(np.diff(unstable.astype(int), prepend=0, append=0))
    for first, last in zip(edges[::2], edges[1::2], strict=True):
        places |= {int(first), int(first + last - 1) // 2, int(last) - 1}
    return [curve[place] for place in sorted(places)]


def traced(values: list[str]) -> tuple[Problem, list[PeriodicResponse]]:
    """Return the problem and the curve of a scene with some of its values given."""
    problem = problem_of(load_scene("two-blades", values))
    fixed = FULL if "model=full" in values else None
    options = CurveOptions(HERTZ * LOWEST, HERTZ * HIGHEST, harmonics=fixed)
    rest = static_equilibrium(problem)
    return problem, list(frequency_response(problem, rest, options))


def main(names: list[str]) -> int:
    """Print a row for each variant and each point that fails; return the status."""
    print(
        "variant         points  unstable  harmonics  routes     leading    march"
        "      verdict"
    )
    failed = False
    for name in names or VARIANTS:
        problem, curve = traced(VARIANTS[name])
        points = chosen(curve, POINTS)
        rows = [compared(problem, point) for point in points]
        wrong = [row for row in rows if not (row.agrees and row.kept)]
        failed |= bool(wrong)
        march = max(float(np.abs(row.march[0] - row.balance[0])) for row in rows)
        print(
            f"{name:15s} {len(rows):6d} {sum(p.unstable > 0 for p in points):9d}"
            f"  {max(row.harmonics for row in rows):9d}"
            f"  {max(row.difference for row in rows):.1e}"
            f"    {max(row.others for row in rows):.1e}    {march:.1e}"
            f"    {'differs' if wrong else 'agrees'}",
            flush=True,
        )
        for row in wrong:
            print(
                f"    {row.hertz:.4f} Hz: balance {row.balance.round(4)}, "
                f"march {row.march.round(4)}, routes {row.difference:.1e}"
            )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
