"""A first point where Newton's iteration resists: easier problems lead to it (§6.2)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from hbm.balance.relative import RelativeProblem
from hbm.continuation.arc import Metric
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.fine_arcs import fine_arcs
from hbm.curves.followed import followed
from hbm.curves.grown import Resolved, grown
from hbm.curves.parted import parted
from hbm.curves.share_arc import along_an_arc
from hbm.curves.stiffened import depths, soft, stiffening, stops
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import LEAST, AlongShare, Easier, arrived, driven
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array, largest

PATIENCE = 1000
"""evaluations after which an arc of drives is given up; those that arrive take some
300"""
FOURIERS = (FourierBasis(3, 128), FourierBasis(7, 128), FourierBasis(15, 256))
"""coarse resolutions that are tried in turn"""
SMOOTH = 1e4
"""times the threshold velocity with which a homotopy begins"""
LOUD = 10.0
"""times the drive with which a drive begins that falls"""
GROWN = 1500
"""evaluations after which a drive that grows is given up where harmonics are what each
one asks for"""
STOPPED, FALLEN = 15000, 4000
"""evaluations after which stops that stiffen, or a drive that falls, are given up where
harmonics are what each share asks for"""
PRESSED = 1e4
"""depth to which faces are pressed as one begins, over the motion without contacts"""
TOUCHING = 1e-3
"""depth at rest up to which faces just touch, over that motion"""


def approaches(
    path: Path,
    parameter: float,
    control: StepControl,
    effort: Effort,
    metric: Metric,
    *,
    folded: bool = True,
    resolved: Resolved | None = None,
) -> Iterator[Array]:
    """Yield coefficients of coarse responses at a parameter, (2H + 1, rank) each.

    Stops stiffen from nothing: beside them a drive that grows meets fold after fold.
    Then the drive grows from nothing, or the threshold velocity of friction falls from
    a large value, or friction grows from nothing, or faces that just touch are pressed
    together and then let go, at coarse resolutions in turn; beside much more drive
    friction is little, so that the drive also falls; then, if ``folded``, the drive
    grows along an arc, through folds and through zero; at last what is pressed together
    at rest is softened and stiffened again. Some of what is found may exist at its
    resolution alone, or be the same again. ``effort`` counts what it takes; ``metric``
    measures steps of Newton's iteration. With what makes systems ``resolved`` stops
    also stiffen, and the drive falls, at fine resolutions.
    """
    seen = control, effort, metric
    yield from _stiffened(path, parameter, *seen, resolved=resolved)
    yield from _others(path, parameter, *seen, folded=folded, resolved=resolved)
    yield from parted(path, parameter, *seen, arcs=1 if resolved is None else 2)


def _stiffened(
    path: Path,
    parameter: float,
    control: StepControl,
    effort: Effort,
    metric: Metric,
    *,
    resolved: Resolved | None,
) -> Iterator[Array]:
    """Yield those to which stops lead that may begin soft."""
    problem, frequency = path.at(parameter)
    seen = control, effort, metric
    stiffer = stiffening(problem, frequency, soft(problem))
    if stiffer is None:
        return
    coarse = FOURIERS if resolved is None else FOURIERS[:1]
    yield from arrived(
        partial(followed, path, parameter, stiffer, each, *seen) for each in coarse
    )
    if resolved is not None:
        shares = AlongShare(path, parameter, stiffer, 0.0)
        yield from fine_arcs(shares, resolved, *seen, patience=STOPPED, finest=True)


def _others(
    path: Path,
    parameter: float,
    control: StepControl,
    effort: Effort,
    metric: Metric,
    *,
    folded: bool,
    resolved: Resolved | None,
) -> Iterator[Array]:
    """Yield those to which drive, friction and what just touches lead."""
    problem, frequency = path.at(parameter)
    seen, drives = (control, effort, metric), AlongShare(path, parameter)
    ways = _ways(problem, frequency)
    yield from arrived(
        partial(followed, path, parameter, easier, each, *seen)
        for each in FOURIERS
        for easier in ways
    )
    if resolved is not None and _rubs(problem):
        louder = AlongShare(path, parameter, _louder, 0.0, free=True)
        yield from fine_arcs(louder, resolved, *seen, patience=FALLEN, finest=False)
    if folded:
        yield from arrived(
            partial(along_an_arc, drives, LEAST, each, PATIENCE, *seen)
            for each in FOURIERS
        )
    if resolved is not None:
        yield from arrived(
            [partial(grown, drives, LEAST, resolved, GROWN, control, effort)]
        )


def _ways(problem: RelativeProblem, frequency: float) -> list[Easier]:
    """Return the homotopies that may lead to a problem.

    Where faces just touch at rest, each share of the drive is as hard as the whole:
    there they begin pressed together, as springs.
    """
    rubs = _rubs(problem)
    ways: list[Easier] = [driven, *((_threshold, _friction) if rubs else ())]
    motion = largest(problem.apart(frequency))
    if not _touches(problem, motion):
        return ways
    return [*ways, lambda problem, share: _pressed(problem, motion, share)]


def _rubs(problem: RelativeProblem) -> bool:
    """Return whether there is friction."""
    return bool(problem.points.dynamic.any() or problem.points.static.any())


def _louder(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem under more drive, beside which friction is little."""
    return driven(problem, LOUD ** (1.0 - share))


def _threshold(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem with friction that is smoother near rest."""
    factor = SMOOTH ** (1.0 - share)
    points = problem.points._replace(threshold=problem.points.threshold * factor)
    return replace(problem, points=points)


def _friction(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem with a share of its friction."""
    points = problem.points._replace(
        dynamic=problem.points.dynamic * share, static=problem.points.static * share
    )
    return replace(problem, points=points)


def _pressed(problem: RelativeProblem, depth: float, share: float) -> RelativeProblem:
    """Return the problem with faces that are pressed together, and then let go."""
    gap = problem.points.gap - depth * (PRESSED ** (1.0 - share) - 1.0)
    return replace(problem, points=problem.points._replace(gap=gap))


def _touches(problem: RelativeProblem, motion: float) -> bool:
    """Return whether faces just touch at rest, in comparison with a motion [m]."""
    near = np.abs(depths(problem)) <= TOUCHING * motion
    return bool((stops(problem) & near).any())
