"""Loads by ground that moves, in coordinates that move with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray, Matrix
from microslip_mechanics.frame import MOTIONS, Frame
from microslip_mechanics.structure import Structure

AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class BaseExcitation:
    """p = −(M r) a − (C r) v of a structure that its ground carries along r.

    u is then the motion relative to the ground; so is what probes show. Amplitudes are
    complex: a load p stands for the imaginary part of p e^{iωt}, as sin ωt does for 1.
    """

    inertia: Array
    """M r, with what ties it to the ground's own motion [kg], shape (dofs,)"""
    damping: Array
    """C r of the dampers that do not move with the ground [N s/m], shape (dofs,)"""

    def by_acceleration(
        self, acceleration: complex, frequency: float | None = None
    ) -> ComplexArray:
        """Return the load by an amplitude of the ground's acceleration [m/s²].

        The same at every frequency as long as all dampers move with the ground.

        Raises
        ------
        ValueError
            If dampers do not, and there is no frequency [rad/s].
        """
        load: ComplexArray = -complex(acceleration) * self.inertia
        if not self.damping.any():
            return load
        if frequency is None or not 0.0 < frequency < np.inf:
            raise ValueError(
                "dampers that do not move with the ground make the load depend on "
                "frequency: give a positive one"
            )
        return load - acceleration / (1j * frequency) * self.damping

    def by_displacement(self, displacement: complex, frequency: float) -> ComplexArray:
        """Return the load by an amplitude of the ground's motion [m] at ω [rad/s]."""
        return self.by_acceleration(-(frequency**2) * displacement, frequency)


def base_excitation(
    structure: Structure, carried: Array, still: Matrix | None = None
) -> BaseExcitation:
    """Return the loads by ground that moves all supports alike.

    Parameters
    ----------
    structure
        Its mass must not reach the ground (as lumped masses do not); a frame has
        :func:`frame_base_excitation`.
    carried
        r: the motion by a unit of the ground's, shape ``(dofs,)``; see
        :func:`translation`.
    still
        Damping against what stays still, such as α M if it is meant so, shape
        ``(dofs, dofs)``. The rest acts on the motion relative to the ground.

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
    damping = np.zeros(structure.dofs) if still is None else still @ carried
    return BaseExcitation(np.asarray(structure.mass @ carried), np.asarray(damping))


def frame_base_excitation(
    frame: Frame, direction: Array, *, still_damping: bool = False
) -> BaseExcitation:
    """Return the loads by ground that moves a frame's locked nodes and springs.

    Parameters
    ----------
    frame
        What is locked or on a spring moves with the ground.
    direction
        Of the ground's motion, shape ``(3,)``; its length is the unit.
    still_damping
        Whether the damping by mass of the beams acts against what stays still, not
        against the ground.
    """
    mass, damping, _ = frame.matrices()
    carried = np.tile(np.concatenate([direction, np.zeros(3)]), len(frame.nodes))
    free = frame.free()
    lost = (damping @ carried)[free] if still_damping else np.zeros(len(free))
    return BaseExcitation((mass @ carried)[free], lost)


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
