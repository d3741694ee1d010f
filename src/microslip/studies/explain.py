"""What a scene keeps and what it leaves out, counted on the problem itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hbm.active import extended, moving
from hbm.relative import relative_problem
from microslip.rigs import problem_of
from microslip.scene_file import Scene
from microslip_mechanics.contact.law import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    tangent_pattern,
)
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium

HARMONICS = 63
"""for which unknowns are counted where their number follows from the tolerance"""
FRICTION_LAWS = {
    COULOMB: "Coulomb",
    GENERAL_KINETIC: "GKF",
    FRICTIONLESS: "no friction",
}


@dataclass(frozen=True, slots=True)
class Pruned:
    """One thing of which a scene keeps only a part."""

    what: str
    kept: int
    whole: int
    reason: str


def pruned(scene: Scene) -> list[Pruned]:
    """Count what a scene's solvers carry, and of how much."""
    problem = problem_of(scene)
    dofs, points = problem.structure.dofs, problem.interface.points
    count = problem.interface.count
    _, selection = problem.interface.relative_motion()
    harmonics = scene.curve.harmonics or HARMONICS
    size = 2 * harmonics + 1
    entries = sum(
        int(pattern.sum())
        for point in range(count)
        for pattern in tangent_pattern(points, point)
    )
    rotations = "none locked" if scene.rig.model == "full" else "rotations locked"
    loads = int(np.sum(~points.constant_load & (points.friction != FRICTIONLESS)))
    return [
        Pruned(
            "degrees of freedom",
            dofs,
            _unlocked(scene),
            f"{rotations} ({scene.rig.model})",
        ),
        Pruned("springs to ground", int(_roped(scene)), 1, _rope_reason(scene)),
        Pruned("contact points", count, 8, f"four a face in full, here {count // 2}"),
        Pruned("variable normal loads of friction", loads, count, _load_reason(scene)),
        Pruned(
            "friction laws called", *_laws(problem), "only those of the scene's points"
        ),
        Pruned(
            "tangents per sample", entries, 18 * count, "the others are always zero"
        ),
        Pruned(
            "unknowns of a time step",
            len(selection),
            dofs,
            "relative motion of the faces; the structure is linear",
        ),
        Pruned(
            "coordinates of harmonic balance",
            len(selection),
            dofs,
            "the rest is condensed exactly, frequency by frequency",
        ),
        Pruned(
            f"unknowns of harmonic balance with {harmonics} harmonics",
            _active(problem, scene, harmonics),
            size * len(selection),
            "symmetry keeps the others at zero",
        ),
    ]


def _unlocked(scene: Scene) -> int:
    return 2 * 6 * scene.rig.blade.elements + 6


def _roped(scene: Scene) -> bool:
    return scene.rig.rope is not None and scene.rig.rope.stiffness > 0.0


def _rope_reason(scene: Scene) -> str:
    return "the rope" if _roped(scene) else "no rope in the scene: no spring"


def _load_reason(scene: Scene) -> str:
    if scene.rig.model == "A":
        return "friction uses the constant static load (A)"
    return "friction uses the computed normal force"


def _laws(problem: Problem) -> tuple[int, int]:
    used = set(problem.interface.points.friction.tolist()) - {FRICTIONLESS}
    return len(used), len(FRICTION_LAWS) - 1


def _active(problem: Problem, scene: Scene, harmonics: int) -> int:
    """Count the unknowns that move, at the curve's first frequency."""
    whole = relative_problem(problem, static_equilibrium(problem))
    active = moving(whole, 2.0 * np.pi * scene.curve.lowest)
    return int(extended(active, harmonics).sum())
