"""What a march says of its energies, its errors and its extremes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from microslip.commands.columns import force

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip_mechanics.results.envelope import Envelope
    from microslip_mechanics.results.extremes import Extremes
    from microslip_mechanics.results.time_history import TimeHistory

ROUNDING = 1e-14
"""of the largest energy, up to which another one is none"""
PARTED = 30.0
"""times its tolerance from which a march's peak is known less than steps explain"""
TOLD, SPARSE = 0.01, 0.2
"""share of an extreme that rows may miss, from which that is told; and from which they
are too sparse to tell how much it is"""


def energy_table(result: TimeHistory | Envelope) -> str:
    """Return energies and the closing error of their balance."""
    from microslip_mechanics.arrays import TINY
    from microslip_mechanics.results.energies import worded

    lines, pulls = [f"energy until {result.time[-1]:g} s [J]"], result.pulls
    least = _least(result)
    for name in result.energies:
        last = float(result.of(name)[-1])
        shown = last if abs(last) > least else 0.0
        lines.append(f"  {worded(name, pulls=pulls):20s} {shown:12.6g}")
    closing = float(abs(result.closing_error).max())
    share = closing / max(float(abs(result.of("input")).max()), TINY)
    lines.append(f"  {'closing error':20s} {closing:12.2g}  ({share:.1e} of the input)")
    return "\n".join(lines)


def estimates(result: TimeHistory | Envelope, found: Extremes) -> list[str]:
    """Return lines of the estimated errors, as far as the result tells them.

    Where friction takes out nothing but rounding, that of its energy is none. ``found``
    are the result's extremes, of all rows.
    """
    if not result.energy_error.size:
        return []
    rows, lines = result.of("friction"), []
    friction = abs(rows[-1])
    for name, values in (
        ("friction, error", result.energy_error),
        ("quadrature - work", result.work_difference),
    ):
        for value in values[-1:] if abs(rows).max() > _least(result) else ():
            share = f"  ({value / friction:.1e} of it)" if friction else ""
            lines.append(f"  {name:20s} {value:12.2g}{share}")
    missed = float(found.errors[0])
    peak = max(float(result.peak_error[-1]), missed)
    more = " or more" if missed > SPARSE else ""
    return [*lines, f"estimated error of the peak amplitude {peak:.1e}{more}"]


def _least(result: TimeHistory | Envelope) -> float:
    """Return the energy [J] up to which another one is rounding."""
    return ROUNDING * float(abs(result.energy[-1]).max())


def parting(result: TimeHistory | Envelope, tolerance: float) -> list[str]:
    """Return a line where a march cannot meet its tolerance, as its motion parts."""
    if not tolerance or not (result.peak_error[-1:] > PARTED * tolerance).any():
        return []
    return [
        "motions that begin alike part here, as those that rattle or are chaotic do: "
        "a smaller tolerance hardly lowers these errors"
    ]


def equal_steps(step: float) -> str:
    """Return a line where the steps of a march are the scene's [s]."""
    return (
        "contacts that remember or are rigid are marched with the scene's steps, "
        f"{step:g} s, and no tolerance: a smaller march.time_step lowers these errors"
    )


def extreme_lines(
    result: TimeHistory | Envelope, found: Extremes, pressed: Sequence[str]
) -> list[str]:
    """Return lines of the extremes of displacements, velocities and forces.

    ``found`` are those of all rows; ``pressed`` are the contacts that have normal
    forces at all.
    """
    from microslip_mechanics.results.response_curve import pulling

    lines = ["largest displacement [mm] and velocity [m/s]"]
    for name, far, fast in zip(result.probes, *found.largest, strict=True):
        lines.append(f"  {name:20s} {1e3 * far:12.6g} {fast:12.6g}")
    lines += _missed("velocity", float(found.errors[1]))
    if pressed:
        name_of_all = force(pulls=pulling(*found.normal))
        lines.append(f"{name_of_all} [N], least and most")
        for name, least, most in zip(result.contacts, *found.normal, strict=True):
            if name in pressed:
                lines.append(f"  {name:20s} {least:12.6g} {most:12.6g}")
        lines += _missed(name_of_all, found.force_error)
    if result.divided:
        lines.append(f"{result.divided} steps converged only when divided")
    return lines


def _missed(name: str, share: float) -> list[str]:
    """Return a line where rows may miss much of a largest value."""
    if share <= TOLD:
        return []
    more = " or more" if share > SPARSE else ""
    return [
        f"  rows may miss {100.0 * share:.0f} %{more} of the largest {name}: a smaller "
        "march.store_every or march.time_step tells more"
    ]
