"""What a decay says of its cycles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import decimal, hertz

if TYPE_CHECKING:
    from microslip_mechanics.results.ring_down import RingDown

COLUMNS = (
    *("time_s", "amplitude_m", "frequency_hz"),
    *("damping_ratio", "energy_damping_ratio"),
)
SHOWN = 20
SMALL = 0.1
"""of the damping, that its error is where it is known"""
GROWS = -1e-6
"""damping ratio below which an amplitude grows by more than the table shows"""


def cycles(decay: RingDown, probe: str, too_fast: int = 0) -> list[str]:
    """Return the table of the decay, some of its cycles.

    ``too_fast`` is how many are left out at its end.
    """
    count = decay.time.size
    both = decay.damping, decay.energy_damping
    percents = [100.0 * ratio for ratio in both if ratio.size]
    rows = [
        f"free decay of {probe}",
        f"{'damping ratio [%] by':>63}",
        "time [s]  amplitude [mm]  frequency [Hz]   amplitude"
        + "      energy" * (len(percents) - 1),
    ]
    chosen = sorted({round(n * (count - 1) / (SHOWN - 1)) for n in range(SHOWN)})
    frequencies = decay.frequency / math.tau
    # about zero digits say nothing
    known = [each[abs(each) < math.inf] for each in percents]
    largest = [each.max(initial=0.0) if (each > 0.0).all() else 1.0 for each in known]
    rows += [
        f"{decimal(decay.time[place], decay.time[-1], 4, 8)} "
        f"{1e3 * decay.amplitude[place]:15.6g} "
        f"{hertz(frequencies[place], frequencies):>15} "
        + " ".join(
            f"{'-':>11}"
            if math.isnan(ratio[place])
            else decimal(ratio[place], most, 4, 11)
            for ratio, most in zip(percents, largest, strict=True)
        )
        for place in chosen
    ]
    grows = int((decay.damping < GROWS).sum())
    if grows:
        rows.append(
            f"the amplitude grows in {grows} of {count} cycles: several motions decay "
            "together and beat, so that no row is of one alone, or something feeds them"
        )
    if too_fast:
        from microslip_mechanics.results.ring_down import FEWEST_ROWS

        rows.append(
            f"left out: {too_fast} swings at the end, whose cycles have fewer than "
            f"{FEWEST_ROWS} rows: a smaller march.store_every or march.time_step tells "
            "of them"
        )
    return rows


def errors(
    decay: RingDown, frequency: float, damping: float, usual: float = math.inf
) -> str:
    """Return what time steps and rows change, over the largest of each.

    Damping that is not larger than its error has an absolute one: that in the median
    of the cycles, ``usual``, where this is far less than their median damping.
    """
    if math.isnan(frequency):
        return "not known: steps twice as long show no swings"
    if damping < 1.0:
        return f"frequency {frequency:.1e}, damping {damping:.1e}, of the largest"
    middle = sorted(abs(decay.damping))[decay.damping.size // 2]
    if usual < SMALL * middle:
        return (
            f"frequency {frequency:.1e} of the largest; damping ratio "
            f"{100.0 * usual:.1e} % in the median of the cycles, and as much as the "
            "largest where several motions beat"
        )
    ratio = damping * float(abs(decay.damping).max())
    return (
        f"frequency {frequency:.1e} of the largest; no damping can be measured, its "
        f"ratio is off by up to {100.0 * ratio:.1e} %"
    )
