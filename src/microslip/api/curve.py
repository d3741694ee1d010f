"""Frequency response curves in plain Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from microslip.api.arguments import check_apart, checked, named, resolved
from microslip.scenes.experiments import Curve

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.response_curve import ResponseCurve

NAME = "microslip.curve"


def curve(
    problem: Problem,
    lowest: float | str,
    highest: float | str,
    *,
    tolerance: float | None = None,
    harmonics: int | None = None,
    samples: int | None = None,
) -> ResponseCurve:
    """Return the frequency response curve by harmonic balance, as far as it goes.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Where it begins and ends [Hz]; downwards if the first is the larger one. These
        and other quantities may be texts with a unit, such as ``"0.1 kHz"``.
    tolerance
        Relative error of amplitude, from which harmonics and samples follow; 1e-3 if
        left out.
    harmonics, samples
        Fixed numbers instead.

    Returns
    -------
    ResponseCurve
        Point by point as it was traced: ``frequency`` [rad/s], ``amplitude`` of the
        first harmonic and ``peak``, half of the swing in time [m], (points, probes);
        ``error``, estimated, of the amplitude, relative; ``friction_energy`` per period
        and ``friction_energy_error`` [J]; ``unstable``, the number of Floquet
        multipliers outside the unit circle; ``event``, such as "peak".

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if there is not even a first point; else
        ``ending`` says how the curve ends.
    """
    from microslip.studies.curve import Wanted, trace_curve

    wanted: Curve = resolved(
        NAME,
        Curve,
        lowest=lowest,
        highest=highest,
        tolerance=tolerance,
        harmonics=harmonics,
        samples=samples,
    )
    check_apart(NAME, wanted.lowest, wanted.highest)
    given = checked(NAME, problem)
    more = Wanted(residual_range=True, contact_errors=True)
    with named(NAME):
        return trace_curve(given, wanted, wanted=more).curve
