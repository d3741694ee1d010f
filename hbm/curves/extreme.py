"""The farthest amplitude that is found from some responses (theory §6.5)."""

from __future__ import annotations

from hbm.continuation.linearised import SingularError
from hbm.curves.reached import GAIN, PARTS, Reached
from microslip_mechanics.arrays import Array

ROUNDS = 8
"""linear programmes for an extreme, at the most"""
BACK = (0.75, 0.5, 0.25, 0.0)
"""shares of residual tractions on the way back from an extreme"""
SAME = 1e-2
"""relative difference of amplitudes up to which that leads to where it began"""


def extreme(begun: list[Reached], probe: int, sign: float) -> Reached:
    """Return the farthest response that leads back to the first of those begun with.

    It is sought from the farthest of them, or else from the first, which is returned if
    none is farther.
    """
    here = begun[0]
    first = max(begun, key=lambda each: sign * each.amplitude[probe])
    for start in (first, here) if first is not here else (here,):
        farthest = _farthest(start, probe, sign)
        if farthest.beyond(here, probe, sign) and _returns(farthest, here):
            return farthest
    return here


def _farthest(begun: Reached, probe: int, sign: float) -> Reached:
    """Return the response that is farthest of those found beyond one."""
    reached = begun
    for _ in range(ROUNDS):
        made = _farther(reached, probe, sign)
        if made is None:
            break
        reached = made
    return reached


def _farther(reached: Reached, probe: int, sign: float) -> Reached | None:
    """Return a response that is farther, if one is found."""
    try:
        leeway = reached.leeway
    except SingularError:
        return None
    change = leeway.farthest(probe, sign)
    here, slope = reached.amplitude[probe], leeway.slopes[probe] @ change
    made = None
    for part in PARTS if abs(slope) > GAIN * reached.measure[probe] else ():
        made = reached.changed(part * change)
        if made is not None and made.beyond(reached, probe, sign):
            return made
    if made is None:
        return None
    # the last part went too far: a parabola says where the extreme is
    bend = (made.amplitude[probe] - here - PARTS[-1] * slope) / PARTS[-1] ** 2
    if sign * bend >= 0.0:
        return None
    nearer = reached.changed(-0.5 * slope / bend * change)
    return nearer if nearer and nearer.beyond(reached, probe, sign) else None


def _returns(farthest: Reached, here: Reached) -> bool:
    """Return whether an extreme goes back to the curve as its tractions do.

    Else it belongs to another curve: there are several responses beside a fold.
    """
    bent, reached = farthest.balance.problem.bent, farthest
    if bent is None:
        return False
    for share in BACK:
        held: Array = share * bent
        solved = here.bent_by(held, reached.point)
        if solved is None:
            return False
        reached = solved
    away = abs(reached.amplitude - here.amplitude).max()
    return bool(away <= SAME * here.amplitude.max())
