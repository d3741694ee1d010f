"""What a user asks of a nonlinear mode."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hbm.checks import check_harmonics, check_positive
from hbm.forces.fourier import FourierBasis


@dataclass(frozen=True, slots=True)
class ModeOptions:
    """Amplitudes, resolution and accuracy of a nonlinear mode."""

    smallest: float
    """first amplitude [m], of the linear mode's share in the motion"""
    largest: float
    """last amplitude [m], likewise: where the shape changes, probes have another one"""
    error: float = 1e-2
    """of the damping ratio at each point, relative, of the frequency a hundredth of it:
    harmonics follow from it"""
    harmonics: int | None = None
    """fixed number instead"""
    tolerance: float = 1e-7
    """largest unbalanced force over modal stiffness times amplitude"""
    effort: float = 3e4
    """evaluations after which it is given up, see
    :class:`~hbm.continuation.effort.Effort`"""

    def __post_init__(self) -> None:
        """Check range, accuracy and harmonics."""
        if not 0.0 < self.smallest < self.largest < math.inf:
            raise ValueError(
                f"amplitudes from {self.smallest:g} to {self.largest:g} m: "
                "give two positive ones, the smaller first"
            )
        for name in ("error", "tolerance", "effort"):
            check_positive(name, getattr(self, name))
        check_harmonics(self.harmonics)

    @property
    def first(self) -> FourierBasis:
        """Resolution of the first point."""
        harmonics = self.harmonics or 3
        return FourierBasis(harmonics, 64 * (harmonics + 1))
