"""What one step of the reference march hands to the next."""

from __future__ import annotations

from typing import NamedTuple

from microslip_mechanics.arrays import Array


class State(NamedTuple):
    """What one step hands to the next; written in place."""

    displacement: Array
    velocity: Array
    acceleration: Array
    reaction: Array
    """contact force on the relative coordinates [N], shape (rank,)"""
    forces: Array
    """of each point [N], shape (points, 3)"""
    gaps: Array
    """relative displacement of each point [m], shape (points, 3)"""
    slips: Array
    """relative velocity of each point [m/s], shape (points, 3)"""
    past: Array
    """where each point was along its tangents when the step began [m], its traction [N]
    of friction that remembers, its velocity [m/s], and its normal load [N] and depth
    [m]; shape (points, 4, 2)"""
    fresh: Array
    """the same for now"""
