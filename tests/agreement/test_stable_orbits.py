"""Stability by harmonic balance, by the time domain and by marches, on a few points."""

import functools

import numpy as np
import pytest

from benchmarks.stability import VARIANTS, Comparison, chosen, compared, traced


@functools.cache
def comparisons() -> list[Comparison]:
    problem, curve = traced(VARIANTS["A, gkf"])
    return [compared(problem, point) for point in chosen(curve, 4)]


@pytest.mark.long
@pytest.mark.slow
def test_leading_multipliers_of_both_routes_agree() -> None:
    for row in comparisons():
        # measured 2e-4 for the largest, 5e-4 for the first four
        assert row.agrees
        assert row.others <= 1e-3


@pytest.mark.long
@pytest.mark.slow
def test_a_march_leaves_what_is_unstable_and_keeps_the_rest() -> None:
    rows = comparisons()
    largest = np.array([row.balance[0] for row in rows])

    assert all(row.kept for row in rows)
    # Both kinds are among the points; creep of sticking contacts is close to 1.
    assert largest.max() > 1.01
    assert (largest < 1.0).sum() >= 2
    # measured up to 8e-3
    for row in rows:
        assert row.march[0] == pytest.approx(row.balance[0], abs=0.01)
