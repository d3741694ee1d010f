"""A scene: a rig, and what is done with it."""

from __future__ import annotations

import typing
from dataclasses import dataclass, field

from microslip.scenes.experiments import Curve, March, Sweep
from microslip.scenes.force_file import Force
from microslip.scenes.quantity import SceneError

Table = typing.TypeVar("Table")


@dataclass(frozen=True, slots=True)
class Experiments:
    """Tables of what is done; None for those that a scene leaves out."""

    sweep: Sweep | None = None
    curve: Curve | None = None
    march: March | None = None


@dataclass(frozen=True, slots=True)
class Scene:
    """A rig, and what is done with it."""

    source: str = field(compare=False)
    """name of the scene, or of its file"""
    rig: typing.Any
    """tables of its kind: TwoBlades, BladedDisk or System"""
    experiments: Experiments
    text: str
    """the TOML that made it, overrides included"""
    force: Force | None = None
    """that the sweep's ``force_file`` holds"""

    @property
    def sweep(self) -> Sweep:
        """Table [sweep]; a SceneError if there is none."""
        return self._needed("sweep", self.experiments.sweep)

    @property
    def curve(self) -> Curve:
        """Table [curve]; a SceneError if there is none."""
        return self._needed("curve", self.experiments.curve)

    @property
    def march(self) -> March:
        """Table [march]; a SceneError if there is none."""
        return self._needed("march", self.experiments.march)

    def _needed(self, name: str, table: Table | None) -> Table:
        if table is None:
            raise SceneError(f"{self.source}: table [{name}] is missing: add it")
        return table
