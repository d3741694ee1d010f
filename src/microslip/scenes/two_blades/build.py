"""From the tables of a two-blade scene to the problem that a solver is given."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from microslip.scenes.two_blades import layout
from microslip.scenes.two_blades.faces import interface, unpruned_interface
from microslip.scenes.two_blades.tables import TwoBlades
from microslip_mechanics.problem import Probes, Problem

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
    if rig.rotation is not None:
        from microslip.scenes.turning import turning

        turned = turning(frame, rig.rotation)
        structure, preload = turned.structure(), preload + turned.load()
    return Problem(
        structure,
        interface(rig, frame),
        preload=preload,
        drive=rig.excitation.force * frame.motion(layout.tip(rig, 0), drive)[2],
        probes=Probes(
            (*layout.BLADES, layout.ELEMENT, *SLIPS),
            np.array([*ends, element, *(element - end for end in ends)]),
        ),
    )


def unpruned(rig: TwoBlades) -> Problem:
    """Return the same problem with all the contact points of the full model."""
    return replace(problem(rig), interface=unpruned_interface(rig, layout.frame(rig)))
