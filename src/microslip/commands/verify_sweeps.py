"""What microslip verify prints of sweeps, and whether they approach the curve."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import even, hertz

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip.studies.verify.verify import SweepAgreement

SWEEPS = "swept sine beside the curve's prediction for an infinitely slow one"
SLOWER = "  slower"
ENERGY = "   energy of friction [J]    error  predicted [J]  difference"
ENVELOPE = "  envelope  closing error"
HELD = (
    "contacts that stick throughout hold a mean force in a sweep, from when they slid "
    "last; on the curve they have none: this alone may part the two"
)


def sweep_rows(sweeps: Sequence[SweepAgreement]) -> str:
    """Return the sweeps as a table, and how fast their difference falls."""
    from microslip.studies.verify.verify import rate_of

    rubs = any(sweep.rubs for sweep in sweeps)
    lines = [SWEEPS, SLOWER + (ENERGY if rubs else "") + ENVELOPE]
    taken = even([sweep.energy for sweep in sweeps], 6, 24)
    predicted = even([sweep.quasi_static for sweep in sweeps], 6, 14)
    for sweep, mine, curve in zip(sweeps, taken, predicted, strict=True):
        energy = (
            f" {mine} {_about(sweep.estimated)} {curve}"
            f" {100.0 * sweep.energy_error:9.2f} %"
        )
        lines.append(
            f"{sweep.slower:8g}{energy if rubs else ''}"
            f" {100.0 * sweep.envelope_error:7.1f} % {sweep.closing_error:14.1e}"
        )
    lines += [
        f"beyond {hertz(place, sweep.chosen)} Hz more than one branch is stable: the "
        f"curve's is the one that the sweep {sweep.slower:g} times as long takes"
        for sweep in sweeps[-1:]
        for place in sweep.chosen
    ]
    rate = rate_of(list(sweeps))
    if rate is not None:
        sign = "falls" if rate > 0.0 else "grows"
        lines.append(f"the difference {sign} as duration^{-rate:.2f}")
    return "\n".join(lines)


def _about(error: float) -> str:
    """Return an estimated error in a column; a dash if it is not known."""
    return f"{'-' if math.isnan(error) else format(error, '.1e'):>8s}"


def sweeps_said(
    sweeps: Sequence[SweepAgreement], *, agree: bool, holds: bool = False
) -> str:
    """Return whether the sweeps approach the curve.

    ``holds`` says whether contacts may hold a force while they stick.
    """
    many = any(sweep.rubs for sweep in sweeps)
    what, ending = ("energy and envelope", "") if many else ("envelope", "es")
    verb = f"approach{ending}" if agree else f"{'do' if many else 'does'} not approach"
    sign = "agree" if agree else "DISAGREE"
    said = f"{sign}: {what} of the sweep {verb} the curve as it slows"
    if agree:
        return said
    slowest = max((sweep.slower for sweep in sweeps), default=1.0)
    said += (
        f"\nall may be too fast: --slower {4 * slowest:g} {16 * slowest:g} tells more"
    )
    return f"{said}\n{HELD}" if holds else said
