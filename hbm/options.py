"""What a user asks of a curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hbm.checks import check_harmonics, check_positive
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis, usual_samples
from hbm.resolution.adaptive import HARMONICS

POSITIVE = (
    "error", "tolerance", "largest_step", "most_harmonics", "effort", "highest",
)  # fmt: skip
"""options that must be positive numbers"""
SPARE, MOST = 1e-2, 1e-3
"""change of the motion that Newton's iteration may neglect, over the error, and most"""
LOOSE = 1e-4
"""largest unbalanced force with which it may, over the drive"""


@dataclass(frozen=True, slots=True)
class CurveOptions:
    """Range, resolution and accuracy of a curve."""

    start: float
    """first excitation frequency [rad/s], or value of another parameter"""
    end: float
    """last one"""
    error: float = 1e-3
    """of the amplitude at each point, relative: harmonics and samples follow from it"""
    harmonics: int | None = None
    """fixed number instead, at least 1"""
    samples: int | None = None
    """fixed number per period; 16 (harmonics + 1) if left out"""
    tolerance: float = 1e-8
    """largest unbalanced force over the smaller of preload and drive"""
    largest_step: float = 0.25
    """relative change of the response, or share of a tenth of the range"""
    stability: bool = True
    """whether Floquet multipliers are computed"""
    errors: bool = True
    """whether the error of fixed harmonics is estimated, at twice as many"""
    contact_errors: bool = False
    """whether errors of what contacts take out, and of normal forces, are estimated"""
    pruned: bool = True
    """whether what always stays at zero is left out: what a symmetry keeps still, the
    second half of a period that mirrors the first, tangents that a law does not have"""
    events: bool = True
    """whether peaks, folds and changes of stability are located"""
    residual_range: bool = False
    """whether the range of amplitudes by other residual tractions is sought, see
    :mod:`~hbm.curves.residual_range`"""
    most_harmonics: int = HARMONICS
    """that an error tolerance may ask for; reported points have up to twice as many"""
    effort: float | None = None
    """evaluations of the residual after which a curve is given up, see
    :class:`~hbm.continuation.effort.Effort`"""
    highest: float | None = None
    """frequency up to which a sparse structure is resolved [rad/s], see
    :mod:`~microslip_mechanics.reduction.reduction`; 16 × the larger one if left out"""

    def __post_init__(self) -> None:
        """Check range, accuracy and harmonics."""
        if not np.isfinite([self.start, self.end]).all() or self.start == self.end:
            raise ValueError(
                f"from {self.start:g} to {self.end:g}: give two different finite values"
            )
        for name in POSITIVE:
            value = getattr(self, name)
            if value is not None:
                check_positive(name, value)
        check_harmonics(self.harmonics)
        if self.samples is not None and self.harmonics is None:
            raise ValueError("samples without harmonics: give both, or harmonics alone")

    @property
    def first(self) -> FourierBasis:
        """Resolution of the first point."""
        harmonics = self.harmonics or 1
        return FourierBasis(harmonics, self.samples or usual_samples(harmonics))

    def control(self, force_scale: float, drive: float = 0.0) -> StepControl:
        """Return the steps; ``force_scale`` [N] is what forces are compared with.

        With a ``drive`` [N], and without fixed harmonics, Newton's iteration ends where
        it no longer changes the motion.
        """
        ends_early = drive > 0.0 and self.harmonics is None
        return StepControl(
            tolerance=self.tolerance * force_scale,
            initial=min(0.02, self.largest_step),
            largest=self.largest_step,
            negligible=min(SPARE * self.error, MOST) if ends_early else 0.0,
            loose=LOOSE * drive,
        )
