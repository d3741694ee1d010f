"""What a scene keeps and what it leaves out, counted on the problem itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hbm.fourier import FourierBasis
from hbm.path import AlongFrequency
from microslip.rigs import problem_of, sector_of, unpruned_of
from microslip.scene_tables import Scene
from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.imported import FRC, imported
from microslip.studies.unpruned import path_of, unpruned_path_of
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import (
    BRISTLE,
    COULOMB,
    ELASTIC,
    FRICTIONLESS,
    GENERAL_KINETIC,
    RIGID,
    TANH,
)
from microslip_mechanics.problem import Problem

if TYPE_CHECKING:
    from microslip_mechanics.reduced_problem import ReducedProblem

HARMONICS = 63
"""for which unknowns are counted where their number follows from the tolerance"""
FRICTION_LAWS = {
    COULOMB: "Coulomb",
    GENERAL_KINETIC: "GKF",
    FRICTIONLESS: "no friction",
    TANH: "smooth Coulomb",
    ELASTIC: "elastic friction",
    BRISTLE: "bristles",
    RIGID: "rigid Coulomb",
}
EVALUATED = (
    (
        "moments evaluated of {} samples",
        "the second half of a period mirrors the first",
    ),
    ("calls of the contact law", "of all contact points, for one residual"),
    ("tangents at a moment", "the others are always zero"),
)
"""what a residual evaluates, and why not all of it"""
LOADS = "friction uses the computed normal force, or a constant"


@dataclass(frozen=True, slots=True)
class Pruned:
    """One thing of which a scene keeps only a part."""

    what: str
    kept: int
    whole: int
    """what there is without pruning"""
    reason: str


def pruned(scene: Scene) -> list[Pruned]:
    """Count what a scene's solvers carry, and what they would without pruning."""
    sector, made = sector_of(scene), _reduced(scene)
    if made is not None:
        problem = whole = made.problem
    else:
        problem = problem_of(scene) if sector is None else sector.standing()
        whole = unpruned_of(scene)
    why = _load_reason(scene) if isinstance(scene.rig, TwoBlades) else LOADS
    return [
        *_structure(scene, problem, whole, made),
        *_contacts(problem, why),
        # one sector cannot be marched
        _step(problem if sector is None else whole),
        *_unknowns(path_of(scene, problem), unpruned_path_of(scene, whole), scene),
        *_code(),
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


def _reduced(scene: Scene) -> ReducedProblem | None:
    """Return the reduced problem of a scene that asks for one."""
    if isinstance(scene.rig, TwoBlades | BladedDisk):
        return None
    from microslip.scenes.systems.build import reduction

    return reduction(scene.rig)


def _structure(
    scene: Scene, problem: Problem, whole: Problem, made: ReducedProblem | None
) -> Iterator[Pruned]:
    """Count what a kind of scene leaves out of its structure."""
    dofs, most = problem.structure.dofs, whole.structure.dofs
    count, points = problem.interface.count, whole.interface.count
    if isinstance(scene.rig, TwoBlades):
        yield Pruned("degrees of freedom", dofs, _unlocked(scene), _locked(scene))
        roped = _roped(scene)
        yield Pruned("springs to ground", int(roped), 1, _rope_reason(roped))
        why = f"four a face in full, here {count // 2}"
        yield Pruned("contact points", count, points, why)
        return
    sector = sector_of(scene)
    if sector is not None:
        yield Pruned("sectors", 1, sector.sectors, "the others move like it, later")
        yield Pruned("degrees of freedom", dofs, most, "those of one sector")
    else:
        yield Pruned("degrees of freedom", dofs, *_whole(scene, problem, made))
    why = "rows that the elements' laws become"
    yield Pruned("contact points", count, points, why)


def _whole(
    scene: Scene, problem: Problem, made: ReducedProblem | None
) -> tuple[int, str]:
    """Return a system's number of degrees of freedom, and how it became smaller."""
    if made is None:
        sparse = "sparse" if problem.structure.sparse else "dense"
        return problem.structure.dofs, f"all of the scene's; {sparse}"
    wanted, hertz = scene.rig.structure.reduction, scene.curve.highest
    return made.reduction.whole.dofs, (
        f"{wanted.method}, modes up to {wanted.highest:g} Hz: stiffness at what is "
        f"kept is off by {made.error(hertz):.1e} at {hertz:g} Hz"
    )


def _contacts(problem: Problem, why: str) -> Iterator[Pruned]:
    """Count what the contacts' laws need."""
    points, count = problem.interface.points, problem.interface.count
    loads = int(np.sum(~points.constant_load & (points.friction != FRICTIONLESS)))
    yield Pruned("variable normal loads of friction", loads, count, why)
    why = "only those of the scene's points"
    yield Pruned("friction laws called", *_laws(problem), why)
    yield from _stuck(problem)


def _stuck(problem: Problem) -> Iterator[Pruned]:
    """Say by what rule the position of stuck contacts is fixed."""
    points = problem.interface.points
    count = int(np.sum(remembers(points) | (points.friction == RIGID)))
    if count:
        rule = "zero: it fixes the mean position of a contact that never slides"
        yield Pruned("mean friction of stuck contacts", 0, count, rule)


def _step(problem: Problem) -> Pruned:
    """Count what a time step solves for."""
    _, selection = problem.interface.relative_motion()
    why = "relative motion of the faces; the structure is linear"
    dofs = problem.structure.dofs
    return _part("unknowns of a time step", len(selection), dofs, why)


def _unknowns(
    path: AlongFrequency, whole: AlongFrequency, scene: Scene
) -> Iterator[Pruned]:
    """Count what harmonic balance solves for, and what it evaluates for that."""
    why = "relative motions that move; the structure is condensed exactly"
    yield _part("coordinates of harmonic balance", path.rank, whole.rank, why)
    harmonics = scene.curve.harmonics or HARMONICS
    samples = scene.curve.samples or 16 * (harmonics + 1)
    one, every = (each.mask(harmonics) for each in (path, whole))
    why = "symmetry keeps the others at zero"
    name = f"orders of {harmonics} harmonics and the mean"
    yield _part(name, _orders(one), _orders(every), why)
    name = f"unknowns of harmonic balance with {harmonics} harmonics"
    yield _part(name, int(one.sum()), int(every.sum()), why)
    fourier = FourierBasis(harmonics, samples)
    evaluated = zip(*(_evaluated(each, fourier) for each in (path, whole)), strict=True)
    for (name, why), (some, most) in zip(EVALUATED, evaluated, strict=True):
        yield _part(name.format(samples), some, most, why)


def _part(what: str, kept: int, whole: int, why: str) -> Pruned:
    """Return what is kept, and why, if not all of it."""
    return Pruned(what, kept, whole, why if kept < whole else "all are needed")


def _orders(mask: np.ndarray) -> int:
    """Return how many orders move, the mean among them."""
    return int(mask[0].any()) + int(mask[1::2].any(axis=1).sum())


def _evaluated(path: AlongFrequency, fourier: FourierBasis) -> tuple[int, int, int]:
    """Return moments in a period, calls of the law in all, and tangents at a moment."""
    contact = path.problem.contact(fourier)
    halved = contact.symmetry.signs.size > 0
    moments = fourier.samples // 2 if halved else fourier.samples
    points = int(contact.points.load.size)
    return moments, moments * points, len(contact.tangents.samples)


def _code() -> Iterator[Pruned]:
    """Count what frc loads of all code."""
    some, every = imported(FRC), imported(())
    why = "those of frc; what another command needs is loaded by it"
    yield Pruned("modules loaded", some.modules, every.modules, why)
    yield Pruned("kernels loaded", some.kernels, every.kernels, why)


def _unlocked(scene: Scene) -> int:
    return 2 * 6 * int(scene.rig.blade.elements) + 6


def _locked(scene: Scene) -> str:
    if scene.rig.model == "full":
        return "none locked (full)"
    return f"rotations locked ({scene.rig.model}), with and without pruning"


def _roped(scene: Scene) -> bool:
    return scene.rig.rope is not None and scene.rig.rope.stiffness > 0.0


def _rope_reason(roped: bool) -> str:
    return "the rope" if roped else "no rope in the scene: no spring"


def _load_reason(scene: Scene) -> str:
    if scene.rig.model == "A":
        return "friction uses the constant static load (A)"
    return "friction uses the computed normal force"


def _laws(problem: Problem) -> tuple[int, int]:
    used = set(problem.interface.points.friction.tolist()) - {FRICTIONLESS}
    return len(used), len(FRICTION_LAWS) - 1
