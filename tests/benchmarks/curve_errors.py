"""Are told errors of curves large enough? ``python …/curve_errors.py [name …]``.

Curves by tolerance: of the built-in scenes, of three masses with one law of the
catalogue each, of the rig with both laws, and of a lap joint by three drives. Points of
each, evenly spread, are solved again with twice their harmonics and samples, and no
less than :data:`HARMONICS` and :data:`SAMPLES`, at the same frequency; the relative
difference of the largest first harmonic is the true error; those of the energies that
friction and damping take out per period, and of the extremes of the normal force at the
contact that is covered least, are over the largest on the curve. A line for each:
points, the share whose told error covers the true one, the smallest and the median
ratio of told to true error where either is above :data:`DIGITS`, and the largest of
both. Points that have no such solution, as beyond a fold that more harmonics move, are
left out, and counted. The exit status is 1 if the told errors of amplitudes on a curve
by :data:`USUAL` cover less than :data:`LEAST`.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.append(str(Path(__file__).parents[1]))

import numpy as np

from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from honesty import amplitudes
from lap_joint import lap_joint
from law_examples import CASES, driven
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

HARMONICS, SAMPLES, CLOSE = 127, 4096, 1e-8
"""of the solution that tells the true error, at the least, and its tolerance"""
TOLERANCES, USUAL = (1e-2, 1e-3, 1e-4), 1e-3
POINTS = 25
"""of a curve, at the most"""
DIGITS = 1e-7
"""relative error below which nobody asks, a thousandth of the finest tolerance"""
LEAST = 0.95
AMPLITUDE = "amplitude"
WHAT = (AMPLITUDE, "friction", "damping", "force")
SCENES = {
    "duffing": ("duffing",),
    "gap": ("gap",),
    "stiff stop": ("gap", "element.stop.stiffness=1e6"),
    "jenkins slider": ("jenkins",),
    "tip-damper": ("tip-damper",),
    "friction-beam": ("friction-beam",),
    "chain": ("chain",),
    "bladed-disk": ("bladed-disk", "solve=disk"),
    **{
        f"rig {model} {law}": ("two-blades", f"model={model}", f"friction.law={law}")
        for model in ("A", "B", "full")
        for law in ("coulomb", "gkf")
    },
    "rig A sharp": ("two-blades", "model=A", "friction.threshold_velocity=1e-4"),
}
BETWEEN = (6.5, 8.9)
"""frequencies about the resonances of the three masses [rad/s]"""
JOINT, DRIVES = (26.3, 26.9), (0.5, 1.0, 2.0)
"""frequencies [Hz] about the first resonance of a bolted lap joint, at whose orders it
has modes, and drives of it [N]"""


@dataclass(frozen=True, slots=True)
class Case:
    """A problem and the range of its curve."""

    make: Callable[[], Problem]
    lowest: float
    """[rad/s]"""
    highest: float
    """[rad/s]"""
    tolerances: tuple[float, ...] = TOLERANCES


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of points of a curve."""

    told: Array
    true: Array
    unknown: int
    """points that no solution with more harmonics tells"""

    @property
    def covered(self) -> float:
        """Share of the points whose told error is large enough."""
        return float(np.mean(self.told + DIGITS >= self.true))

    @property
    def ratios(self) -> Array:
        """Told over true errors, where they matter."""
        matter = np.maximum(self.told, self.true) > DIGITS
        return self.told[matter] / np.maximum(self.true[matter], 1e-16)


def cases() -> dict[str, Case]:
    """Return all cases by name."""
    found = {}
    for name, (scene, *sets) in SCENES.items():
        curve = load_scene(scene, sets).curve
        found[name] = Case(
            partial(_of_scene, scene, tuple(sets)),
            2.0 * np.pi * curve.lowest,
            2.0 * np.pi * curve.highest,
        )
    found |= {name: Case(partial(driven, name), *BETWEEN) for name in CASES}
    lowest, highest = (2.0 * np.pi * hertz for hertz in JOINT)
    for drive in DRIVES:
        joint = partial(lap_joint, 5, 2e4, drive)
        found[f"lap joint {drive:g} N"] = Case(joint, lowest, highest, (USUAL,))
    return found


def _of_scene(scene: str, sets: tuple[str, ...]) -> Problem:
    return problem_of(load_scene(scene, sets))


def errors(case: Case, tolerance: float) -> dict[str, Errors]:
    """Return told and true errors of points of a curve, of amplitude and energies."""
    problem = case.make()
    rest = static_equilibrium(problem)
    options = CurveOptions(
        case.lowest, case.highest, error=tolerance, stability=False, contact_errors=True
    )
    # at an event no other solution has the same frequency
    curve = [
        each for each in frequency_response(problem, rest, options) if not each.event
    ]
    places = np.unique(np.linspace(0, len(curve) - 1, POINTS).round().astype(int))
    told, true = [], []
    for place in places:
        point = curve[place]
        try:
            better = periodic_response(
                problem,
                rest,
                point,
                harmonics=max(HARMONICS, 2 * point.harmonics + 1),
                samples=max(SAMPLES, 2 * point.samples),
                tolerance=CLOSE,
            )
        except ContinuationError:
            continue
        exact, found = amplitudes(problem, better), amplitudes(problem, point)
        off, off_told = _of_contacts(point, better)
        told.append([point.error, *off_told])
        true.append([np.abs(found - exact).max() / exact.max(), *off])
    sizes = 1.0, *np.max([_sizes(each) for each in curve], axis=0)
    columns = np.transpose(told), np.transpose(true), sizes, WHAT
    return {
        name: Errors(expected / size, missed / size, len(places) - len(told))
        for expected, missed, size, name in zip(*columns, strict=True)
        if size > 0.0 and not np.isnan(expected).any()
    }


def _of_contacts(point: PeriodicResponse, exact: PeriodicResponse) -> tuple[Array, ...]:
    """Return true and told errors of energies and of the force covered least."""
    off = [
        abs(getattr(point, name) - getattr(exact, name))
        for name in ("friction_energy", "damping_energy")
    ]
    forces = np.maximum(
        abs(point.normal_smallest - exact.normal_smallest),
        abs(point.normal_largest - exact.normal_largest),
    )
    worst = (forces - point.normal_error).argmax()
    told = point.friction_error, point.damping_error, point.normal_error[worst]
    return np.array([*off, forces[worst]]), np.array(told)


def _sizes(point: PeriodicResponse) -> tuple[float, float, float]:
    """Return energies and the largest normal force."""
    forces = np.abs([point.normal_smallest, point.normal_largest])
    return point.friction_energy, point.damping_energy, float(forces.max(initial=0.0))


def lines(chosen: Sequence[str]) -> Iterator[tuple[str, bool]]:
    """Yield the line of each curve, and whether it is as it should be."""
    for name, case in cases().items():
        if chosen and name not in chosen:
            continue
        for tolerance in case.tolerances:
            for what, seen in errors(case, tolerance).items():
                told = f"{name:30} {tolerance:9.0e} {what:9} {_line(seen)}"
                judged = tolerance == USUAL and what == AMPLITUDE
                yield told, not judged or seen.covered >= LEAST


def _line(seen: Errors) -> str:
    ratios = seen.ratios if seen.ratios.size else np.array([np.nan])
    return (
        f"{seen.told.size:6d} {seen.unknown:7d} {100.0 * seen.covered:5.0f} % "
        f"{ratios.min():9.2g} {np.median(ratios):7.3g} {seen.true.max():9.1e} "
        f"{seen.told.max():9.1e}"
    )


def main(chosen: Sequence[str]) -> int:
    """Print the table; return the exit status."""
    print(
        f"{'curve':30} tolerance {'of':9} points unknown  cover  smallest  median  "
        "largest true and told"
    )
    right = []
    for line, good in lines(chosen):
        print(line, flush=True)
        right.append(good)
    print(
        f"amplitudes of {right.count(False)} curves by {USUAL:g} are covered less than "
        f"{LEAST:.0%}"
    )
    return 0 if all(right) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
