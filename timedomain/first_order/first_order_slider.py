"""The tractions that sliders hold in the first-order form, compiled."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel
from timedomain.first_order.first_order_system import ENERGIES, System


@kernel
def slide(
    system: System, point: int, slip: Array, held: Array, rate: Array, force: Array
) -> None:
    """Add the traction of one slider to its force, and write the traction's rate."""
    first, limit = 2 * system.slider[point], system.limit[point]
    stiff = system.points.tangential[point] / limit
    for axis in range(2):
        force[axis + 1] += limit * held[first + axis]
        rate[first + axis] = stiff * slip[axis + 1]
    if _slides(system, point, slip, held):
        one, two = held[first], held[first + 1]
        along = (one * slip[1] + two * slip[2]) / (one * one + two * two)
        rate[first] -= stiff * along * one
        rate[first + 1] -= stiff * along * two


@kernel
def slide_tangents(
    system: System, point: int, slip: Array, state: Array, matrix: Array
) -> None:
    """Add the derivatives of one slider's traction, its direction held."""
    modes, first = system.rates.size, 2 * system.slider[point]
    held = state[2 * modes : -ENERGIES]
    limit, pulled = system.limit[point], _slides(system, point, slip, held)
    stiff = system.points.tangential[point] / limit
    size = held[first] ** 2 + held[first + 1] ** 2
    for axis in range(2):
        row, column = 3 * point + 1 + axis, 2 * modes + first + axis
        for mode in range(modes):
            speed = system.slips[row, mode]
            matrix[modes + mode, column] -= limit * system.pulls[mode, row]
            matrix[-3, modes + mode] += (
                limit * held[first + axis] * (speed / system.energy)
            )
            matrix[column, modes + mode] += stiff * speed
            if pulled:
                for other in range(2):
                    share = stiff * held[first + axis] * held[first + other] / size
                    matrix[2 * modes + first + other, modes + mode] -= share * speed
        matrix[-3, column] += limit * slip[axis + 1] / system.energy


@kernel
def _slides(system: System, point: int, slip: Array, held: Array) -> bool:
    """Return whether a slider is at its limit and pulled further."""
    first = 2 * system.slider[point]
    one, two = held[first], held[first + 1]
    return bool(one * one + two * two >= 1.0 and one * slip[1] + two * slip[2] > 0.0)
