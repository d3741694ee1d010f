"""Contact forces at the samples of a period, transitions resolved between them.

Regularised friction turns around within a layer of phase width V_lim/(ω v_max), far
narrower than the distance of samples. In a cell between two samples through which such
a transition goes, the motion is interpolated linearly, the events are located, and a
Gauss rule between them takes the place of the trapezoidal rule (theory §6.1).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.cell import Samples, Work
from hbm.forces.refinement import refine
from hbm.forces.release import lets_go, released
from hbm.forces.steep_edge import graded, steepness
from hbm.forces.symmetry import Symmetry
from hbm.forces.transitions import EVENTS, faded, locate, passes
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge, regularised
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import inner_kernel, kernel


class Forces(NamedTuple):
    """Where forces are written; the last axis is the sample."""

    force: Array
    """[N], shape (3 points, samples)"""
    change: Array
    """(∂force/∂velocity) velocity [N]"""


@kernel
def sample(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    bounds: NDArray[np.int64],
    symmetry: Symmetry,
    regular: Forces,
    tangents: Array,
    extra: Forces,
) -> None:
    """Write forces, (∂force/∂velocity) velocity, and chosen tangents at the samples.

    With a symmetry those are the ones of the first half of the period.

    Parameters
    ----------
    points
        Contact table.
    displacement, velocity
        Of the points at the samples, shape ``(3 points, samples)``; with a symmetry
        the first half of the period and one more sample is enough.
    entries
        (row, column, by velocity) of each tangent, ordered by points.
    bounds
        The first tangent of each point, and their number; shape ``(points + 1,)``.
    symmetry
        Of half a period.
    regular
        Written: what the samples see; the last axis has all samples.
    tangents
        Written, both together.
    extra
        Written: what cells with events add to ``regular``, for :func:`hat`.
    """
    work = Work(
        np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    )
    seen = _at_samples(
        points, displacement, velocity, entries, bounds, symmetry, regular, tangents,
        work,
    )  # fmt: skip
    made = Samples(extra.force, extra.change, tangents, entries)
    extra.force[:, :seen] = 0.0
    extra.change[:, :seen] = 0.0
    events = np.zeros(EVENTS + 2)
    for point in range(points.load.size):
        row, threshold = 3 * point, points.threshold[point]
        wide = faded(points, point)
        touch, slides = edge(points, point), regularised(points, point)
        steep, near = steepness(points, point), 0.0
        goes = lets_go(points, point)
        for place in range(seen):
            after = place + 1 if place + 1 < displacement.shape[1] else 0
            if steep > 1:
                near = graded(
                    displacement[row, place] - touch, displacement[row, after] - touch
                )
            parts = goes and (
                released(points, point, displacement, velocity, place, after) > 0.0
            )
            if near == 0.0 and not parts and not passes(
                displacement, velocity, row, place, after, touch, slides, threshold,
                wide,
            ):  # fmt: skip
                continue
            found = locate(points, point, displacement, velocity, place, after, events)
            if found > 0 or near > 0.0:
                refine(
                    points, point, displacement, velocity, work, made, bounds[point],
                    bounds[point + 1], place, after, events[: found + 2],
                    steep if near > 0.0 else 1, 1.0 if found > 0 else near, symmetry,
                )  # fmt: skip


@kernel
def sample_smooth(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    bounds: NDArray[np.int64],
    symmetry: Symmetry,
    regular: Forces,
    tangents: Array,
) -> None:
    """Write what :func:`sample` does for points without transitions.

    A scene that has no others does not compile what resolves them.
    """
    work = Work(
        np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    )
    _at_samples(
        points, displacement, velocity, entries, bounds, symmetry, regular, tangents,
        work,
    )  # fmt: skip


def hat(harmonics: int, samples: int) -> Array:
    """Return what linear sharing between samples makes of each order, (2 H + 1,).

    The trapezoidal rule of a linear function, shared out as the nodes of a cell with
    events are, would be multiplied by it. Dividing the extra forces by it keeps the
    coefficients continuous when an event passes a sample.
    """
    orders = (np.arange(2 * harmonics + 1) + 1) // 2
    factor: Array = (2.0 + np.cos(2.0 * np.pi * orders / samples)) / 3.0
    return factor


@inner_kernel
def _at_samples(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    bounds: NDArray[np.int64],
    symmetry: Symmetry,
    regular: Forces,
    tangents: Array,
    work: Work,
) -> int:
    """Write what the samples see; return how many do, from the first on."""
    samples = tangents.shape[1]
    seen: int = samples // 2 if symmetry.signs.size else samples
    for point in range(points.load.size):
        _regular(
            points, point, displacement, velocity, work, entries, bounds[point],
            bounds[point + 1], seen, regular.force, regular.change, tangents,
        )  # fmt: skip
    return seen


@inner_kernel
def _regular(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    work: Work,
    entries: NDArray[np.int64],
    first: int,
    last: int,
    seen: int,
    forces: Array,
    changes: Array,
    tangents: Array,
) -> None:
    """Write force and tangents of one point at each sample."""
    moved, moving, force = work.moved, work.moving, work.force
    stiff, slope = work.by_displacement, work.by_velocity
    row = 3 * point
    for place in range(seen):
        for axis in range(3):
            moved[axis] = displacement[row + axis, place]
            moving[axis] = velocity[row + axis, place]
        contact_force(points, point, moved, moving, force, stiff, slope)
        for axis in range(3):
            forces[row + axis, place] = force[axis]
            changes[row + axis, place] = (
                slope[axis, 0] * moving[0]
                + slope[axis, 1] * moving[1]
                + slope[axis, 2] * moving[2]
            )
        for entry in range(first, last):
            at, by = entries[entry, 0] - row, entries[entry, 1] - row
            if entries[entry, 2] == 0:
                tangents[entry, place] = stiff[at, by]
            else:
                tangents[entry, place] = slope[at, by]
