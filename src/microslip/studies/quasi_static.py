"""An infinitely slow upward sweep, as the frequency response curve foretells it."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.response_curve import ResponseCurve


def quasi_static_energy(
    curve: ResponseCurve, rate: float, span: tuple[float, float]
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

    Returns
    -------
    ∫ E df / k [J] along the branch that an upward sweep follows (theory §6).
    """
    upward = followed_upwards(curve)
    hertz = curve.frequency[upward] / (2.0 * np.pi)
    energy = curve.friction_energy[upward]
    within = (hertz > span[0]) & (hertz < span[1])
    ends = np.interp(span, hertz, energy)
    places = np.concatenate([span[:1], hertz[within], span[1:]])
    values = np.concatenate([ends[:1], energy[within], ends[1:]])
    return float(np.trapezoid(values, places) / rate)


def followed_upwards(curve: ResponseCurve) -> np.ndarray:
    """Return the points that a slow upward sweep passes: it jumps at a fold.

    A piece that was traced downwards is passed the other way; of pieces that begin at
    one frequency, the sweep begins on the first.
    """
    frequency = curve.frequency
    begins = [place for place, name in enumerate(curve.event) if name == "restart"]
    pieces = [
        piece if frequency[piece[0]] <= frequency[piece[-1]] else piece[::-1]
        for piece in np.split(np.arange(frequency.size), begins)
        if piece.size
    ]
    order = np.concatenate(sorted(pieces, key=lambda piece: frequency[piece[0]]))
    passed = frequency[order]
    followed: np.ndarray = order[passed >= np.maximum.accumulate(passed)]
    return followed
