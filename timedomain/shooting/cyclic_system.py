"""A chain of linear steps that ends where it began, solved without being followed."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array


def cyclic_solution(maps: Array, sources: Array) -> Array:
    """Return z with z₁ = Φ₀ z₀ + h₀, …, z₀ = Φₙ zₙ + hₙ, however much the maps grow.

    Orthogonal transformations remove one z after the other and keep the scale of both
    directions of time (structured elimination, Wright 1992).

    Parameters
    ----------
    maps
        Φ, shape (links, size, size).
    sources
        h, shape (links, size).

    Returns
    -------
    Shape (links, size).
    """
    links, size = sources.shape
    # first z₀ + last z = right
    first, last, right = -maps[0], np.eye(size), sources[0]
    removed = []
    for link in range(1, links):
        left = np.vstack([last, -maps[link]])
        others = np.zeros((2 * size, 2 * size + 1))
        others[:size, :size] = first
        others[size:, size:-1] = np.eye(size)
        others[:, -1] = np.append(right, sources[link])
        (reflected, scales), upper = scipy.linalg.qr(left, mode="raw")
        turned, _, _ = scipy.linalg.lapack.dormqr(
            "L", "T", reflected, scales, others, max(1, 64 * others.shape[1])
        )
        removed.append((upper[:size], turned[:size]))
        first, last = turned[size:, :size], turned[size:, size:-1]
        right = turned[size:, -1]
    found = np.empty((links, size))
    found[0] = following = np.linalg.solve(first + last, right)
    for link in range(links - 1, 0, -1):
        upper, row = removed[link - 1]
        rest = row[:, -1] - row[:, :size] @ found[0] - row[:, size:-1] @ following
        found[link] = following = scipy.linalg.solve_triangular(upper, rest)
    return found
