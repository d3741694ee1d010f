"""Where a nonlinear mode begins: as the linear one, in small motions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from hbm.errors import ContinuationError
from hbm.modes.linear_modes import LinearMode
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import NonlinearMode, nonlinear_mode
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState

ALIKE = 0.9
"""likeness, below which a motion is another one: it is one but for parts in a thousand
where motions are small, unless another mode has nearly the same frequency"""
SMALLER = 4
"""powers of ten by which amplitudes may begin smaller than asked for, until they are"""


def begun(
    problem: Problem, rest: StaticState, linear: LinearMode, options: ModeOptions
) -> Iterator[NonlinearMode]:
    """Yield the points of a mode from an amplitude on at which it is the linear one.

    Where another mode has nearly the same frequency that is smaller than asked for. If
    none is found, it begins as it was asked to.
    """
    for power in range(SMALLER + 1):
        begins = replace(options, smallest=options.smallest / 10.0**power)
        growth = nonlinear_mode(problem, rest, linear, begins)
        try:
            first = next(growth, None)
        except ContinuationError:
            if power == 0:
                raise
            break
        if first is not None and likeness(problem, linear, first) >= ALIKE:
            yield first
            yield from growth
            return
    yield from nonlinear_mode(problem, rest, linear, options)


def likeness(problem: Problem, linear: LinearMode, point: NonlinearMode) -> float:
    """Return which share of a motion has the shape of a linear mode.

    Of the first harmonic, by kinetic energy: the modal assurance criterion with the
    mass matrix.
    """
    mass, shape = problem.structure.mass, linear.shape
    moved = point.coefficients[1] - 1j * point.coefficients[2]
    both = abs(shape.conj() @ (mass @ moved)) ** 2
    alone = [float((each.conj() @ (mass @ each)).real) for each in (shape, moved)]
    return float(both / (alone[0] * alone[1]))
