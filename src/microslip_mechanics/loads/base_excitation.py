"""What ground that moves carries, in coordinates that move with it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.frame import MOTIONS, Frame
from microslip_mechanics.structures.structure import Structure

AXES = ("x", "y", "z")


def carried_inertia(structure: Structure, carried: Array) -> Array:
    """Return M r [kg], shape (dofs,): ground with the acceleration a loads by −M r a.

    Dampers move with the ground. u is then the motion relative to it; so is what probes
    show.

    Parameters
    ----------
    structure
        Its mass must not reach the ground (as lumped masses do not); a frame has
        :func:`frame_carried_inertia`.
    carried
        r: the motion by a unit of the ground's, shape ``(dofs,)``; see
        :func:`translation`.

    Raises
    ------
    ValueError
        If ``carried`` is no motion of the structure.
    """
    if carried.shape != (structure.dofs,) or not np.isfinite(carried).all():
        raise ValueError(
            f"the carried motion has shape {carried.shape}: give {structure.dofs} "
            "finite numbers, one for each degree of freedom"
        )
    return np.asarray(structure.mass @ carried)


def frame_carried_inertia(frame: Frame, direction: Array) -> Array:
    """Return M r [kg] of a frame, with what ties it to the ground's own motion.

    What is locked or on a spring moves with the ground along ``direction``, shape
    ``(3,)``, whose length is the unit.
    """
    mass, _, _ = frame.matrices()
    carried = np.tile(np.concatenate([direction, np.zeros(3)]), len(frame.nodes))
    inertia: Array = (mass @ carried)[frame.free()]
    return inertia


def translation(names: Sequence[str], direction: Array) -> Array:
    """Return the motion by a unit of translation, from names such as ``12.z``.

    Parameters
    ----------
    names
        ``node.x`` … ``node.z`` or ``node.ux`` … ``node.uz``; rotations stay at rest.
    direction
        Shape ``(3,)``; its length is the unit.

    Raises
    ------
    ValueError
        If a name does not say a direction.
    """
    found = np.zeros(len(names))
    for place, name in enumerate(names):
        motion = name.rpartition(".")[2]
        if motion in AXES or motion in MOTIONS[:3]:
            found[place] = direction[AXES.index(motion[-1])]
        elif motion not in MOTIONS:
            raise ValueError(
                f"degree of freedom {name} does not say in which direction it is, "
                "which ground that moves needs: give it a name that does, such as "
                f"{name}.x, {name}.y or {name}.z"
            )
    return found
