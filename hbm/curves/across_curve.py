"""Responses with more and more harmonics in the plane across a curve (theory §6.7)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from hbm.balance.residual import HarmonicBalance
from hbm.balance.rigid import pushed
from hbm.continuation.arc import plane_across, tangent, upright
from hbm.continuation.corrected import lost
from hbm.continuation.correction import Outcome
from hbm.continuation.linearised import SingularError
from hbm.continuation.newton import correct
from hbm.continuation.step_control import StepControl
from hbm.curves.dense_problem import RESOLVED, dense_problem
from hbm.curves.response import response
from hbm.errors import ContinuationError, hertz, placed
from hbm.forces.fourier import FourierBasis, usual_samples
from hbm.one_thread import one_thread
from hbm.paths.path import AlongFrequency, along_frequency
from hbm.paths.path_metric import path_metric
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState


def responses_across(
    problem: Problem,
    rest: StaticState,
    known: PeriodicResponse,
    limits: tuple[float, float],
    orders: Sequence[int],
) -> Iterator[PeriodicResponse]:
    """Yield responses with more and more harmonics, each sought from the one before.

    All lie in the plane through ``known`` across its curve. At a peak, where the curve
    goes on by its phase, amplitude and frequency change in it.

    Parameters
    ----------
    problem, rest, known
        What is solved, its static equilibrium, and the response.
    limits
        Range of the curve [rad/s].
    orders
        Numbers of harmonics.

    Raises
    ------
    ContinuationError
        If a response does not converge, or the curve has no tangent.
    """
    small, still, shapes = dense_problem(problem, rest, RESOLVED * max(limits))
    path = along_frequency(small, still, *limits)
    control = StepControl(tolerance=1e-8 * problem.force_scale)
    balance = path.balance(FourierBasis(known.harmonics, known.samples))
    rows = path.problem.map_from(problem.interface.displacement)
    point = pushed(balance, balance.point(known.seen(rows), known.frequency))
    with one_thread(), placed(hertz):
        normal = _normal(path, balance, point)
        for harmonics in orders:
            balance = path.balance(FourierBasis(harmonics, usual_samples(harmonics)))
            point, normal = _longer(balance, point), _longer(balance, normal)
            found = correct(
                *(balance, point, normal),
                tolerance=control.tolerance,
                max_iterations=60,
            )
            if found.outcome is not Outcome.CONVERGED:
                raise lost("no response is found", known.frequency, found, control)
            point = found.point
            yield replace(response(small, balance, found), shapes=shapes)


def _normal(path: AlongFrequency, balance: HarmonicBalance, point: Array) -> Array:
    """Return the normal of the plane across the curve.

    Raises
    ------
    ContinuationError
        If the curve has no tangent that leads to other frequencies.
    """
    scale = path_metric(path, point)
    _, linearised = balance(point)
    try:
        along = tangent(linearised, upright(point), scale)
    except SingularError:
        raise ContinuationError(
            "the curve has no tangent where a response is sought"
        ) from None
    return plane_across(along, scale)


def _longer(balance: HarmonicBalance, point: Array) -> Array:
    """Return a point with room for the harmonics of a balance."""
    held = point[:-1]  # nothing where the structure moves freely
    coefficients = held.reshape(held.size // max(balance.rank, 1), balance.rank)
    return balance.point(coefficients, float(point[-1]))
