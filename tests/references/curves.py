"""Oscillators of mass one on one element, and their curves with fixed harmonics."""

from __future__ import annotations

from collections.abc import Iterator

import microslip
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Law
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium


def oscillator(
    law: Law, *, stiffness: float = 1.0, damping: float = 0.0, drive: float = 1.0
) -> Problem:
    """Return 1 kg with an element to the ground, stiffness [N/m], damping [N s/m]."""
    ends = ("x1", "ground")
    if isinstance(law, NormalLoad):
        element = microslip.Element(law, tangents=[ends], name="element")
    else:
        element = microslip.Element(law, between=ends, name="element")
    return microslip.system(
        mass=[1.0],
        stiffness=[stiffness],
        damping=[damping],
        elements=[element],
        drive={"x1": drive},
    )


def curve(
    problem: Problem, lowest: float, highest: float, harmonics: int, samples: int
) -> list[PeriodicResponse]:
    """Return the points of a curve between two frequencies [rad/s]."""
    return list(_traced(problem, lowest, highest, harmonics, samples))


def point(
    problem: Problem, frequency: float, harmonics: int, samples: int
) -> PeriodicResponse:
    """Return the response at one frequency [rad/s]."""
    return next(_traced(problem, frequency, 1.01 * frequency, harmonics, samples))


def first(response: PeriodicResponse) -> float:
    """Return the amplitude [m] of the first harmonic of the first coordinate."""
    return abs(complex(response.coefficients[1, 0], response.coefficients[2, 0]))


def _traced(
    problem: Problem, lowest: float, highest: float, harmonics: int, samples: int
) -> Iterator[PeriodicResponse]:
    options = CurveOptions(
        lowest, highest, harmonics=harmonics, samples=samples, errors=False
    )
    yield from frequency_response(problem, static_equilibrium(problem), options)
