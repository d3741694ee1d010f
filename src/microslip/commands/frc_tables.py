"""What a frequency response says of itself on the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import (
    decimal,
    force,
    headed,
    hertz,
    span,
    tabled,
    titled,
)

if TYPE_CHECKING:
    from microslip.scenes.scene import Scene
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


def resolution(curve: ResponseCurve) -> str:
    """Return how accurate the curve is, and with how many harmonics."""
    import numpy as np

    known = 100.0 * curve.error[np.isfinite(curve.error)]
    lost = curve.error.size - known.size
    error = (
        f"at most {known.max():.2g} % at a point, {float(np.median(known)):.2g} % in "
        "the median"
        if known.size
        else "not known"
    )
    if known.size and lost:
        error += f", not known at {lost} of {curve.error.size} points"
    return (
        f"estimated error of amplitude: {error}; "
        f"{span(curve.harmonics, 'harmonic')}, {span(curve.samples, 'sample')}"
    )


def contact_errors(curve: ResponseCurve) -> list[str]:
    """Return how accurate energies and forces of the contacts are, a line each."""
    import numpy as np

    lines = []
    for what, taken, error in (
        ("friction", curve.friction_energy, curve.friction_energy_error),
        ("damping", curve.damping_energy, curve.damping_energy_error),
    ):
        most, known = abs(taken).max(initial=0.0), error[np.isfinite(error)]
        if most == 0.0 or not known.size:
            continue
        largest, middle = 100.0 * known.max() / most, 100.0 * np.median(known) / most
        lines.append(
            f"estimated error of what {what} takes out: at most {largest:.2g} % of its "
            f"largest, {middle:.2g} % in the median"
        )
    worst = curve.normal_error.max(axis=1, initial=0.0)
    known = worst[np.isfinite(worst)]
    if known.any():
        lines.append(
            f"estimated error of {force(pulls=curve.pulls)}s: at most "
            f"{known.max():.2g} N, {np.median(known):.2g} N in the median"
        )
    return lines


def uncounted(scene: Scene) -> list[str]:
    """Return what of a scene's model that error does not count, a line each."""
    from microslip.scenes.bladed_disk.tables import BladedDisk
    from microslip.scenes.two_blades.tables import TwoBlades

    if isinstance(scene.rig, TwoBlades | BladedDisk):
        return []
    from microslip_mechanics.laws.iwan import Iwan

    lines = []
    reduction = scene.rig.structure.reduction
    if reduction is not None:
        lines.append(
            f"not in it: the reduction to modes up to {reduction.highest:g} Hz, beyond "
            "which harmonics may lie, and without which peaks may lie elsewhere: "
            "microslip explain tells by how much; see whether the curve changes with "
            "a higher structure.reduction.highest"
        )
    for name, law in scene.rig.element.items():
        if isinstance(law, Iwan):
            lines.append(
                f"not in it: element {name} is {law.sliders} sliders, whose force is "
                f"up to {law.backbone_error:.1e} of slip_force above its law's: more "
                f"of them, or a smaller element.{name}.smallest, are nearer to it"
            )
    return lines
