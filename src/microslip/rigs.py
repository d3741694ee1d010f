"""From a scene to the problem that a solver is given, by the kind of its rig."""

from __future__ import annotations

from microslip.scene_file import Scene
from microslip.scenes.two_blades import build
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.problem import Problem


def problem_of(scene: Scene) -> Problem:
    """Return the problem of a scene."""
    if isinstance(scene.rig, TwoBlades):
        return build.problem(scene.rig)
    from microslip.scenes.systems.rig import problem

    return problem(scene.rig)
