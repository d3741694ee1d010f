"""What microslip verify prints: orbits, marches, sweeps, and whether they agree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from microslip.commands.columns import SHOWN, decimal, headed, titled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from microslip.studies.verify.orbits import Verdict
    from microslip.studies.verify.verify import SweepAgreement
    from microslip_mechanics.arrays import Array
    from timedomain.verify import Agreement

ORBITS = """\
orbits: shooting started on the orbit that harmonic balance found
frequency     amplitude [mm]        largest   estimated error      multiplier
     [Hz]    balance   shooting  difference  balance shooting   balance shooting"""
MARCHES = """\
steady state: march started on the orbit that harmonic balance found
frequency  amplitude  {deviation}  distance from orbit  drift
     [Hz]       [mm]  {heads}       first      last"""
SWEEPS = "swept sine beside the curve's prediction for an infinitely slow one"
SLOWER = "  slower"
ENERGY = "   energy of friction [J]    error  predicted [J]  difference"
HELD = (
    "contacts that stick throughout hold a mean force in a sweep, from when they slid "
    "last; on the curve they have none: this alone may part the two"
)
ENVELOPE = "  envelope  closing error"


def orbit_rows(verdicts: Sequence[Verdict]) -> str:
    """Return the orbits as a table; the amplitude is that of a probe that moves."""
    made = [each.comparison for each in verdicts if each.comparison is not None]
    probe, largest = _moving([each.predicted for each in made])
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


def march_rows(marches: Sequence[Agreement], probes: Sequence[str]) -> str:
    """Return the marches as a table; the amplitude is that of a probe that moves."""
    probe, largest = _moving([march.predicted for march in marches])
    places = _watched(probes)
    names = [probes[place] for place in places[:SHOWN]]
    deviation = titled("off by [%]", names, len(places))
    lines = [MARCHES.format(deviation=deviation, heads=headed(names))]
    lines += [
        f"{march.frequency / math.tau:9.4f} "
        f"{decimal(1e3 * march.predicted[probe], 1e3 * largest, 6)}  "
        + " ".join(f"{100.0 * march.deviation[each]:10.4f}" for each in places[:SHOWN])
        + f"  {march.first_distance:10.1e}{march.last_distance:10.1e}"
        f"{march.drift:9.1e}"
        f"{'  unstable: need not stay' if march.unstable > 0 else ''}"
        for march in marches
    ]
    return "\n".join(lines)


def sweep_rows(sweeps: Sequence[SweepAgreement]) -> str:
    """Return the sweeps as a table, and how fast their difference falls."""
    from microslip.studies.verify.verify import rate_of

    rubs = any(sweep.rubs for sweep in sweeps)
    lines = [SWEEPS, SLOWER + (ENERGY if rubs else "") + ENVELOPE]
    for sweep in sweeps:
        energy = (
            f" {sweep.energy:24.6f} {_about(sweep.estimated)}"
            f" {sweep.quasi_static:14.6f} {100.0 * sweep.energy_error:9.2f} %"
        )
        lines.append(
            f"{sweep.slower:8g}{energy if rubs else ''}"
            f" {100.0 * sweep.envelope_error:7.1f} % {sweep.closing_error:14.1e}"
        )
    lines += [
        f"beyond {hertz:.4f} Hz more than one branch is stable: the curve's is the one "
        f"that the sweep {sweep.slower:g} times as long takes"
        for sweep in sweeps[-1:]
        for hertz in sweep.chosen
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
    among = "" if len(held) == len(marches) else f" of {len(held)} stable orbits"
    said = (
        f"{'agree' if stays else 'DISAGREE'}: largest deviation of an amplitude{among} "
        f"{100.0 * deviation(worst):.3g} % at {worst.frequency / math.tau:.4f} Hz, "
        f"tolerance {100.0 * tolerance:g} %"
    )
    return said, stays


def _moving(amplitudes: Sequence[Array]) -> tuple[int, float]:
    """Return a probe that moves, and the largest of its amplitudes [m]."""
    import numpy as np

    from microslip_mechanics.results.moving_probe import moving_probe

    if not amplitudes:
        return 0, 0.0
    sizes = np.array(amplitudes)
    probe = moving_probe(sizes)
    return probe, float(sizes[:, probe].max())


def _watched(probes: Sequence[str]) -> list[int]:
    """Return the places of the motions that are compared: relative ones if no others.

    A relative motion is small beside the two that it is the difference of.
    """
    from microslip.figures.names import absolute

    return absolute(probes) or list(range(len(probes)))
