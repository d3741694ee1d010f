"""The load history that a scene's sweep table describes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.experiments import Sweep
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Scene
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.loads.force_record import ForceRecord
from microslip_mechanics.loads.sine_test import SineTest, Tone, stepped

if TYPE_CHECKING:
    from microslip.scenes.systems.tables import System


def load_history(scene: Scene) -> LoadHistory:
    """Return the sine test of a scene, or the force of its file.

    Each level has the whole sweep; the free time after the end follows each of them.

    Raises
    ------
    SceneError
        If the force of a file has no drive along which to act.
    """
    sweep = scene.sweep
    free = sweep.duration - sweep.end
    if scene.force is not None:
        drive = _drive(scene)
        time, factor = scene.force.time, scene.force.force / drive
        return ForceRecord(sweep.ramp, sweep.start, time, factor, free, sweep.lowest)
    tones: list[Tone] = []
    for level in sweep.levels:
        if tones and free > 0.0:
            tones.append(Tone(tones[-1].last, tones[-1].last, free, 0.0))
        tones += _tones(sweep, level)
    return SineTest(sweep.ramp, sweep.start, tuple(tones), free)


def _drive(scene: Scene) -> float:
    """Return the force of a scene's one drive [N], of which a file's force is parts."""
    rig = scene.rig
    if isinstance(rig, TwoBlades):
        name, drive = "[excitation] force", rig.excitation.force
    elif isinstance(rig, BladedDisk) or not _driven_at_one(rig):
        raise SceneError(
            f'[sweep] force_file = "{scene.sweep.force_file}": a force acts where the '
            "drive does: give one [drive] without phase and no other load, or leave "
            "the file out"
        )
    else:
        ((place, wave),) = rig.drive.items()
        name, drive = f"[drive] {place}", wave.amplitude
    if drive == 0.0:
        raise SceneError(
            f"{name} = 0 N: the force file is read in parts of it: give it a value, "
            "such as 1 N"
        )
    return float(drive)


def _driven_at_one(rig: System) -> bool:
    """Return whether one force in phase with the sine is all that drives a system."""
    if rig.base is not None or rig.engine_order is not None:
        return False
    return [wave.phase for wave in rig.drive.values()] == [0.0]


def _tones(sweep: Sweep, level: float) -> list[Tone]:
    """Return the tones of one level."""
    low, high, length = sweep.lowest, sweep.highest, sweep.end - sweep.start
    if sweep.kind == "stepped":
        up = np.linspace(low, high, sweep.steps or 2)
        ways = {"up": up, "down": up[::-1], "up-down": np.append(up, up[-2::-1])}
        return stepped(ways[sweep.direction], periods=sweep.periods or 1, level=level)
    rise = Tone(low, high, length, level, sweep.kind)
    fall = Tone(high, low, length, level, sweep.kind)
    return {"up": [rise], "down": [fall], "up-down": [rise, fall]}[sweep.direction]
