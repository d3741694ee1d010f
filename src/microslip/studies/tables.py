"""The paper's Tables 4 and 5: dissipated energies of all variants of the rig."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.studies.sweep import march_whole, swept_sine
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium


@dataclass(frozen=True, slots=True)
class Variant:
    """A row of the tables."""

    name: str
    overrides: tuple[str, ...]
    paper: float
    """dissipated energy that the paper prints [J]; NaN for rows of our own"""


PAPER = (
    Variant("coulomb, full, stiff", (), 0.009),
    Variant("coulomb, full, soft", ("contact.sigma=3e-7",), 0.143),
    Variant("coulomb, B", ("model=B",), 0.148),
    Variant("coulomb, A", ("model=A",), 0.149),
    Variant("gkf, full, stiff", ("friction.law=gkf",), 0.014),
    Variant("gkf, full, soft", ("friction.law=gkf", "contact.sigma=3e-7"), 0.102),
    Variant("gkf, B", ("friction.law=gkf", "model=B"), 0.099),
    Variant("gkf, A", ("friction.law=gkf", "model=A"), 0.099),
)
SENSITIVITIES = (
    Variant("coulomb, full, stiff, fan 0", ("blade.fan=0 deg",), np.nan),
    Variant(
        "coulomb, full, stiff, V_lim 0.1 mm/s",
        ("friction.threshold_velocity=0.1 mm/s",),
        np.nan,
    ),
)


@dataclass(frozen=True, slots=True)
class Row:
    """What microslip finds for a variant."""

    variant: Variant
    energy: float
    """dissipated by friction over the whole history [J]"""
    half_step_change: float
    """change of the energy when the time step is halved, relative; NaN if not run"""
    closing_error: float
    """largest over the input energy"""
    seconds: float
    """run time of the march at the scene's time step [s]"""
    rest: np.ndarray
    """normal force of each point at rest [N]"""
    begin: float
    """of the drive [s]"""
    history: TimeHistory
    estimated: float
    """error of the energy by its march's steps, relative: the most that half the step
    ever changes, or twice the step if none is halved; NaN if there is no friction"""


def rows(source: str, variants: tuple[Variant, ...], *, halve: bool) -> Iterator[Row]:
    """Yield the rows; with ``halve`` each is marched again with half the time step."""
    for variant in variants:
        scene = load_scene(source, variant.overrides)
        start = time.perf_counter()
        history = _march(scene, 1.0, estimate=not halve)
        seconds = time.perf_counter() - start
        energy, change = float(history.of("friction")[-1]), float("nan")
        if halve:
            finer = _march(scene, 0.5, estimate=False)
            before, energy = energy, float(finer.of("friction")[-1])
            change = before / energy - 1.0
        closing = np.abs(history.closing_error).max() / history.of("input").max()
        rest = static_equilibrium(problem_of(scene)).normal_force
        told = _changed(history, finer) if halve else _estimated(history)
        found = energy, change, float(closing), seconds
        yield Row(variant, *found, rest, scene.sweep.start, history, told)


def _changed(history: TimeHistory, finer: TimeHistory) -> float:
    """Return by how much friction's energies ever differ, over the last one.

    At the end alone they may agree by chance.
    """
    friction = finer.of("friction")
    there = np.interp(history.time, finer.time, friction)
    away = float(np.abs(history.of("friction") - there).max())
    return away / abs(float(friction[-1])) if friction[-1] else float("nan")


def _estimated(history: TimeHistory) -> float:
    """Return the estimated error of friction's energy, relative; NaN without one."""
    if not history.energy_error.size or history.of("friction")[-1] == 0.0:
        return float("nan")
    return float(history.energy_error[-1] / abs(history.of("friction")[-1]))


def _march(scene: Scene, share: float, *, estimate: bool) -> TimeHistory:
    march = dataclasses.replace(scene.march, time_step=scene.march.time_step * share)
    sweep = swept_sine(scene.sweep)
    return march_whole(problem_of(scene), sweep, march, estimate=estimate)
