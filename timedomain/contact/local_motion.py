"""The relative motion of a stage, and how it answers contact forces."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array


class Local(NamedTuple):
    """Relative motion and forces; the last three are workspace."""

    displacement: Array
    """shape (rank,)"""
    velocity: Array
    """shape (rank,)"""
    reaction: Array
    """φ [N], shape (rank,)"""
    gaps: Array
    """of the points [m], shape (points, 3)"""
    slips: Array
    """[m/s], shape (points, 3)"""
    forces: Array
    """[N], shape (points, 3)"""
    lines: Array
    """linearised forces, shape (points, 3)"""
    by_gap: Array
    """shape (points, 3)"""
    by_slip: Array
    """shape (points, 3, 3)"""
    matrix: Array
    """shape (rank, rank)"""
    change: Array
    """shape (2, rank)"""


class Answer(NamedTuple):
    """How the relative motion of a stage answers a contact force; one level, stage."""

    compliance: Array
    stiffness: Array
    slope: float
    """relative displacement by relative velocity [s]"""
    weight: Array
    begins: Array
    """penetrations at the begin of a step of means, or empty"""


def empty_local(rank: int, points: int) -> Local:
    """Return a relative motion of zeros."""
    return Local(
        np.zeros(rank),
        np.zeros(rank),
        np.zeros(rank),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros((points, 3, 3)),
        np.zeros((rank, rank)),
        np.zeros((2, rank)),
    )
