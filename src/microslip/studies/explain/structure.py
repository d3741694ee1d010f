"""What a scene leaves out of its structure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from microslip.scenes.rigs import sector_of
from microslip.scenes.scene import Scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.explain.pruned import Pruned
from microslip_mechanics.problem import Problem

if TYPE_CHECKING:
    from microslip_mechanics.reduction.reduced_problem import ReducedProblem


def structure(
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


def _whole(
    scene: Scene, problem: Problem, made: ReducedProblem | None
) -> tuple[int, str]:
    """Return a system's number of degrees of freedom, and how it became smaller."""
    if made is None:
        sparse = "sparse" if problem.structure.sparse else "dense"
        return problem.structure.dofs, f"all of the scene's; {sparse}"
    wanted, hertz = scene.rig.structure.reduction, scene.curve.highest
    return made.reduction.whole.dofs, (
        f"{wanted.method}, modes up to {wanted.highest:g} Hz: what is kept moves or "
        f"resists otherwise by {made.error(hertz):.1e} at {hertz:g} Hz"
    )
