"""How far a change of stability may lie from its true place on a curve (§6.4)."""

from __future__ import annotations

from dataclasses import replace

from hbm.continuation.correction import Correction
from hbm.continuation.segment import Segment, folds
from hbm.events.multipliers import HARMONICS
from hbm.forces.fourier import FourierBasis, by_harmonics

SLOWEST = 2.0
"""error over the change to twice the harmonics, of what falls like their inverse"""


def witness(used: FourierBasis, told: FourierBasis) -> FourierBasis:
    """Return another resolution than the one ``used``: the difference tells its error.

    It is twice as fine as the orbit is ``told``. Where there are so many harmonics that
    this would cost most of a curve, it is that of the orbit if it is finer than what is
    used, else half of that.
    """
    finest = max(used, told, key=by_harmonics)
    if finest.harmonics <= HARMONICS:
        return finest.doubled
    if finest != used:
        return finest
    return replace(used, harmonics=used.harmonics // 2)


def crossing_error(
    segment: Segment,
    located: Correction,
    ends: tuple[float, float],
    doubt: float,
    precision: float,
) -> float:
    """Return the error of the parameter where a multiplier crosses the unit circle.

    Parameters
    ----------
    segment, located
        The step in which it does, and where.
    ends
        Excess of the multiplier's modulus over one at the ends of the step.
    doubt
        Change of that excess to another resolution.
    precision
        Of the place, over the length of the step.
    """
    length, place = segment.length, segment.place(located.point)
    slope = _slope(ends, place / length) / length
    change = segment.after.point[-1] - segment.before.point[-1]
    steepest = max(abs(folds(located)), abs(float(change)) / length)
    return steepest * (SLOWEST * doubt / slope + precision * length)


def _slope(ends: tuple[float, float], share: float) -> float:
    """Return how steep what is zero at a share of a step is there.

    It is that of the parabola through both ends, but no steeper than the line: at an
    end the zero may be one of other orbits than those that have the values there.
    """
    first, last = (abs(end) for end in ends)
    left = 1.0 - share
    if share * left <= 0.0:
        return first + last
    return min(first + last, (first * left**2 + last * share**2) / (share * left))
