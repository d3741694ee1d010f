"""What microslip verify prints of marches, and whether they agree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import SHOWN, decimal, headed, hertz, titled
from microslip.commands.verify_probe import moving

if TYPE_CHECKING:
    from collections.abc import Sequence

    from timedomain.verify import Agreement

MARCHES = """\
steady state: march started on the orbit that harmonic balance found
frequency  amplitude  {deviation}  distance from orbit  drift
     [Hz]       [mm]  {heads}       first      last"""


def march_rows(marches: Sequence[Agreement], probes: Sequence[str]) -> str:
    """Return the marches as a table; the amplitude is that of a probe that moves."""
    probe, largest = moving([march.predicted for march in marches])
    places = _watched(probes)
    names = [probes[place] for place in places[:SHOWN]]
    deviation = titled("off by [%]", names, len(places))
    seen = [march.frequency / math.tau for march in marches]
    lines = [MARCHES.format(deviation=deviation, heads=headed(names))]
    lines += [
        f"{hertz(march.frequency / math.tau, seen):>9} "
        f"{decimal(1e3 * march.predicted[probe], 1e3 * largest, 6)}  "
        + " ".join(f"{100.0 * march.deviation[each]:10.4f}" for each in places[:SHOWN])
        + f"  {march.first_distance:10.1e}{march.last_distance:10.1e}"
        f"{march.drift:9.1e}"
        f"{'  unstable: need not stay' if march.unstable > 0 else ''}"
        for march in marches
    ]
    return "\n".join(lines)


def marches_said(
    marches: Sequence[Agreement], probes: Sequence[str], tolerance: float
) -> tuple[str, bool]:
    """Return whether the marches agree, in words and as such."""
    places = _watched(probes)

    def deviation(march: Agreement) -> float:
        return float(march.deviation[places].max())

    held = [march for march in marches if march.unstable <= 0]
    if not held:
        return "every orbit is unstable: no march needs to stay near one", True
    worst = max(held, key=deviation)
    stays = deviation(worst) <= tolerance
    seen = [march.frequency / math.tau for march in marches]
    among = "" if len(held) == len(marches) else f" of {len(held)} stable orbits"
    said = (
        f"{'agree' if stays else 'DISAGREE'}: largest deviation of an amplitude{among} "
        f"{100.0 * deviation(worst):.3g} % at "
        f"{hertz(worst.frequency / math.tau, seen)} Hz, "
        f"tolerance {100.0 * tolerance:g} %"
    )
    return said, stays


def _watched(probes: Sequence[str]) -> list[int]:
    """Return the places of the motions that are compared: relative ones if no others.

    A relative motion is small beside the two that it is the difference of.
    """
    from microslip.figures.names import absolute

    return absolute(probes) or list(range(len(probes)))
