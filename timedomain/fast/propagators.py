"""What a step makes of the modes' state and of the forces on them (theory, §7.2).

A stage is z_k = E_k z_0 + Σ_j Q_kj f_j in each mode, with z = (q, q̇) and the modal
forces f_j of the stages j = 0 … k.
"""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from timedomain.fast.coordinates import Modes
from timedomain.fast.schemes import Scheme


def propagators(scheme: Scheme, modes: Modes, step: float) -> tuple[Array, Array]:
    """Return E and Q of a step [s], stages first and modes before the rest."""
    if scheme.mean:
        return _exact(modes, step)
    return _implicit(scheme, modes, step)


def embedded_difference(
    scheme: Scheme, modes: Modes, step: float, free: Array, forced: Array
) -> tuple[Array, Array]:
    """Return the filtered difference from the embedded solution, as E and Q."""
    system = _system(modes)
    weights = step * (scheme.matrix[-1] - scheme.other)
    solver = np.linalg.inv(np.eye(2) - step * scheme.matrix[-1, -1] * system)
    by_state = sum(w * system @ each for w, each in zip(weights, free, strict=True))
    by_force = sum(
        w * np.einsum("mab,jmb->jma", system, each)
        for w, each in zip(weights, forced, strict=True)
    )
    by_force[:, :, 1] += weights[:, None]
    return solver @ by_state, np.einsum("mab,jmb->jma", solver, by_force)


def _implicit(scheme: Scheme, modes: Modes, step: float) -> tuple[Array, Array]:
    """Return E and Q of a Runge–Kutta scheme."""
    system, stages = _system(modes), scheme.stages
    count = len(system)
    free = np.zeros((stages + 1, count, 2, 2))
    forced = np.zeros((stages + 1, stages + 1, count, 2))
    free[0] = np.eye(2)
    for stage in range(1, stages + 1):
        row = step * scheme.matrix[stage]
        free[stage] = np.eye(2)
        for before in range(stage):
            free[stage] += row[before] * system @ free[before]
            forced[stage] += row[before] * np.einsum(
                "mab,jmb->jma", system, forced[before]
            )
            forced[stage, before, :, 1] += row[before]
        forced[stage, stage, :, 1] += row[stage]
        solver = np.linalg.inv(np.eye(2) - row[stage] * system)
        free[stage] = solver @ free[stage]
        forced[stage] = np.einsum("mab,jmb->jma", solver, forced[stage])
    return free, forced


def _exact(modes: Modes, step: float) -> tuple[Array, Array]:
    """Return E and Q for a force that is linear over the step, solved exactly."""
    count = modes.stiffness.size
    augmented = np.zeros((count, 4, 4))
    augmented[:, :2, :2] = step * _system(modes)
    augmented[:, 1, 2], augmented[:, 2, 3] = step, 1.0
    moved = scipy.linalg.expm(augmented)
    free = np.stack([np.broadcast_to(np.eye(2), (count, 2, 2)), moved[:, :2, :2]])
    forced = np.zeros((2, 2, count, 2))
    forced[1, 1] = moved[:, :2, 3]
    forced[1, 0] = moved[:, :2, 2] - moved[:, :2, 3]
    return free, forced


def _system(modes: Modes) -> Array:
    """Return (q, q̇) to its rate in each mode, shape (modes, 2, 2)."""
    system = np.zeros((modes.stiffness.size, 2, 2))
    system[:, 0, 1] = 1.0
    system[:, 1, 0], system[:, 1, 1] = -modes.stiffness, -modes.damping
    return system
