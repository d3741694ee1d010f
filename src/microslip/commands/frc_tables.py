"""What a frequency response says of itself on the terminal."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from microslip.commands.columns import (
    about,
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

SECTOR = (
    "stability is not known: motions of one sector cannot break the symmetry of the "
    "disk; --set solve=disk tells it"
)
"""of the curve of one sector"""


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


def events(curve: ResponseCurve, *, sector: bool = False) -> str:
    """Return what was located on the curve, where it is missing and unstable.

    ``sector`` says that it is that of one sector, which stands for a disk.
    """
    from microslip.studies.gaps import lines as gap_lines

    lines, frequencies = [], curve.frequency / math.tau
    for place, name in enumerate(curve.event):
        if name:
            where = hertz(frequencies[place], frequencies, 6)
            largest = 1e3 * curve.amplitude[place].max()
            size = decimal(largest, largest, 6, 12)
            aside = about(curve.parameter_error[place] / math.tau)
            lines.append(
                f"{name:<16} {where:>12} Hz{aside:<10} {size} mm"
                f"{about(100.0 * curve.error[place], ' %')}"
            )
    lines += gap_lines(curve)
    lines += _beginnings(curve)
    if not curve.peak.any():
        lines.append("nothing moves at any frequency: the scene has no drive")
    lines.append(SECTOR if sector else _stability(curve))
    return "\n".join(lines)


def _beginnings(curve: ResponseCurve) -> list[str]:
    """Return why pieces begin that do not go on where the one before ended."""
    first, lines = curve.frequency[0], []
    places = [place for place, name in enumerate(curve.event) if name == "restart"]
    reached = curve.frequency[places[0] - 1] if places else first
    known = {first, reached}
    for place in places:
        here = curve.frequency[place]
        begins = f"what begins at {here / math.tau:.6f} Hz"
        if reached == first and here not in known:
            lines.append(
                f"{begins} is a curve of its own: the one before came back to "
                f"{first / math.tau:.6f} Hz"
            )
            known.add(here)
        elif here in known:
            lines.append(
                f"{begins} comes in from beyond the range: a response there besides "
                "the one before"
            )
    return lines


def _stability(curve: ResponseCurve) -> str:
    """Return where the curve is unstable, as far as that is known."""
    unstable = curve.unstable > 0
    if unstable.any():
        seen = curve.frequency / math.tau
        low, high = seen[unstable].min(), seen[unstable].max()
        return (
            f"unstable at {unstable.sum()} of {unstable.size} points, between "
            f"{hertz(low, seen)} and {hertz(high, seen)} Hz; largest Floquet "
            f"multiplier {_multiplier(float(curve.multiplier.max()))}"
            f"{_doubted(curve)}"
        )
    stable = curve.unstable == 0
    if stable.all():
        return "every point is stable"
    if stable.any():
        return (
            f"{stable.sum()} of {stable.size} points are stable, of the others the "
            "stability is not known"
        )
    return (
        "stability is not known: there are no Floquet multipliers of rigid friction, "
        "or of contacts that remember beside regularised friction or a body that "
        "nothing holds; microslip verify finds them by shooting"
    )


def _doubted(curve: ResponseCurve) -> str:
    """Return of how many points the stability is not known, if there are some."""
    unknown = int((curve.unstable < 0).sum())
    return f"; not known of {unknown}" if unknown else ""


def _multiplier(value: float) -> str:
    """Return one outside the unit circle with so many digits that it is not 1."""
    from microslip_mechanics.results.response import MARGIN

    digits = 1 - math.floor(math.log10(max(value - 1.0, MARGIN)))
    return f"{value:.{max(4, digits)}f}"


def barren(curve: ResponseCurve) -> list[float]:
    """Return the branch points at which no branch begins or ends [Hz]."""
    # a branch begins and ends with a copy of the point at which it does
    met, sought, found = Counter(curve.frequency), True, []
    for frequency, mark in zip(curve.frequency, curve.event, strict=True):
        if mark in ("branch", "detached"):  # what branches off branches is not sought
            sought = mark == "detached"
        if sought and mark == "branch point" and met[frequency] == 1:
            found.append(float(frequency) / math.tau)
    return found


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
