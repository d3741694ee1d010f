"""Static equilibrium under the preload, friction at rest (theory §5)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.potential import potential
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction.reduction import reduced

TOLERANCE = 1e-10
"""largest unbalanced force over the largest load"""
BEGIN, STEPS = 1e-5, 400
"""pseudo-time with which a descent begins [s], and steps after which it is given up"""
FAR = 1.0
"""displacement [m or rad] from which a body that only contact holds is driven away"""
NEAR, ENDLESS = 1e-12, 1e12
"""displacements [m or rad] between which a place lower than rest is sought"""
NEGATIVE = 1e-10
"""curvature over stiffness from which on it is more than rounding makes"""
HILLTOPS = 32
"""unstable places of rest, one below the other, after which no more are left"""
HELD = 1e-12
"""smallest stiffness over the largest, from which a structure holds by itself"""


class StaticError(MicroslipError):
    """The preload has no static equilibrium."""


@dataclass(frozen=True, slots=True)
class StaticState:
    """Equilibrium of structure and normal contact forces."""

    displacement: Array
    """[m], shape (dofs,)"""
    normal_force: Array
    """[N], shape (points,)"""
    residual: float
    """largest unbalanced force over the largest load"""
    iterations: int


def static_equilibrium(problem: Problem) -> StaticState:
    """Return the frictionless equilibrium under the preload.

    Regularised friction carries no load at rest, so the normal forces alone balance
    the preload. The potential energy is descended by Newton steps whose matrix is
    M/τ² + K + contact (pseudo-transient continuation), so that a body which contact
    alone holds, and even one which nothing holds along a load-free direction, makes no
    singular matrix. A hilltop or a saddle, as between two wells, is left downhill, to
    the side of the preload.

    A sparse structure deflects in the shapes that its contacts and the preload impose;
    what is unstable in those alone is seen.

    Raises
    ------
    StaticError
        If the preload drives a body away that only contact holds: nothing balances it.
    ValueError
        If a sparse structure can move freely while all contacts stick.
    """
    if problem.structure.sparse:
        reduction = reduced(problem, 0.0)
        small = static_equilibrium(reduction.problem)
        return replace(small, displacement=reduction.shapes @ small.displacement)
    state = np.zeros(problem.structure.dofs)
    at_zero = potential(problem, state)
    load = max(np.abs(problem.preload).max(initial=0.0), np.abs(at_zero.gradient).max())
    found = StaticState(state, at_zero.normal_force, 0.0, 0)
    if load > 0.0:
        found = _descended(problem, state, load, _limit(problem))
    for _ in range(HILLTOPS):
        lower = _below(problem, found.displacement)
        if lower is None:
            return found
        found = _descended(problem, lower, load, np.inf)
    raise StaticError("rest is unstable wherever it is sought: check the springs")


def _descended(
    problem: Problem, state: Array, load: float, limit: float
) -> StaticState:
    """Return where the potential energy has no slope, from a place at least as high.

    ``load`` is what forces are compared with [N], besides what springs hold there.
    """
    here, pseudo_time = potential(problem, state), BEGIN
    for iteration in range(1, STEPS):
        matrix = problem.structure.mass / pseudo_time**2 + here.hessian
        step = np.linalg.solve(matrix, -here.gradient)
        trial = potential(problem, state + step)
        noise = _rounding(problem, state) * np.abs(state).sum()
        highest = here.energy + 1e-12 * abs(here.energy) + noise
        if trial.energy > highest or here.gradient @ step > 0.0:
            pseudo_time *= 0.25
            continue
        state, here, pseudo_time = state + step, trial, pseudo_time * 2.0
        size = load or _held(problem, state)
        residual = float(np.abs(here.gradient).max()) / size
        if residual <= TOLERANCE + _rounding(problem, state) / size:
            return StaticState(state, here.normal_force, residual, iteration)
        if not np.abs(state).max() <= limit or not np.isfinite(here.energy):
            break
    raise StaticError(
        f"the static preload (largest load {load:g} N) has no equilibrium in contact "
        f"within {FAR:g} m, after {iteration} steps: check its direction and size, and "
        "the contact"
    )


def _below(problem: Problem, state: Array) -> Array | None:
    """Return a place below one without a slope, or None if that is a minimum.

    It is the lowest along the motion that rest gives way to, which is sought where the
    Hessian has a negative eigenvalue beyond rounding. Where the energy falls without
    end there is no other place to rest, and that one is kept: its poles tell that it is
    unstable, or friction, which is not looked at here, holds it.
    """
    energy, _, _, hessian = potential(problem, state)
    size, direction = _weakest(hessian)
    if direction is None or not problem.interface.count:
        return None
    if problem.preload @ direction < 0.0:
        direction = -direction
    noise = 1e-14 * abs(energy) + _rounding(problem, state) * np.abs(state).sum()
    far = max(NEAR, (2.0 * noise / size) ** 0.5)
    lowest, place = energy, state
    while far < ENDLESS:
        trial = potential(problem, state + far * direction).energy
        if not trial < lowest:
            return place if lowest < energy - noise else None
        lowest, place, far = trial, state + far * direction, 2.0 * far
    return None


def _weakest(hessian: Array) -> tuple[float, Array | None]:
    """Return the most negative curvature and its motion, of length 1, if there is one.

    Degrees of freedom are scaled by their own stiffness, as rotations need it.
    """
    diagonal = np.abs(np.diag(hessian))
    scale = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, diagonal.max() or 1.0))
    scaled = scale[:, None] * hessian * scale
    try:
        np.linalg.cholesky(scaled + NEGATIVE * np.eye(len(scaled)))
    except np.linalg.LinAlgError:
        values, motions = np.linalg.eigh(scaled)
        if values[0] < -NEGATIVE:
            motion = scale * motions[:, 0]
            motion /= np.linalg.norm(motion) * np.sign(motion[np.abs(motion).argmax()])
            return float(-motion @ hessian @ motion), motion
    return 0.0, None


def _held(problem: Problem, state: Array) -> float:
    """Return the largest force that springs hold [N]."""
    held = np.abs(problem.structure.stiffness) @ np.abs(state)
    return float(held.max()) or 1.0


def _limit(problem: Problem) -> float:
    """Return the displacement that means that a body is driven away [m]."""
    sizes = np.linalg.eigvalsh(problem.structure.stiffness)
    return np.inf if sizes[0] > HELD * sizes[-1] else FAR


def _rounding(problem: Problem, state: Array) -> float:
    """Return the force that rounding alone leaves unbalanced [N]."""
    terms = np.abs(problem.structure.stiffness) @ np.abs(state)
    return float(4.0 * np.finfo(float).eps * terms.max())
