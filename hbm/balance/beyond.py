"""What harmonics beyond those of a point do to the ones that it has (theory §6.3)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hbm.balance.linearisation import Linearisation
from hbm.balance.refined import Refined, Resolved
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array

REACH = 31
"""harmonics that are looked at, at the least"""
AGAIN = 2.0
"""times what an octave changes: all others may change as much, as where each has a mode
that an order meets"""


def wider(fourier: FourierBasis) -> FourierBasis:
    """Return a resolution with an octave of harmonics beyond, or more."""
    harmonics = max(fourier.doubled.harmonics, REACH)
    samples = max(fourier.samples, 4 * harmonics + 4)
    return replace(fourier, harmonics=harmonics, samples=samples)


def answered(
    system: Resolved, made: Refined, fourier: FourierBasis, rank: int, normal: Array
) -> Array:
    """Return the point after some steps once orders beyond have answered it.

    Each of them answers the forces of the contacts by itself, and the point answers
    what their motion changes, to first order and in the plane normal to ``normal``.

    Parameters
    ----------
    system
        The balance at the resolution that is :func:`wider` than ``fourier``.
    made
        The point, and the derivative about it.
    fourier
        Resolution of the point.
    rank
        Number of components of a point for each Fourier coefficient.
    normal
        As that of the steps.
    """
    last, low = made.corrected, rank * fourier.coefficients
    point = _widened(last, fourier, rank)
    residual = system.residual(point)
    step = system.answer(point, residual, fourier.harmonics)
    change = np.zeros_like(last)
    change[:low] = (system.residual(point + step) - residual)[:low]
    moved: Array = last - made.slope.solve(normal, change)
    return moved


def stepped(
    system: Resolved, made: Refined, fourier: FourierBasis, rank: int, normal: Array
) -> Array | None:
    """Return the point once orders beyond have moved it, and others as far again.

    That is twice a Newton step with all of them, or two where both lead farther, as
    contacts slip elsewhere after the first. None where iterations do not give that.
    Parameters are those of :func:`answered`.
    """
    low = rank * fourier.coefficients
    point, border = (_widened(each, fourier, rank) for each in (made.corrected, normal))
    step = _iterated(system, point, border)
    if step is None:
        return None
    more = _iterated(system, point + step, border)
    steps = [step] if more is None else [step, step + more]
    moved = point + AGAIN * max(steps, key=lambda each: np.linalg.norm(each[:low]))
    return np.append(moved[:low], moved[-1])


def _iterated(system: Resolved, point: Array, border: Array) -> Array | None:
    """Return a Newton step in the plane normal to ``border``, if iterations give it."""
    residual, linearised = system(point)
    if not isinstance(linearised, Linearisation):
        return None
    return linearised.iterated(border, np.append(-residual, 0.0))


def _widened(point: Array, fourier: FourierBasis, rank: int) -> Array:
    """Return a point, or a row, with room for orders beyond."""
    low = rank * fourier.coefficients
    more = rank * wider(fourier).coefficients - low
    return np.concatenate([point[:low], np.zeros(more), point[-1:]])
