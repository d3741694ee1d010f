"""From the tables of a two-blade scene to the problem that a solver is given."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from microslip.scenes.two_blades import layout
from microslip.scenes.two_blades.faces import interface, unpruned_interface
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.frame import Frame

if TYPE_CHECKING:
    from microslip_mechanics.structures.rotating_frame import RotatingFrame

SLIPS = ("element-to-excited", "element-to-follower")
"""motion of the friction element's centre relative to the blade ends' centres"""


def problem(rig: TwoBlades) -> Problem:
    """Return the rig as a problem: preload along x, drive along z (tutorial)."""
    frame = layout.frame(rig)
    centre = layout.element_centre(rig)
    ends = [
        frame.motion(layout.tip(rig, blade), layout.end_centre(rig, blade))[2]
        for blade in (0, 1)
    ]
    element = frame.motion(layout.ELEMENT, centre)[2]
    push = centre + np.array([0.0, rig.preload.offset, 0.0])
    drive = layout.end_centre(rig, 0) + rig.excitation.offset * layout.blade_axis(
        rig, 0
    )
    preload = rig.preload.force * frame.motion(layout.ELEMENT, push)[0]
    structure = frame.structure()
    turned = _turned(rig, frame)
    if turned is not None:
        structure, preload = turned.structure(), preload + turned.load()
    return Problem(
        structure,
        interface(rig, frame, _push(rig, frame, turned)),
        preload=preload,
        drive=rig.excitation.force * frame.motion(layout.tip(rig, 0), drive)[2],
        probes=Probes(
            (*layout.BLADES, layout.ELEMENT, *SLIPS),
            np.array([*ends, element, *(element - end for end in ends)]),
        ),
    )


def unpruned(rig: TwoBlades) -> Problem:
    """Return the same problem with all the contact points of the full model."""
    frame = layout.frame(rig)
    push = _push(rig, frame, _turned(rig, frame))
    return replace(problem(rig), interface=unpruned_interface(rig, frame, push))


def _turned(rig: TwoBlades, frame: Frame) -> RotatingFrame | None:
    """Return the frame in axes that turn, if they do."""
    if rig.rotation is None:
        return None
    from microslip.scenes.turning import turning

    return turning(frame, rig.rotation)


def _push(rig: TwoBlades, frame: Frame, turned: RotatingFrame | None) -> Array:
    """Return the static force on the friction element [N], shape (3,)."""
    push = np.array([rig.preload.force, 0.0, 0.0])
    if turned is None:
        return push
    motion = frame.motion(layout.ELEMENT, layout.element_centre(rig))
    return push + motion @ turned.load()
