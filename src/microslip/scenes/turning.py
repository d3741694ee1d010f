"""Frames that turn as a table [rotation] says."""

from __future__ import annotations

import numpy as np

from microslip.scenes.rotation import SteadyRotation
from microslip_mechanics.structures.frame import Frame
from microslip_mechanics.structures.rotating_frame import RotatingFrame
from microslip_mechanics.structures.rotation import Rotation


def turning(frame: Frame, table: SteadyRotation) -> RotatingFrame:
    """Return a frame in axes that turn."""
    axis, centre = np.array(table.axis), np.array(table.centre)
    return RotatingFrame(frame, Rotation(table.speed, axis, centre))
