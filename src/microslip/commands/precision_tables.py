"""What ``microslip precision`` prints."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microslip.studies.precision.precision import Run
    from microslip.studies.precision.reference import Reference
    from timedomain.shooting.steady import Slope

RUNS = """\
method                        setting                          CPU [s]  periods   peak    energy  distance"""  # noqa: E501
COLUMNS = (
    *("method", "setting", "cpu_s", "amplitude_error", "energy_error"),
    *("orbit_distance", "cpu_per_period_s", "periods", "left", "ending"),
)
BALANCE, OWN, OUTSIDE = ("harmonic balance",), ("reference", "fast"), ("scipy",)
"""how the names of methods begin"""
SHOWN = {"amplitude": "peak amplitude", "energy": "energy per period"}
"""quantities that the summary speaks of"""


def reference(exact: Reference) -> str:
    """Return what all are measured by."""
    peak, energy, distance = exact.spread
    first, second = exact.names
    return (
        f"peak {1e3 * exact.orbit.peak:.9g} mm, {exact.orbit.energy:.9g} J per period\n"
        f"reference: {first}\n"
        f"checked by: {second}\n"
        f"they differ by {peak:.1e} in peak, {energy:.1e} in energy, {distance:.1e} in "
        "orbit: errors ten times as large are told"
    )


def multiplier(slope: Slope) -> str:
    """Return how long a march has to wait."""
    return (
        f"slowest multiplier {slope.slowest:.6f}: from rest to 1e-3 in "
        f"{slope.periods(1e-3)} periods"
    )


def run(each: Run) -> str:
    """Return a line of a run."""
    begin = f"{each.method:30s}{each.setting:30s}"
    if math.isnan(each.seconds):
        return f"{begin} {each.ending}"
    peak, energy, distance = each.errors
    periods = f"{each.periods:8d}" if each.periods else " " * 8
    told = "" if each.ending == "complete" else f"  {each.ending}"
    return (
        f"{begin}{each.seconds:10.3g}{periods} {peak:8.1e}  {energy:8.1e}  "
        f"{distance:8.1e}{told}"
    )


def rows(found: list[Run]) -> Iterator[tuple[object, ...]]:
    """Yield the rows of the table, as :data:`COLUMNS` names them."""
    for each in found:
        yield (
            *(each.method, each.setting, each.seconds, *each.errors),
            *(each.period, each.periods, each.left, each.ending),
        )


def summary(found: list[Run], exact: Reference) -> str:
    """Return what each method costs at some errors, and the speed-up."""
    from microslip.studies.precision.orbit import QUANTITIES

    parts = [
        part
        for quantity, name in SHOWN.items()
        for part in _costs(found, exact, QUANTITIES.index(quantity), name)
    ]
    return "\n".join([*parts, _agreement(found)])


def _costs(
    found: list[Run], exact: Reference, quantity: int, name: str
) -> Iterator[str]:
    """Yield a line for each method, and one of the speed-up."""
    from microslip.studies.precision.fronts import cost_at
    from microslip.studies.precision.precision import ASKED

    doubt = exact.spread[quantity]
    costs = {
        method: [
            cost_at([r for r in found if r.method == method], quantity, asked, doubt)
            for asked in ASKED
        ]
        for method in dict.fromkeys(each.method for each in found)
    }
    yield f"CPU time for an error in {name} of 1 %, 0.1 %, 1e-6"
    for method, spent in costs.items():
        yield f"  {method:30s}" + "".join(f"{_seconds(each):>14s}" for each in spent)
    for said, others in (("microslip's marches", OWN), ("scipy's solvers", OUTSIDE)):
        ratios = [
            _least(costs, others, place) / _least(costs, BALANCE, place)
            for place in range(len(ASKED))
        ]
        told = ("-" if math.isnan(ratio) else f"{ratio:.3g} ×" for ratio in ratios)
        begin = f"  balance over {said}"
        yield f"{begin:32s}" + "".join(f"{each:>14s}" for each in told)


def _least(costs: dict[str, list[float]], begins: tuple[str, ...], place: int) -> float:
    """Return the least cost of the methods whose names begin so; NaN if unknown."""
    known = [
        spent[place] for method, spent in costs.items() if method.startswith(begins)
    ]
    return min((each for each in known if math.isfinite(each)), default=math.nan)


def _seconds(cost: float) -> str:
    if math.isinf(cost):
        return "cannot tell"
    return "not reached" if math.isnan(cost) else f"{cost:.3g} s"


def _agreement(found: list[Run]) -> str:
    """Return how far the best runs of balance and marches are from one another."""
    best = {}
    for method in (*BALANCE, "reference march", "fast march"):
        own = [r for r in found if r.method == method and r.ending == "complete"]
        if own:
            best[method] = min(own, key=lambda each: each.errors[2])
    if len(best) < 2:
        return "too few methods have a run: nothing is said of their agreement"
    peak, energy, _ = (
        max(errors) for errors in zip(*(r.errors for r in best.values()), strict=True)
    )
    names = ", ".join(f"{name} ({each.setting})" for name, each in best.items())
    return (
        f"tightest runs of {names}: within {peak:.1e} of the reference in peak, "
        f"{energy:.1e} in energy"
    )
