"""What is varied when poles are asked for, and which values are usual."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Scene
from microslip.scenes.scene_file import load_scene
from microslip.scenes.systems.tables import System
from microslip.scenes.two_blades.tables import TwoBlades

FRICTION = "friction"
"""the parameter µd that takes µs along in proportion"""
SHARES = (0.0, *np.geomspace(1e-3, 10.0**1.5, 28).tolist())
"""of the scene's friction, from none to sticking"""
STRENGTHS = ("mu", "mu_dynamic", "limit")
"""keys that say how strong friction is"""


@dataclass(frozen=True, slots=True)
class Question:
    """What is varied, and where the response is taken."""

    scene: str
    overrides: tuple[str, ...]
    key: str
    """table and key of the scene, or :data:`FRICTION`"""
    frequency: float | None = None
    """of the response [rad/s]; that of its largest amplitude if left out"""

    def at(self, value: str) -> Scene:
        """Return the scene at one value.

        Raises
        ------
        SceneError
            If the scene does not take it.
        """
        if self.key != FRICTION:
            return load_scene(self.scene, (*self.overrides, f"{self.key}={value}"))
        ratio, dynamic = self._ratio(), f"friction.mu_dynamic={value}"
        load_scene(self.scene, (*self.overrides, dynamic))
        static = f"friction.mu_static={ratio * float(value)!r}"
        return load_scene(self.scene, (*self.overrides, dynamic, static))

    def usual_values(self) -> list[str]:
        """Return values of the friction coefficient from none to sticking.

        Raises
        ------
        SceneError
            If another key is varied: its values must be given.
        """
        if self.key != FRICTION:
            raise SceneError(f"{self.key}: give values of it")
        self._ratio()
        scale = load_scene(self.scene, self.overrides).rig.friction.mu_dynamic
        return [f"{share * scale:.4g}" for share in SHARES]

    def _ratio(self) -> float:
        """Return µs/µd."""
        rig = load_scene(self.scene, self.overrides).rig
        if not isinstance(rig, TwoBlades):
            raise SceneError(
                f"{self.scene}: no one friction coefficient stands for this scene: "
                f"give a key and values ({_own_keys(rig)})"
            )
        friction = rig.friction
        if friction.law == "none" or friction.mu_dynamic == 0.0:
            raise SceneError(
                f"{self.scene}: [friction] law = {friction.law}, mu_dynamic = "
                f"{friction.mu_dynamic:g}: there is no friction to vary: give some, or "
                "another key and its values"
            )
        return friction.mu_static / friction.mu_dynamic


def _own_keys(rig: BladedDisk | System) -> str:
    """Return what may be varied in a scene that is not of two blades, for messages."""
    rubbing: dict[str, object] = {}
    if isinstance(rig, BladedDisk):
        rubbing["friction"] = rig.friction
    else:
        rubbing.update({f"element.{name}": law for name, law in rig.element.items()})
    strengths = {
        f"{table}.{key}": value
        for table, law in rubbing.items()
        for key in STRENGTHS
        if (value := getattr(law, key, 0.0)) > 0.0
    }
    if not strengths:
        return "none of its elements has friction"
    usual = next(iter(strengths.values()))
    values = " ".join(f"{share * usual:g}" for share in (0.3, 1.0, 3.0))
    return f"{' or '.join(strengths)}, such as {values}"
