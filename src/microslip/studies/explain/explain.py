"""What a scene keeps and what it leaves out, counted on the problem itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.rigs import problem_of, sector_of, unpruned_of
from microslip.scenes.scene import Scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.explain.contacts import contacts
from microslip.studies.explain.imported import FRC, imported
from microslip.studies.explain.pruned import Pruned
from microslip.studies.explain.structure import structure
from microslip.studies.explain.unknowns import balance, time_step
from microslip.studies.explain.unpruned import path_of, unpruned_path_of

if TYPE_CHECKING:
    from microslip_mechanics.reduction.reduced_problem import ReducedProblem

LOADS = "friction uses the computed normal force, or a constant"


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
        *structure(scene, problem, whole, made),
        *contacts(problem, why),
        # one sector cannot be marched
        time_step(problem if sector is None else whole),
        *balance(path_of(scene, problem), unpruned_path_of(scene, whole), scene),
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


def _load_reason(scene: Scene) -> str:
    if scene.rig.model == "A":
        return "friction uses the constant static load (A)"
    return "friction uses the computed normal force"


def _code() -> Iterator[Pruned]:
    """Count what frc loads of all code."""
    some, every = imported(FRC), imported(())
    why = "those of frc; what another command needs is loaded by it"
    yield Pruned("modules loaded", some.modules, every.modules, why)
    yield Pruned("kernels loaded", some.kernels, every.kernels, why)
