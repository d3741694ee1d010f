"""What a scene keeps and what it leaves out, counted on the problem itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hbm.active import extended, moving
from hbm.relative import relative_problem
from microslip.rigs import problem_of
from microslip.scene_file import Scene
from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.contact.law import (
    BRISTLE,
    COULOMB,
    ELASTIC,
    FRICTIONLESS,
    GENERAL_KINETIC,
    TANH,
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
    TANH: "smooth Coulomb",
    ELASTIC: "elastic friction",
    BRISTLE: "bristles",
}
LOADS = "friction uses the computed normal force, or a constant"


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
    rig = isinstance(scene.rig, TwoBlades)
    return [
        *(_rig(scene, problem) if rig else _system(scene, problem)),
        *_contacts(problem, _load_reason(scene) if rig else LOADS),
        *_unknowns(problem, scene),
    ]


def obeyed(scene: Scene) -> list[tuple[str, str, str]]:
    """Return name, law and equation of each element; none of a scene without them."""
    if isinstance(scene.rig, TwoBlades | BladedDisk):
        return []
    from microslip_mechanics.laws.catalogue import law_name

    return [
        (name, law_name(type(law)), str(type(law).__doc__).splitlines()[0])
        for name, law in scene.rig.element.items()
    ]


def _rig(scene: Scene, problem: Problem) -> list[Pruned]:
    """Count what the two-blade rig leaves out."""
    rotations = "none locked" if scene.rig.model == "full" else "rotations locked"
    count = problem.interface.count
    return [
        Pruned(
            "degrees of freedom",
            problem.structure.dofs,
            _unlocked(scene),
            f"{rotations} ({scene.rig.model})",
        ),
        Pruned("springs to ground", int(_roped(scene)), 1, _rope_reason(scene)),
        Pruned("contact points", count, 8, f"four a face in full, here {count // 2}"),
    ]


def _system(scene: Scene, problem: Problem) -> list[Pruned]:
    """Count what a system has, and what a reduction leaves of it."""
    dofs, count = problem.structure.dofs, problem.interface.count
    return [
        Pruned("degrees of freedom", dofs, *_whole(scene, problem)),
        Pruned("contact points", count, count, "rows that the elements' laws become"),
    ]


def _whole(scene: Scene, problem: Problem) -> tuple[int, str]:
    """Return a system's number of degrees of freedom, and how it became smaller."""
    made = None
    if not isinstance(scene.rig, BladedDisk):
        from microslip.scenes.systems.build import reduction

        made = reduction(scene.rig)
    if made is None:
        sparse = "sparse" if problem.structure.sparse else "dense"
        return problem.structure.dofs, f"all of the scene's; {sparse}"
    wanted, hertz = scene.rig.structure.reduction, scene.curve.highest
    return made.reduction.whole.dofs, (
        f"{wanted.method}, modes up to {wanted.highest:g} Hz: stiffness at what is "
        f"kept is off by {made.error(hertz):.1e} at {hertz:g} Hz"
    )


def _contacts(problem: Problem, why: str) -> list[Pruned]:
    """Count what the contacts' laws need."""
    points, count = problem.interface.points, problem.interface.count
    entries = sum(
        int(pattern.sum())
        for point in range(count)
        for pattern in tangent_pattern(points, point)
    )
    loads = int(np.sum(~points.constant_load & (points.friction != FRICTIONLESS)))
    return [
        Pruned("variable normal loads of friction", loads, count, why),
        Pruned(
            "friction laws called", *_laws(problem), "only those of the scene's points"
        ),
        Pruned(
            "tangents per sample", entries, 18 * count, "the others are always zero"
        ),
    ]


def _unknowns(problem: Problem, scene: Scene) -> list[Pruned]:
    """Count what the solvers solve for."""
    dofs = problem.structure.dofs
    _, selection = problem.interface.relative_motion()
    harmonics = scene.curve.harmonics or HARMONICS
    size = 2 * harmonics + 1
    return [
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
    return 2 * 6 * int(scene.rig.blade.elements) + 6


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
