"""What is found of a case under stress, and what it is worth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from microslip.studies.stress.case import Case
from timedomain.shooting.comparison import COVERAGE, Comparison

AGREED = 0.01
"""relative difference of amplitudes up to which the solvers agree"""


class Outcome(Enum):
    """How a case ended."""

    AGREES = "agrees"
    WITHIN = "agrees within 1 %"
    HONEST = "honest outcome"
    DISAGREES = "disagrees"
    REFUSED = "refused"


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found of a case so far."""

    outcome: Outcome = Outcome.HONEST
    cause: str = ""
    """why it is not better; empty where the solvers agree as both estimate"""
    points: int = 0
    """of the curve"""
    harmonics: int = 0
    """at the largest amplitude"""
    iterations: float = 0.0
    """Newton's, per point of the curve"""
    compared: int = 0
    """points at which the other solver has come to an end"""
    difference: float = math.nan
    """largest one of the amplitudes, relative"""
    estimated: float = math.nan
    """what both solvers estimate of it"""
    steps: int = 0
    """of a period in time"""
    condition: float = math.nan
    """of harmonic balance's Jacobian at the largest amplitude, in the 1-norm"""


@dataclass(frozen=True, slots=True)
class Tried:
    """A case and how it went."""

    case: Case
    finding: Finding
    seconds: float
    """of processor time"""


def rate(found: Sequence[Tried]) -> tuple[int, int]:
    """Return how many cases agree within 1 % in both solvers, and of how many."""
    solved = [each for each in found if not each.case.refusals]
    good = (Outcome.AGREES, Outcome.WITHIN)
    return sum(each.finding.outcome in good for each in solved), len(solved)


def judged(comparison: Comparison) -> tuple[Outcome, str]:
    """Return the outcome of a comparison, and its cause if it is not the best."""
    apart = f"amplitudes differ by {comparison.difference:.1e}"
    if comparison.difference > AGREED:
        if comparison.agrees:
            return Outcome.HONEST, f"{apart}, as the estimates admit"
        both = comparison.admitted + (COVERAGE - 1.0) * comparison.found_error
        if comparison.found_error > AGREED and comparison.difference <= both:
            doubt = f"shooting is no better than {comparison.found_error:.1e}"
            return Outcome.HONEST, f"{apart}; {doubt}"
        return Outcome.DISAGREES, f"{apart}; {comparison.admitted:.1e} is estimated"
    if not comparison.agrees:
        return Outcome.WITHIN, f"{apart}; {comparison.admitted:.1e} is estimated"
    if not comparison.as_stable:
        return Outcome.WITHIN, (
            f"largest multiplier {comparison.multiplier:.5g} and "
            f"{comparison.found_multiplier:.5g}"
        )
    return Outcome.AGREES, ""


def causes(*each: str) -> str:
    """Return causes one after the other, without empty ones."""
    return "; ".join(filter(None, each))
