"""What the components of a nonlinear mode mean, and what it is measured by."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.arrays import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class Reference:
    """What a mode is measured by: the linear one from which it grows."""

    pole: complex
    """s [rad/s]"""
    row: ComplexArray
    """linear form whose value is the amplitude, shape (dofs,)"""
    stiffness: float
    """modal stiffness |s|²φᴴMφ [N/m]"""


@dataclass(frozen=True, slots=True)
class ModalParts:
    """What the components of a point mean."""

    shape: Array
    """coefficients of (y − rest)/amplitude, shape (2H + 1, rank)"""
    modal: ComplexArray
    """η over the amplitude, shape (count,)"""
    pole: complex
    """s [rad/s]"""
    amplitude: float
    """[m]"""
