"""What the laws of a scene's contacts need."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from microslip.studies.explain.pruned import Pruned
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import (
    BRISTLE,
    COULOMB,
    ELASTIC,
    FRICTIONLESS,
    GENERAL_KINETIC,
    RIGID,
    TANH,
)
from microslip_mechanics.problem import Problem

FRICTION_LAWS = {
    COULOMB: "Coulomb",
    GENERAL_KINETIC: "GKF",
    FRICTIONLESS: "no friction",
    TANH: "smooth Coulomb",
    ELASTIC: "elastic friction",
    BRISTLE: "bristles",
    RIGID: "rigid Coulomb",
}


def contacts(problem: Problem, why: str) -> Iterator[Pruned]:
    """Count what the contacts' laws need."""
    points, count = problem.interface.points, problem.interface.count
    loads = int(np.sum(~points.constant_load & (points.friction != FRICTIONLESS)))
    yield Pruned("variable normal loads of friction", loads, count, why)
    why = "only those of the scene's points"
    yield Pruned("friction laws called", *_laws(problem), why)
    yield from _stuck(problem)


def _laws(problem: Problem) -> tuple[int, int]:
    used = set(problem.interface.points.friction.tolist()) - {FRICTIONLESS}
    return len(used), len(FRICTION_LAWS) - 1


def _stuck(problem: Problem) -> Iterator[Pruned]:
    """Say by what rule the position of stuck contacts is fixed."""
    points = problem.interface.points
    count = int(np.sum(remembers(points) | (points.friction == RIGID)))
    if count:
        rule = "zero: it fixes the mean position of a contact that never slides"
        yield Pruned("mean friction of stuck contacts", 0, count, rule)
