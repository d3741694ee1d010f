"""A problem in few coordinates: what its contacts touch, and slow modes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.loads.node_sets import Sets, given_sets, texts
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.quantity import Quantity
from microslip_mechanics.reduction.reduced_structure import (
    ReducedStructure,
    craig_bampton,
    modal_truncation,
)
from microslip_mechanics.structures.selection import selected

Method = Literal["craig-bampton", "modal"]
METHODS = {"craig-bampton": craig_bampton, "modal": modal_truncation}
MOST = 100
"""loaded degrees of freedom up to which they are kept by themselves"""


@dataclass(frozen=True, slots=True, repr=False)
class ReducedProblem:
    """A problem for the solvers, and the structure from which it came."""

    problem: Problem
    reduction: ReducedStructure

    def __repr__(self) -> str:
        """Return what kind of problem it is, in a line."""
        whole = self.reduction.whole.dofs
        return f"<ReducedProblem: of {whole} degrees of freedom; {self.problem!r}>"

    def error(self, hertz: float | str) -> float:
        """Return the relative error of stiffness or motion at what is kept.

        Raises
        ------
        ValueError
            If it is no frequency, or a natural one of the structure.
        """
        told = "error: hertz"
        return self.reduction.error(2.0 * math.pi * _hertz(hertz, told, zero=True))


def reduced_problem(
    problem: Problem,
    highest: float | str,
    *,
    method: Method = "craig-bampton",
    keep: Sequence[str] = (),
    sets: Sets | None = None,
) -> ReducedProblem:
    """Return a problem whose structure has the contacts' coordinates and slow modes.

    Parameters
    ----------
    problem
        Of a sparse or dense structure.
    highest
        Modes are kept up to this frequency [Hz]; it may be a text such as "5 kHz".
    method
        Modes of the structure held at what is kept (Craig, Bampton 1968), or its own
        modes with static corrections (MacNeal 1971, Rubin 1975).
    keep
        Degrees of freedom to keep beside those of contacts and point loads: names,
        nodes, patterns such as ``tip.*``, names of sets.
    sets
        Nodes by the name of their set.

    Raises
    ------
    ValueError
        If a name is unknown, nothing is kept, or the structure moves freely.
    """
    if method not in METHODS:
        raise ValueError(
            f"method {method!r} is unknown: give one of {', '.join(get_args(Method))}"
        )
    if not isinstance(problem, Problem):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            f"reduced_problem: problem = {problem!r}: give what microslip.system or "
            "microslip.scene returns"
        )
    if not texts(keep):
        raise ValueError(
            f"reduced_problem: keep = {keep!r}: give a list of degrees of freedom, "
            'nodes, patterns or sets, such as ["tip.*"]'
        )
    limit = 2.0 * math.pi * _hertz(highest, "reduced_problem: highest")
    names = problem.structure.names
    kept = _kept(problem, selected(names, keep, given_sets(sets, names)))
    made = METHODS[method](problem.structure, kept, limit)
    rows = made.rows(problem.interface.displacement)
    return ReducedProblem(
        Problem(
            made.structure,
            replace(problem.interface, displacement=rows),
            preload=made.rows(problem.preload),
            drive=problem.drive @ made.shapes,
            probes=Probes(problem.probes.names, made.rows(problem.probes.rows)),
        ),
        made,
    )


def _hertz(given: float | str, told: str, *, zero: bool = False) -> float:
    """Return a frequency [Hz] that may be a text with a unit."""
    try:
        return Quantity("Hz", 0.0, math.inf, positive=not zero).read(given)
    except ValueError as error:
        raise ValueError(f"{told} = {given!r}: {error}") from None


def _kept(problem: Problem, wanted: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return what contacts and point loads touch, and what is wanted besides."""
    touched = (problem.interface.displacement != 0.0).any(axis=0)
    touched[wanted] = True
    loaded = (problem.loads != 0.0).any(axis=0)
    if np.count_nonzero(loaded) <= MOST:
        touched |= loaded
    if not touched.any():
        raise ValueError("a reduction has nothing to keep: name what is of interest")
    return np.flatnonzero(touched)
