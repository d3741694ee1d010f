"""What microslip verify prints of orbits by shooting, and whether they agree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import decimal
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
    return "\n".join([ORBITS, *(orbit_row(each, probe, largest) for each in verdicts)])


def orbit_row(verdict: Verdict, probe: int, largest: float) -> str:
    """Return one orbit as a line: the amplitude of a probe, whose largest is given."""
    hertz, made = verdict.response.frequency / math.tau, verdict.comparison
    sign = "DISAGREE" if verdict.cause else "agree"
    if made is not None and not verdict.cause and not made.as_estimated:
        sign += ", beyond the estimates"
    sign += ", stability in doubt" if verdict.doubted else ""
    unknown = verdict.response.unstable < 0
    if made is None:
        return f"{hertz:9.4f}  no orbit by shooting  {sign}, {verdict.whereabouts}"
    predicted, found = (
        decimal(1e3 * each[probe], 1e3 * largest, 6)
        for each in (made.predicted, made.found)
    )
    return (
        f"{hertz:9.4f} {predicted} {found}"
        f"  {made.difference:10.1e} {made.predicted_error:8.1e} {made.found_error:8.1e}"
        f"   {'-' if unknown else f'{made.multiplier:.4f}':>7}"
        f" {made.found_multiplier:8.4f}  {sign}, {verdict.whereabouts}"
    )


def orbits_said(verdicts: Sequence[Verdict]) -> str:
    """Return whether the orbits agree, and where and why not."""
    wrong = [verdict for verdict in verdicts if verdict.cause]
    lines = [
        f"DISAGREE at {verdict.response.frequency / math.tau:.4f} Hz "
        f"({verdict.whereabouts}): {verdict.cause}"
        for verdict in wrong
    ]
    lines += _shared(verdicts)
    lines += [
        f"stability in doubt at {each.response.frequency / math.tau:.4f} Hz: largest "
        f"multiplier {made.multiplier:.4f} by harmonic balance, "
        f"{made.found_multiplier:.4f} by shooting (± {made.multiplier_error:.4f}); "
        "more harmonics decide"
        for each in verdicts
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
    pairs = [each.comparison for each in verdicts if each.comparison is not None]
    if not pairs or any(verdict.cause for verdict in verdicts):
        return []
    worst = max(pairs, key=lambda each: each.difference)
    return [
        f"agree: largest difference of an amplitude {worst.difference:.1e} at "
        f"{worst.response.frequency / math.tau:.4f} Hz, estimates "
        f"{worst.predicted_error:.1e} and {worst.found_error:.1e}; {count - len(most)} "
        f"of {count} orbits within both estimates"
    ]
