"""What a frequency response says of itself on the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import (
    decimal,
    force,
    headed,
    hertz,
    tabled,
    titled,
)

if TYPE_CHECKING:
    from microslip.studies.curve import Traced
    from microslip_mechanics.results.response_curve import ResponseCurve
    from microslip_mechanics.static import StaticState


def table(traced: Traced) -> str:
    """Return the curve at about a dozen points, among them its largest amplitude."""
    from microslip.studies.curve import shown_points

    curve = traced.curve
    presses = bool(curve.normal_smallest.any() or curve.normal_largest.any())
    rubs = bool(curve.friction_energy.any())
    probes = tabled(curve.probes, curve.amplitude.max(axis=0))
    names = [curve.probes[each] for each in probes]
    head = f"frequency {titled(' first harmonic [mm]', names, len(curve.probes))}"
    units = f"     [Hz] {headed(names)}"
    if rubs:
        head, units = f"{head}     friction", f"{units}  [mJ/period]"
    if presses:
        title = f"{force(pulls=curve.pulls)} [N]"
        head, units = f"{head}      {title:>16}", f"{units}     least      most"
    lines = [head, units]
    largest = int(curve.amplitude.max(axis=1).argmax())
    energy, frequencies = curve.friction_energy, curve.frequency / math.tau
    forces = curve.normal_smallest, curve.normal_largest
    hardest = max(abs(each).max(initial=0.0) for each in forces)
    for place in shown_points(curve, largest):
        values = [
            f"{hertz(frequencies[place], frequencies):>9}",
            *(
                decimal(1e3 * each[place], 1e3 * each.max(), 5)
                for each in curve.amplitude.T[probes]
            ),
        ]
        if rubs:
            values.append(decimal(1e3 * energy[place], 1e3 * energy.max(), 6, 12))
        if presses:
            ends = forces[0][place].min(), forces[1][place].max()
            values += [decimal(each, hardest, 3, 9) for each in ends]
        mark = "  largest" if place == largest else ""
        lines.append(" ".join(values) + mark)
    return "\n".join(lines)


def rest(curve: ResponseCurve, state: StaticState) -> str:
    """Return the forces of contacts under the preload alone.

    Contacts that have none at any time, such as those under a constant load, are left
    out.
    """
    pressed = state.normal_force != 0.0
    pressed |= (curve.normal_smallest != 0.0).any(axis=0)
    pressed |= (curve.normal_largest != 0.0).any(axis=0)
    hardest = abs(state.normal_force).max(initial=0.0)
    forces = ", ".join(
        f"{curve.contacts[place]} "
        f"{decimal(state.normal_force[place], hardest, 3).strip()}"
        for place in pressed.nonzero()[0]
    )
    return f"{force(pulls=curve.pulls)} at rest [N]: {forces}"
