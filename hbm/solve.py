"""The public functions: from a problem to responses along curves over frequency."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hbm.checks import check_positive
from hbm.curves.dense_problem import dense_problem, resolved_up_to
from hbm.curves.tracer import Tracer
from hbm.errors import PLACE, ContinuationError, hertz, placed
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.structure.condensed_structure import CondensedStructure
from hbm.structure.linear_curve import LinearCurve, linear_curve
from microslip_mechanics.potential import potential
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState

if TYPE_CHECKING:
    from hbm.curves.drive_search import Sought

PARTED = (
    "at rest faces have parted that an element presses together: its preload is what "
    "it carries while its ends are together, so press them by a preload of the "
    "structure, or hold it by a spring"
)
UNPRESSED = 1e-6
"""of the load at zero displacement, up to which faces are parted"""


def frequency_response(
    problem: Problem, rest: StaticState, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses along the curve, one per continuation step.

    One that ``replaces`` some takes back as many before it: leave them out.

    Parameters
    ----------
    problem
        What is solved.
    rest
        Its static equilibrium: the curve starts from it.
    options
        Range, accuracy, harmonics.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; after its end, if the amplitude has no bound at a
        frequency in the range, without contacts. What was yielded before stays valid.
    ValueError
        If a frequency is not positive.
    """
    small, still, shapes = dense_problem(problem, rest, resolved_up_to(options))
    path = along_frequency(
        small, still, options.start, options.end, pruned=options.pruned
    )
    tracer, condensed = Tracer(small, path, options), path.problem.condensed
    responses = tracer.responses()
    if path.rank == 0 and isinstance(condensed, CondensedStructure):
        linear = linear_curve(condensed, path.problem.force[1], small.probes.rows)
        responses = _bounded(tracer, linear, options)
    begun = False
    with one_thread(), placed(hertz):
        try:
            for made in responses:
                begun = True
                yield replace(made, shapes=shapes)
        except ContinuationError as error:
            if begun or not _parted(small, still):
                raise
            raise error.with_remedy(PARTED) from None


def _parted(problem: Problem, rest: StaticState) -> bool:
    """Return whether faces that are pressed at zero displacement are not at rest."""
    given = potential(problem, np.zeros(problem.structure.dofs)).normal_force
    return bool(((given > 0.0) & (rest.normal_force <= UNPRESSED * given)).any())


def _bounded(
    tracer: Tracer, linear: LinearCurve, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the responses of a linear structure; tell where they have no bound."""
    span = options.start, options.end
    yield from tracer.at_places(linear.places(*span))
    endless = linear.unbounded(*span)
    if endless.size:
        raise ContinuationError(
            f"the amplitude has no bound at {PLACE}: nothing damps this resonance: "
            "give it damping, or a range without it",
            float(endless[0]),
        )


def branches(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
) -> Iterator[PeriodicResponse]:
    """Yield the responses on the branches that begin at branch points of a curve.

    The first of each branch has ``event = "branch"``.

    Parameters
    ----------
    problem, rest, options
        As for :func:`frequency_response`.
    known
        The responses on the curve.

    Raises
    ------
    ContinuationError
        If a branch cannot go on; what was yielded before stays valid.
    """
    from hbm.curves.branches import Branching  # what hardly a scene needs

    small, still, shapes = dense_problem(problem, rest, resolved_up_to(options))
    path = along_frequency(small, still, options.start, options.end, symmetry=False)
    with one_thread(), placed(hertz):
        for made in Branching(small, path, options).curves(known):
            yield replace(made, shapes=shapes)


def detached(
    problem: Problem,
    rest: StaticState,
    options: CurveOptions,
    known: Sequence[PeriodicResponse],
    *,
    frequencies: int = 15,
    effort: float = 1.0,
) -> Iterator[PeriodicResponse | Sought]:
    """Yield the responses on curves that do not hang together with known ones.

    They are sought by homotopy in the drive at some frequencies, spread evenly. The
    first response to each side has ``event = "detached"``. After those found at a
    frequency comes what the search there was.

    Parameters
    ----------
    problem, rest, options
        As for :func:`frequency_response`.
    known
        The responses on the known curve.
    frequencies
        Number of them.
    effort
        What the search may cost, over the usual (theory §6.2).

    Raises
    ------
    ValueError
        If the effort is not positive.
    """
    from hbm.curves.detached import Search  # with folds along a parameter
    from hbm.curves.drive_search import Sought

    check_positive("effort", effort)
    small, still, shapes = dense_problem(problem, rest, resolved_up_to(options))
    path = along_frequency(small, still, options.start, options.end)
    shares = (np.arange(frequencies) + 0.5) / frequencies
    places = options.start + shares * (options.end - options.start)
    with one_thread(), placed(hertz):
        search = Search(small, path, options, effort)
        for made in search.curves(known, places.tolist()):
            if isinstance(made, Sought):
                yield made
            else:
                yield replace(made, shapes=shapes)
