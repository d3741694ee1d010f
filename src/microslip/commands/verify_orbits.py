"""What microslip verify prints of orbits by shooting, and whether they agree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import decimal, hertz
from microslip.commands.verify_probe import moving

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip.studies.verify.orbits import Verdict

ORBITS = """\
orbits: shooting started on the orbit that harmonic balance found
frequency     amplitude [mm]        largest   estimated error      multiplier
     [Hz]    balance   shooting  difference  balance shooting   balance shooting"""


def orbit_rows(verdicts: Sequence[Verdict]) -> str:
    """Return the orbits as a table; the amplitude is that of a probe that moves."""
    made = [each.comparison for each in verdicts if each.comparison is not None]
    probe, largest = moving([each.predicted for each in made])
    rows = (orbit_row(each, probe, largest) for each in verdicts)
    places = _places(verdicts)
    return "\n".join(
        [ORBITS, *(f"{at:>9} {row}" for at, row in zip(places, rows, strict=True))]
    )


def _places(verdicts: Sequence[Verdict]) -> list[str]:
    """Return the frequencies of orbits [Hz], told apart."""
    seen = [each.response.frequency / math.tau for each in verdicts]
    return [hertz(each, seen) for each in seen]


def orbit_row(verdict: Verdict, probe: int, largest: float) -> str:
    """Return what follows an orbit's frequency; the largest of a probe is given."""
    made = verdict.comparison
    sign = "DISAGREE" if verdict.cause else "agree"
    if made is not None and not verdict.cause and not made.as_estimated:
        sign += ", beyond the estimates"
    sign += ", stability in doubt" if verdict.doubted else ""
    unknown = verdict.response.unstable < 0
    if made is None:
        return f" no orbit by shooting  {sign}, {verdict.whereabouts}"
    predicted, found = (
        decimal(1e3 * each[probe], 1e3 * largest, 6)
        for each in (made.predicted, made.found)
    )
    return (
        f"{predicted} {found}"
        f"  {made.difference:10.1e} {made.predicted_error:8.1e} {made.found_error:8.1e}"
        f"   {'-' if unknown else f'{made.multiplier:.4f}':>7}"
        f" {made.found_multiplier:8.4f}  {sign}, {verdict.whereabouts}"
    )


def orbits_said(verdicts: Sequence[Verdict]) -> str:
    """Return whether the orbits agree, and where and why not."""
    placed = list(zip(_places(verdicts), verdicts, strict=True))
    lines = [
        f"DISAGREE at {place} Hz ({each.whereabouts}): {each.cause}"
        for place, each in placed
        if each.cause
    ]
    lines += _shared(verdicts)
    lines += [
        f"stability in doubt at {place} Hz: largest multiplier "
        f"{made.multiplier:.4f} by harmonic balance, "
        f"{made.found_multiplier:.4f} by shooting (± {made.multiplier_error:.4f}); "
        "more harmonics decide"
        for place, each in placed
        if each.doubted and (made := each.comparison) is not None
    ]
    return "\n".join(lines)


def _shared(verdicts: Sequence[Verdict]) -> list[str]:
    """Return what is said of all orbits together."""
    from microslip.studies.verify.orbits import beyond, too_many

    count, most = len(verdicts), beyond(verdicts)
    if too_many(verdicts):
        share = f"{len(most)} of {count} orbits"
        return [f"DISAGREE: {share} differ by more than both estimates, not 1 in 4"]
    pairs = [
        (place, made)
        for place, each in zip(_places(verdicts), verdicts, strict=True)
        if (made := each.comparison) is not None
    ]
    if not pairs or any(verdict.cause for verdict in verdicts):
        return []
    place, worst = max(pairs, key=lambda pair: pair[1].difference)
    return [
        f"agree: largest difference of an amplitude {worst.difference:.1e} at "
        f"{place} Hz, estimates "
        f"{worst.predicted_error:.1e} and {worst.found_error:.1e}; {count - len(most)} "
        f"of {count} orbits within both estimates"
    ]
