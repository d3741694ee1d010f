"""What the fast march keeps from step to step, and what it is told."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from timedomain.contact.local_motion import Local, empty_local
from timedomain.fast.coordinates import Coordinates
from timedomain.fast.schemes import Scheme
from timedomain.record.record import FLOWS

TICK, LEVEL, HINT, STEPS, REJECTED = range(5)
ITERATIONS, SAFE, SAFE_STEPS, ROUGH, FIRST, HOPELESS = range(5, 11)
REFERENCE, DRIFT, LARGEST_DRIFT, OTHER_WORK, UNKEPT = range(5)
SETTLED_DRIFT, LENGTH, WORST = range(5, 8)


class Control(NamedTuple):
    """What a march is told."""

    longest: float
    """longest step [s]"""
    stride: int
    """longest steps per stored row"""
    tolerance: float
    """of a step's error, relative; 0 holds the longest step"""
    newton: float
    """relative tolerance of contact forces"""
    floor: float
    """absolute one [N]"""
    lowest: int
    """level of the shortest steps"""
    hold: int
    """ticks without a rough step before steps grow"""
    least: float
    """twice the least energy [J] that errors are compared with"""
    settled: int
    """tick until which a growing preload alone moves the structure"""


class Motion(NamedTuple):
    """What one step hands to the next; written in place."""

    displacement: Array
    """q, shape (modes,)"""
    velocity: Array
    """shape (modes,)"""
    coupled: Array
    """damping force of the other modes, its rate and, over h², by how much its mean in
    the last step exceeds that of both ends; shape (3, modes), or (3, 0) without any"""
    gaps: Array
    """of the points [m], shape (points, 3)"""
    slips: Array
    """[m/s], shape (points, 3)"""
    forces: Array
    """[N], at the end of the last step or its mean, shape (points, 3)"""
    rates: Array
    """[N/s], shape (points, 3)"""
    reaction: Array
    """φ [N] and its rate over the last step, shape (2, rank)"""
    relative: Array
    """y and ẏ, shape (2, rank)"""
    powers: Array
    """of FLOWS [W], shape (4,)"""
    energies: Array
    """of FLOWS so far [J], shape (4,)"""
    numbers: Array
    """reference energy, drift of energy by the errors of steps, its largest size since
    more moves than a growing preload, friction's discrete work, errors of steps that
    could not keep the tolerance, drift until that time [J]; length of the last step
    [s]; error of the step from which on halving does not help, or 0"""
    counts: NDArray[np.int64]
    """tick, level, segment, steps, rejected steps, iterations, dissipative steps to go
    and so far, tick of the last step too rough for a longer one, level of the
    step from which on halving does not help, shortest steps that were too rough"""


class Trial(NamedTuple):
    """A step that is being tried; workspace."""

    local: Local
    displacement: Array
    velocity: Array
    force: Array
    """modal forces of the stages, shape (stages + 1, modes)"""
    contact: Array
    """modal contact force, shape (modes,)"""
    relative: Array
    """y and ẏ without the stage's contact force, shape (2, rank)"""
    powers: Array
    """of the stages, shape (stages + 1, 4)"""
    factors: Array
    """of the loads, shape (loads,)"""
    before: Array
    """forces of the last stage but one, shape (points, 3)"""
    curvature: Array
    """second derivative of φ, shape (rank,)"""
    numbers: Array
    """drift of energy, structural power at the end of a step with mean force, twice
    the energy of its error; shape (3,)"""
    load: Array
    """modal forces of the loads at the begin, shape (modes,)"""
    bulge: Array
    """by which their mean over the step exceeds that of both ends, shape (modes,)"""
    begins: Array
    """penetrations at the begin, shape (points,)"""
    coupled: Array
    """damping force of the other modes at the begin, its change, and by how much its
    mean exceeds that of both ends; shape (3, modes), or (3, 0) without any"""


def empty_trial(schemes: tuple[Scheme, Scheme], coordinates: Coordinates) -> Trial:
    """Return workspace for a step."""
    modes, points = coordinates.modes, coordinates.contacts.first.size
    count, rank = modes.stiffness.size, len(modes.selection)
    stages = 1 + max(scheme.stages for scheme in schemes)
    return Trial(
        empty_local(rank, points),
        np.zeros(count),
        np.zeros(count),
        np.zeros((stages, count)),
        np.zeros(count),
        np.zeros((2, rank)),
        np.zeros((stages, len(FLOWS))),
        np.zeros(len(modes.loads)),
        np.zeros((points, 3)),
        np.zeros(rank),
        np.zeros(3),
        np.zeros(count),
        np.zeros(count),
        np.zeros(points),
        np.zeros((3, count if modes.coupling.any() else 0)),
    )
