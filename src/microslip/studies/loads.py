"""The load history that a scene's sweep table describes."""

from __future__ import annotations

import numpy as np

from microslip.experiments import Sweep
from microslip.quantity import SceneError
from microslip.scene_file import Scene
from microslip_mechanics.excitation import LoadHistory
from microslip_mechanics.force_record import ForceRecord
from microslip_mechanics.sine_test import SineTest, Tone, stepped


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
        drive = scene.rig.excitation.force
        if drive == 0.0:
            raise SceneError(
                "[excitation] force = 0 N: the force file is read in parts of it: "
                "give it a value, such as 1 N"
            )
        time, factor = scene.force.time, scene.force.force / drive
        return ForceRecord(sweep.ramp, sweep.start, time, factor, free, sweep.lowest)
    tones: list[Tone] = []
    for level in sweep.levels:
        if tones and free > 0.0:
            tones.append(Tone(tones[-1].last, tones[-1].last, free, 0.0))
        tones += _tones(sweep, level)
    return SineTest(sweep.ramp, sweep.start, tuple(tones), free)


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
