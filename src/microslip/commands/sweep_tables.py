"""What a march says of its energies, its errors and its extremes."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip_mechanics.envelope import Envelope
    from microslip_mechanics.time_history import TimeHistory

PARTED = 30.0
"""times its tolerance from which a march's peak is known less than steps explain"""


def energy_table(result: TimeHistory | Envelope) -> str:
    """Return energies and the closing error of their balance."""
    lines = [f"energy until {result.time[-1]:g} s [J]"]
    lines += [
        f"  {name.replace('_', ' '):20s} {result.of(name)[-1]:12.6g}"
        for name in result.energies
    ]
    closing = abs(result.closing_error).max()
    share = closing / max(abs(result.of("input")).max(), 1e-300)
    lines.append(f"  {'closing error':20s} {closing:12.2g}  ({share:.1e} of the input)")
    return "\n".join(lines)


def estimates(result: TimeHistory | Envelope) -> list[str]:
    """Return lines of the estimated errors, as far as the result tells them.

    Where there is no friction, that of its energy is none.
    """
    from microslip_mechanics.between_rows import rows_error
    from microslip_mechanics.envelope import Envelope

    if not result.energy_error.size:
        return []
    rows, lines = result.of("friction"), []
    friction = abs(rows[-1])
    for name, values in (
        ("friction, error", result.energy_error),
        ("quadrature - work", result.work_difference),
    ):
        for value in values[-1:] if rows.any() else ():
            share = f"  ({value / friction:.1e} of it)" if friction else ""
            lines.append(f"  {name:20s} {value:12.2g}{share}")
    peak = float(result.peak_error[-1])
    if not isinstance(result, Envelope):
        between = rows_error(result.time, result.displacement, result.velocity)
        peak = max(peak, between)
    return [*lines, f"estimated error of the peak amplitude {peak:.1e}"]


def parting(result: TimeHistory | Envelope, tolerance: float) -> list[str]:
    """Return a line where a march cannot meet its tolerance, as its motion parts."""
    if not tolerance or not (result.peak_error[-1:] > PARTED * tolerance).any():
        return []
    return [
        "motions that begin alike part here, as those that rattle or are chaotic do: "
        "a smaller tolerance hardly lowers these errors"
    ]


def extremes(result: TimeHistory | Envelope, pressed: Sequence[str]) -> list[str]:
    """Return lines of the extremes of displacements, velocities and forces.

    ``pressed`` are the contacts that have normal forces at all.
    """
    import numpy as np

    from microslip_mechanics.between_rows import largest
    from microslip_mechanics.envelope import Envelope

    if isinstance(result, Envelope):
        far = np.maximum(-result.lowest, result.highest).max(axis=0)
        fast = result.fastest.max(axis=0)
        normal = result.normal_smallest, result.normal_largest
    else:
        far, fast = largest(result.time, result.displacement, result.velocity)
        normal = (result.normal_force,) * 2
    lines = ["largest displacement [mm] and velocity [m/s]"]
    for place, name in enumerate(result.probes):
        lines.append(f"  {name:20s} {1e3 * far[place]:12.6g} {fast[place]:12.6g}")
    if pressed:
        lines.append("normal force [N], least and most")
    for place, name in enumerate(result.contacts):
        if name not in pressed:
            continue
        least, most = normal[0][:, place].min(), normal[1][:, place].max()
        lines.append(f"  {name:20s} {least:12.6g} {most:12.6g}")
    if result.divided:
        lines.append(f"{result.divided} steps converged only when divided")
    return lines
