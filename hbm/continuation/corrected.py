"""Points of a curve at a given parameter, and the error where there is none."""

from __future__ import annotations

from hbm.continuation.arc import Metric, upright
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import Small, correct
from hbm.continuation.settler import UNSETTLED, Settler
from hbm.continuation.step_control import StepControl
from hbm.errors import PLACE, REMEDY, ContinuationError
from microslip_mechanics.arrays import Array

ITERATIONS = 60
"""of Newton: there is no shorter step to try from"""


def correct_at(
    system: System,
    guess: Array,
    control: StepControl,
    settler: Settler = UNSETTLED,
    metric: Metric | None = None,
) -> Correction:
    """Correct a guess at its own parameter.

    With a ``metric`` steps that :class:`StepControl` neglects end the iteration.

    Raises
    ------
    ContinuationError
        If it does not converge.
    """
    normal, small = upright(guess), neglected(control, metric)
    found = correct(
        system,
        guess,
        normal,
        tolerance=control.tolerance,
        small=small,
        max_iterations=ITERATIONS,
    )
    if found.outcome is Outcome.CONVERGED:
        found = settler.settle(found, normal, control.tolerance, small)
        settler.keep()
    if found.outcome is not Outcome.CONVERGED:
        raise lost("no response is found", float(guess[-1]), found, control)
    return found


def neglected(control: StepControl, metric: Metric | None) -> Small | None:
    """Return what a step of Newton's iteration may neglect, if it may."""
    if metric is None or control.negligible == 0.0:
        return None
    return Small(lambda point: control.negligible * metric(point), control.loose)


def lost(
    what: str, where: float, failed: Correction, control: StepControl
) -> ContinuationError:
    """Return the error of a point at which the correction failed."""
    return ContinuationError(
        f"{what} at {PLACE}: {failed.outcome.value} "
        f"(residual {failed.residuals[-1]:.1e} after {failed.iterations} iterations, "
        f"tolerance {control.tolerance:.1e}); {REMEDY}",
        where,
    )
