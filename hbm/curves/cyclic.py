"""One sector of a bladed disk in place of all (theory §6.6)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from hbm.balance.pinned import pinned
from hbm.balance.relative import RelativeProblem
from hbm.curves.tracer import Tracer
from hbm.errors import hertz, placed
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency, moving_path
from hbm.structure.cyclic_structure import CyclicStructure
from microslip_mechanics.cyclic import CyclicProblem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState, static_equilibrium


def cyclic_response(
    problem: CyclicProblem, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses of one sector along a frequency response curve.

    The other sectors move like it, each ahead of the one before by ``problem.lead``.
    Energies are those that all of them take out. Floquet multipliers are not computed:
    a disturbance need not travel like that. Residual tractions that are looked for are
    those alike in all sectors.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    ValueError
        If a frequency is not positive, or the contacts see a wave in part only.
    """
    standing = problem.standing()
    path = along_sector(problem, options.start, options.end, pruned=options.pruned)
    tracer = Tracer(standing, path, replace(options, stability=False))
    with one_thread(), placed(hertz):
        for each in tracer.responses():
            yield _of_all(each, problem.sectors)


def _of_all(response: PeriodicResponse, sectors: int) -> PeriodicResponse:
    """Return the response of one sector with the energies of all."""
    return replace(
        response,
        friction_energy=sectors * response.friction_energy,
        damping_energy=sectors * response.damping_energy,
        friction_error=sectors * response.friction_error,
        damping_error=sectors * response.damping_error,
    )


def along_sector(
    problem: CyclicProblem, start: float, end: float, *, pruned: bool = True
) -> AlongFrequency:
    """Return the path of a sector's curve between two frequencies [rad/s]."""
    standing = problem.standing()
    whole = cyclic_problem(problem, static_equilibrium(standing))
    relative = replace(whole, pruned=pruned)
    return moving_path(standing, relative, start, abs(end - start), symmetry=pruned)


def cyclic_problem(problem: CyclicProblem, rest: StaticState) -> RelativeProblem:
    """Return the problem of one sector in the relative coordinates of its contacts."""
    seen = np.hstack([problem.interface.displacement, problem.to_next])
    basis, selection = replace(problem.interface, displacement=seen).relative_motion()
    own, following = np.split(selection, 2, axis=1)
    condensed = CyclicStructure(problem, own, following)
    rank = basis.shape[1]
    made = RelativeProblem(
        problem.interface.points,
        basis,
        own + following,
        np.zeros(basis.shape[0]),
        condensed,
        np.array([problem.preload, -1j * problem.drive]),
        np.zeros((rank, 0)),
        np.zeros((rank, rank)),
        (own + following) @ rest.displacement,
        np.zeros(problem.sector.dofs),
    )
    return pinned(made)
