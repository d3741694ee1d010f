"""Small dense algebra for kernels: a library call costs more than it computes here."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel


@bare_kernel
def eliminate(matrix: Array, right: Array) -> bool:
    """Solve by Gaussian elimination with row pivots; return False if singular.

    ``right``, shape ``(n,)``, becomes the solution; ``matrix`` is overwritten.
    """
    size = right.size
    for k in range(size):
        if not _pivoted(matrix, right, k):
            return False
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, size):
            factor = matrix[i, k] * inverse
            if factor != 0.0:
                for j in range(k + 1, size):
                    matrix[i, j] -= factor * matrix[k, j]
                right[i] -= factor * right[k]
    for k in range(size - 1, -1, -1):
        for j in range(k + 1, size):
            right[k] -= matrix[k, j] * right[j]
        right[k] /= matrix[k, k]
    return True


@inner_kernel
def _pivoted(matrix: Array, right: Array, k: int) -> bool:
    """Bring the largest entry of a column to its diagonal; return if it has one."""
    size = right.size
    pivot, largest = k, abs(matrix[k, k])
    for i in range(k + 1, size):
        if abs(matrix[i, k]) > largest:
            pivot, largest = i, abs(matrix[i, k])
    if pivot != k:
        for j in range(k, size):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        right[k], right[pivot] = right[pivot], right[k]
    return bool(largest > 0.0)


@bare_kernel
def copy(source: Array, target: Array) -> None:
    """Write one vector into another."""
    for i in range(source.size):
        target[i] = source[i]


@bare_kernel
def copy_rows(source: Array, target: Array) -> None:
    """Write one matrix into another."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j] = source[i, j]


@bare_kernel
def combine(first: Array, factor: float, second: Array, target: Array) -> None:
    """Write a vector plus a multiple of another."""
    for i in range(target.size):
        target[i] = first[i] + factor * second[i]


@bare_kernel
def dot(left: Array, right: Array) -> float:
    """Return the inner product of two vectors."""
    total = 0.0
    for i in range(left.size):
        total += left[i] * right[i]
    return total


@bare_kernel
def norm(vector: Array) -> float:
    """Return the Euclidean length of a vector."""
    return float(np.sqrt(dot(vector, vector)))
