"""Are told errors of marches large enough? ``python …/step_errors.py [name …]``.

Sweeps and dwells at several steps, by both methods, and by tolerances: of three masses
with one law of the catalogue each, of one or two masses on stiffer contacts, and of the
rig. A march of
:data:`FINEST` steps per period tells the true error of friction's energy and of the
largest amplitude, at the rows that all marches share; one of half as many tells how
true that is. A line for each system, method and quantity: how many of the told errors
cover the true one, and the largest true error over the told one, with its load and
steps. Marches whose truth is not known to a tenth of either error are left out, and
counted. The exit status is 1 if the told errors cover less than :data:`LEAST` of all.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from law_examples import CASES, driven
from memory_problems import DAHL, JENKINS, LUGRE, SHOE, masses
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.element import Element
from microslip_mechanics.laws.gkf import GeneralKineticFriction
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.loads.excitation import Dwell, LoadHistory, SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import cubic_oscillator, marched
from timedomain.integrate import MarchOptions
from timedomain.options import Method
from timedomain.record.start import loaded

Way = Literal["fast", "reference", "tolerance"]
"""by which a march is made"""
ROWS = 25
"""per period, at which marches are compared"""
STEPS = (50, 100, 200, 400)
"""per period of the marches that tell errors"""
TOLERANCES = (1e-2, 1e-3, 1e-4)
FINEST = 6400
SHARE = 0.1
"""of the larger error, to which the truth must be known"""
DIGITS = 1e-9
"""relative error that counts as rounding, or as what Newton's iteration leaves"""
LEAST = 0.95
CYCLES = 15.0
"""of each march"""


@dataclass(frozen=True, slots=True)
class Case:
    """A system, and the frequency about which it is driven."""

    problem: Problem
    hertz: float


@dataclass(frozen=True, slots=True)
class Comparison:
    """Relative errors of one march."""

    where: str
    """load and steps"""
    true: float
    unknown: float
    """by which the truth may be wrong"""
    told: float

    @property
    def known(self) -> bool:
        """Whether the truth is, and is more than rounding."""
        larger = max(self.true, self.told)
        return larger > DIGITS and self.unknown <= SHARE * larger

    @property
    def ratio(self) -> float:
        """The true error over the told one."""
        return self.true / self.told if self.told > 0.0 else np.inf


def cases() -> dict[str, Case]:
    """Return the systems by name."""
    found = {f"3 masses, {name}": Case(driven(name), 1.23) for name in CASES}
    tangent, both = np.eye(3)[:, 1:2], np.eye(3)[:, [1, 0]]
    for name, law in (("jenkins", JENKINS), ("dahl", DAHL), ("lugre", LUGRE)):
        found[f"mass, {name}"] = Case(masses(law, tangent, np.array([0.35])), 1.0)
    shoe = masses(SHOE, both, np.array([0.3, 0.6]))
    found["2 masses, lifting shoe"] = Case(shoe, 1.0)
    found["duffing"] = Case(cubic_oscillator(drive=0.3, damping=0.1), 0.25)
    for name, element in stiff().items():
        found[f"2 masses, {name}"] = Case(chain(element), 5.0)
    for model, friction in (("A", "gkf"), ("B", "gkf"), ("full", "coulomb")):
        rig = rig_problem(model=model, friction__law=friction)
        found[f"rig {model}, {friction}"] = Case(rig, 136.0)
    return found


def stiff() -> dict[str, Element]:
    """Return friction that turns over within a step, and a stop."""
    falling = {"load": 1.0, "mu_dynamic": 0.2, "mu_static": 0.5}
    stop = UnilateralSpring(stiffness=1e5, gap=2e-3, damping=5.0)
    found = {"hard stop": Element(stop, between=("x1", "ground"))}
    laws = {
        f"gkf {threshold:g}": GeneralKineticFriction(
            **falling, stribeck_velocity=0.1, threshold_velocity=threshold
        )
        for threshold in (1e-3, 1e-5)
    }
    slides = [("x1", "ground")]
    found |= {name: Element(law, tangents=slides) for name, law in laws.items()}
    found["rigid"] = Element(RigidCoulomb(load=1.0, mu=0.5), tangents=slides)
    return found


def chain(element: Element) -> Problem:
    """Return two masses on springs, of 5 and 7 Hz, and an element at the first."""
    return system(
        mass=[1.0, 1.0],
        stiffness=[[1500.0, -500.0], [-500.0, 1500.0]],
        damping_ratio=0.01,
        elements=[element],
        drive={"x1": 1.0},
    )


def histories(hertz: float) -> Iterator[tuple[str, LoadHistory]]:
    """Yield sweeps both ways and dwells."""
    end = CYCLES / hertz
    low, high = 0.8 * hertz, 1.2 * hertz
    yield "up", SweptSine(0.0, 0.0, end, end, low, high)
    yield "down", SweptSine(0.0, 0.0, end, end, high, low)
    for share in (0.9, 1.0, 1.1):
        yield f"dwell at {share:g}", Dwell(2.0 * np.pi * share * hertz, end)


def compared(case: Case, method: Way) -> Iterator[tuple[str, Comparison]]:
    """Yield told and true errors of a system's marches, with what they are of."""
    for load, history in histories(case.hertz):
        fine, swing = march(case, history, equal(case, FINEST, method))
        other, close = march(case, history, equal(case, FINEST // 2, method))
        energy, size = fine.of("friction")[-1], swing.max()
        unknown = abs(other.of("friction")[-1] - energy)
        apart = np.abs(close - swing).max() / size
        for name, options in trials(case, method):
            told, moved = march(case, history, replace(options, estimate=True))
            where = f"{load}, {name}"
            away = np.abs(moved - swing).max() / size
            yield "peak", Comparison(where, away, apart, told.peak_error[-1])
            if energy > 0.0:
                away = abs(told.of("friction")[-1] - energy) / energy
                claimed = told.energy_error[-1] / energy
                yield "energy", Comparison(where, away, unknown / energy, claimed)


def trials(case: Case, method: Way) -> Iterator[tuple[str, MarchOptions]]:
    """Yield the marches that tell errors."""
    if method != "tolerance":
        for steps in STEPS:
            yield f"{steps} steps", equal(case, steps, method)
        return
    for tolerance in TOLERANCES:
        step = 1.0 / (ROWS * case.hertz)
        yield f"tolerance {tolerance:g}", MarchOptions(step, 1, tolerance)


def equal(case: Case, steps: int, method: Way) -> MarchOptions:
    """Return those of so many steps per period; fast ones tell what tolerances are."""
    made: Method = "reference" if method == "reference" else "fast"
    return MarchOptions(1.0 / (steps * case.hertz), steps // ROWS, method=made)


def march(
    case: Case, history: LoadHistory, options: MarchOptions
) -> tuple[TimeHistory, Array]:
    """Return a march and half the way between each probe's extremes [m], (probes,)."""
    problem, begin = case.problem, loaded(case.problem, history)
    block = history.duration
    found = marched(problem, history, options, start=begin, block=block)
    rest = problem.probes.rows @ begin.displacement
    rows = np.vstack([rest, found.displacement])
    return found, np.ptp(rows, axis=0) / 2.0


def methods(case: Case) -> tuple[Way, ...]:
    """Return the methods that march a system."""
    if beyond_motion(case.problem.interface.points):
        return ("reference",)
    return ("fast", "reference", "tolerance")


def line(name: str, rows: Sequence[Comparison]) -> str:
    """Return what a line says of such comparisons."""
    known = [row for row in rows if row.known]
    if not known:
        return f"{name}: none of {len(rows)} known"
    worst = max(known, key=lambda row: row.ratio)
    return (
        f"{name} {sum(row.ratio <= 1.0 for row in known):3d} of {len(known):3d}, "
        f"{len(rows) - len(known)} unknown, worst {worst.ratio:.2f} = {worst.true:.1e} "
        f"/ {worst.told:.1e} ({worst.where})"
    )


def main(names: list[str]) -> int:
    """Print lines as they come; return the exit status."""
    every: dict[str, list[Comparison]] = {"peak": [], "energy": []}
    systems = cases()
    for name in names or systems:
        for method in methods(systems[name]):
            found: dict[str, list[Comparison]] = {"peak": [], "energy": []}
            for what, comparison in compared(systems[name], method):
                found[what].append(comparison)
            for what, rows in found.items():
                every[what] += rows
                if rows:
                    print(line(f"{name:35s} {method:9s} {what:6s}", rows), flush=True)
    for what, rows in every.items():
        print(line(f"all {what}", rows))
    known = [row for rows in every.values() for row in rows if row.known]
    covered = sum(row.ratio <= 1.0 for row in known)
    return 0 if covered >= LEAST * len(known) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
