"""An infinitely slow upward sweep, as the frequency response curve foretells it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory

ROUNDING = 1e-9
"""of the drive's work: no energy of friction, as of contacts that stick"""

NEAR = 0.05
"""of the frequency: how far beyond a jump a sweep is compared with a branch"""


def quasi_static_energy(
    curve: ResponseCurve,
    rate: float,
    span: tuple[float, float],
    upward: NDArray[np.int64],
) -> float:
    """Return the energy that friction takes out of an infinitely slow upward sweep.

    Parameters
    ----------
    curve
        Over the sweep's range or more.
    rate
        Logarithmic sweep rate k [1/s].
    span
        Frequencies at which the sweep begins and ends [Hz].
    upward
        The points that it passes, as :func:`followed_by` tells.

    Returns
    -------
    ∫ E df / k [J] along the branch that an upward sweep follows (theory §6.7).
    """
    hertz = curve.frequency[upward] / (2.0 * np.pi)
    energy = curve.friction_energy[upward]
    within = (hertz > span[0]) & (hertz < span[1])
    ends = np.interp(span, hertz, energy)
    places = np.concatenate([span[:1], hertz[within], span[1:]])
    values = np.concatenate([ends[:1], energy[within], ends[1:]])
    return float(np.trapezoid(values, places) / rate)


def compared_energies(
    history: TimeHistory, span: tuple[float, float], predicted: float, slower: float
) -> tuple[float, float]:
    """Return friction's energy in a span of time, over ``slower``, and its prediction.

    Both are 0 where contacts stick along the curve: then the prediction is rounding,
    and what a march counts the error of its steps.
    """
    energy, work = (
        float(np.diff(np.interp(span, history.time, history.of(flow)))[0]) / slower
        for flow in ("friction", "input")
    )
    if abs(predicted) <= ROUNDING * abs(work):
        return 0.0, 0.0
    return energy, predicted


def followed_by(
    curve: ResponseCurve, hertz: Array, swing: Array
) -> tuple[NDArray[np.int64], list[float]]:
    """Return the points that a sweep passes which is slow but for its jumps.

    It jumps at folds. Where more than one stable branch lies beyond, the basins of
    attraction decide on which it lands: the branch is taken that is nearest to the
    sweep. A piece that was traced downwards is passed the other way; of pieces that
    begin at one frequency, the sweep begins on the first.

    Parameters
    ----------
    curve
        With the stability of its points.
    hertz, swing
        Of each cycle of the sweep: frequency [Hz], and what compares with the curve's
        peaks [m], shape ``(cycles, probes)``.

    Returns
    -------
    The points, and the frequencies [Hz] beyond which there was a choice.
    """
    rising, stable = _branches(curve)
    where = curve.frequency / (2.0 * np.pi)
    passed, chosen = rising[0], list[float]()
    while True:
        reached = float(where[passed[-1]])
        # those of unknown stability, or of a motion that is not periodic, come after
        on = _beyond(stable, where, reached) or _beyond(rising, where, reached)
        if not on:  # a gap of the curve, or its end
            on = sorted(
                (piece for piece in rising if where[piece[0]] > reached),
                key=lambda piece: float(where[piece[0]]),
            )[:1]
        if not on:
            return passed, chosen
        if len(on) > 1:
            chosen.append(reached)
            on.sort(key=lambda piece: _apart(curve, piece, hertz, swing))
        passed = np.concatenate([passed, on[0]])


def _beyond(
    pieces: list[NDArray[np.int64]], where: Array, reached: float
) -> list[NDArray[np.int64]]:
    """Return what of the pieces that pass a frequency lies beyond it."""
    return [
        piece[where[piece] > reached]
        for piece in pieces
        if where[piece[0]] <= reached < where[piece[-1]]
    ]


def _apart(
    curve: ResponseCurve, piece: NDArray[np.int64], hertz: Array, swing: Array
) -> float:
    """Return how far a sweep is from a branch's begin, relative to that."""
    where = curve.frequency[piece] / (2.0 * np.pi)
    near = (hertz > where[0]) & (hertz < min(where[-1], (1.0 + NEAR) * where[0]))
    peaks = np.stack(
        [np.interp(hertz[near], where, peak) for peak in curve.peak[piece].T], axis=1
    )
    size = float(np.linalg.norm(peaks))
    return float(np.linalg.norm(swing[near] - peaks)) / size if size else np.inf


def _branches(
    curve: ResponseCurve,
) -> tuple[list[NDArray[np.int64]], list[NDArray[np.int64]]]:
    """Return the pieces that were traced upwards, and all stable ones, upwards."""
    order = _upward(curve)
    up = np.diff(curve.frequency[order], prepend=-np.inf) > 0.0
    turns = np.flatnonzero(np.diff(up)) + 1
    pieces = np.split(order, turns)
    rises = up[np.append(0, turns)]
    upwards = [
        piece if rise else piece[::-1]
        for piece, rise in zip(pieces, rises, strict=True)
    ]
    stable = [each for each in upwards if np.mean(curve.unstable[each] == 0.0) > 0.5]
    return [each for each, rise in zip(upwards, rises, strict=True) if rise], stable


def _upward(curve: ResponseCurve) -> NDArray[np.int64]:
    """Return all points piece by piece, each piece upwards as a whole."""
    frequency = curve.frequency
    begins = [place for place, name in enumerate(curve.event) if name == "restart"]
    pieces = [
        piece if frequency[piece[0]] <= frequency[piece[-1]] else piece[::-1]
        for piece in np.split(np.arange(frequency.size), begins)
        if piece.size
    ]
    return np.concatenate(sorted(pieces, key=lambda piece: frequency[piece[0]]))
