"""What a time step and harmonic balance solve for, and what a residual evaluates."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hbm.forces.fourier import FourierBasis, usual_samples
from hbm.forces.marched import marched
from hbm.paths.path import AlongFrequency
from microslip.scenes.scene import Scene
from microslip.studies.explain.pruned import Pruned, part
from microslip_mechanics.problem import Problem

HARMONICS = 63
"""for which unknowns are counted where their number follows from the tolerance"""
EVALUATED = (
    (
        "moments evaluated of {} samples",
        "the second half of a period mirrors the first",
    ),
    ("calls of the contact law", "of all contact points, for one residual"),
    ("tangents at a moment", "the others are always zero"),
)
"""what a residual evaluates, and why not all of it"""


def time_step(problem: Problem) -> Pruned:
    """Count what a time step solves for."""
    _, selection = problem.interface.relative_motion()
    why = "relative motion of the faces; the structure is linear"
    dofs = problem.structure.dofs
    return part("unknowns of a time step", len(selection), dofs, why)


def balance(
    path: AlongFrequency, whole: AlongFrequency, scene: Scene
) -> Iterator[Pruned]:
    """Count what harmonic balance solves for, and what it evaluates for that."""
    why = "relative motions that move; the structure is condensed exactly"
    yield part("coordinates of harmonic balance", path.rank, whole.rank, why)
    harmonics = scene.curve.harmonics or HARMONICS
    samples = scene.curve.samples or usual_samples(harmonics)
    one, every = (each.mask(harmonics) for each in (path, whole))
    why = "symmetry keeps the others at zero"
    name = f"orders of {harmonics} harmonics and the mean"
    orders = _orders(one), _orders(every)
    yield part(name, *orders, why)
    if orders[0] == orders[1] and path.rank < whole.rank:
        why = "of the coordinates above"
    name = f"unknowns of harmonic balance with {harmonics} harmonics"
    yield part(name, int(one.sum()), int(every.sum()), why)
    fourier = FourierBasis(harmonics, samples)
    evaluated = zip(*(_evaluated(each, fourier) for each in (path, whole)), strict=True)
    for (name, why), (some, most) in zip(EVALUATED, evaluated, strict=False):
        yield part(name.format(samples), some, most, why)


def _orders(mask: np.ndarray) -> int:
    """Return how many orders move, the mean among them."""
    return int(mask[0].any()) + int(mask[1::2].any(axis=1).sum())


def _evaluated(path: AlongFrequency, fourier: FourierBasis) -> list[int]:
    """Return moments in a period, calls of the law in all, and tangents at a moment.

    Contacts that remember have tangents by all moments before, which are no such count.
    """
    contact = path.problem.contact(fourier)
    halved = contact.symmetry.signs.size > 0
    moments = fourier.samples // 2 if halved else fourier.samples
    points = int(contact.points.load.size)
    counts = [moments, moments * points]
    recalls = marched(contact.points).any()
    return counts if recalls else [*counts, len(contact.tangents.samples)]
