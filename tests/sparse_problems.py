"""Problems with sparse structures: nets of any size; dense ones made sparse."""

import dataclasses
from typing import Any

import numpy as np
import scipy.sparse

from contact_tables import contact_points
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.structures.structure import MATRICES, Structure


def net(
    rows: int,
    columns: int,
    *,
    contacts: int = 1,
    mass_damping: float = 0.5,
    stiffness_damping: float = 2e-6,
    drive: float = 20.0,
) -> Problem:
    """Return a net of masses and springs, clamped around, with dry friction on some.

    It has one degree of freedom a mass; 50 kg in all, so that the slowest modes depend
    little on the number of masses. Friction acts near the middle.
    """
    count = rows * columns
    across = scipy.sparse.kron(scipy.sparse.eye_array(rows), _line(columns))
    along = scipy.sparse.kron(_line(rows), scipy.sparse.eye_array(columns))
    stiffness = scipy.sparse.csc_array(1e6 * (across + along))
    mass = scipy.sparse.csc_array(50.0 / count * scipy.sparse.eye_array(count))
    damping = mass_damping * mass + stiffness_damping * stiffness
    displacement = np.zeros((3 * contacts, count))
    middle = (rows // 2) * columns + columns // 2
    displacement[3 * np.arange(contacts) + 1, middle + np.arange(contacts)] = 1.0
    load, seen = np.zeros(count), np.zeros((1, count))
    load[(rows // 3) * columns + columns // 3] = drive
    seen[0, (rows // 4) * columns + columns // 2] = 1.0
    points = contact_points(
        contacts, stiffness=0.0, damping=0.0, constant_load=True, threshold=1e-3
    )
    return Problem(
        Structure(mass, damping, stiffness, tuple(map(str, range(count)))),
        Interface(points, displacement, tuple(map(str, range(contacts)))),
        np.zeros(count),
        load,
        Probes(("mass",), seen),
    )


def sparse(problem: Problem) -> Problem:
    """Return a problem with its structure's matrices made sparse."""
    return _changed(problem, scipy.sparse.csr_array)


def dense(problem: Problem) -> Problem:
    """Return a problem with its structure's matrices made dense."""
    return _changed(problem, lambda matrix: matrix.toarray())


def _changed(problem: Problem, change: Any) -> Problem:
    matrices = {name: change(getattr(problem.structure, name)) for name in MATRICES}
    return dataclasses.replace(
        problem, structure=dataclasses.replace(problem.structure, **matrices)
    )


def _line(count: int) -> Any:
    one = np.ones(count)
    return scipy.sparse.diags_array([-one[1:], 2.0 * one, -one[1:]], offsets=[-1, 0, 1])
