"""The last point of a curve with the resolution of the next one (theory §6.2).

More harmonics move a point, and turn the tangent where higher orders move much, as in
their resonances: from one resolution to the next the curve seems to turn sharply, or to
lead elsewhere, however short the step. A step is judged between points of one.
"""

from __future__ import annotations

from hbm.continuation.arc import distance, plane_across, tangent
from hbm.continuation.corrected import neglected
from hbm.continuation.correction import Outcome
from hbm.continuation.linearised import SingularError, System
from hbm.continuation.newton import correct
from hbm.continuation.predictor import Predictor
from hbm.continuation.settler import Settler
from hbm.continuation.step_control import StepControl


def lifted(
    system: System, past: Predictor, control: StepControl, settler: Settler
) -> bool:
    """Return whether the last point was solved with the present system, which is finer.

    The past begins there then. It is not where that leads farther away than the longest
    step, to another branch perhaps.
    """
    if not settler.finer:
        return False
    scale = past.scale
    found = correct(
        system,
        past.point,
        plane_across(past.tangent, scale),
        tolerance=control.tolerance,
        small=neglected(control, lambda _: scale),
    )
    near = distance(found.point, past.point, scale) <= control.largest
    if found.outcome is not Outcome.CONVERGED or not near:
        return False
    try:
        along = tangent(found.linearised, past.tangent, scale)
    except SingularError:
        return False
    past.begin(found.point, along, found.linearised.orientation(along))
    settler.hold()
    return True
