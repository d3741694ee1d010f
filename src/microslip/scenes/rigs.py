"""From a scene to the problem that a solver is given, by the kind of its rig."""

from __future__ import annotations

from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Scene
from microslip.scenes.two_blades import build
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.cyclic import CyclicProblem
from microslip_mechanics.problem import Problem


def problem_of(scene: Scene) -> Problem:
    """Return the problem of a scene.

    Raises
    ------
    SceneError
        If the scene is one sector of a disk, which :func:`sector_of` makes.
    """
    if isinstance(scene.rig, TwoBlades):
        return build.problem(scene.rig)
    if isinstance(scene.rig, BladedDisk):
        from microslip.scenes.bladed_disk.build import disk

        if scene.rig.solve == "sector":
            raise SceneError(
                'solve = "sector": only frc and explain take one sector of a disk: '
                "give solve=disk"
            )
        return disk(scene.rig)
    from microslip.scenes.systems.build import problem

    return problem(scene.rig)


def solvable(scene: Scene) -> Problem:
    """Return the problem of a scene that has a table [curve], too.

    Raises
    ------
    SceneError
        If it has none, or no problem: to be told before the work begins.
    """
    _ = scene.curve
    return problem_of(scene)


def sector_of(scene: Scene) -> CyclicProblem | None:
    """Return the sector that stands for a disk; None if the scene is no such thing."""
    if not isinstance(scene.rig, BladedDisk) or scene.rig.solve != "sector":
        return None
    from microslip.scenes.bladed_disk.build import sector

    return sector(scene.rig)


def unpruned_of(scene: Scene) -> Problem:
    """Return a problem with the same response, from which nothing is left out.

    It has the contact points of the full model, and all sectors of a disk.
    """
    if isinstance(scene.rig, TwoBlades):
        return build.unpruned(scene.rig)
    if isinstance(scene.rig, BladedDisk):
        from microslip.scenes.bladed_disk.build import disk

        return disk(scene.rig)
    return problem_of(scene)
