"""Iwan's model of a joint: sliders in parallel, distributed by four parameters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.laws.jenkins import slider
from microslip_mechanics.laws.row import ALONG, BETWEEN, Counts, Row
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class Iwan:
    """F = ∫ ρ(φ) (w − x_φ) dφ with ρ = R φ^χ + S δ(φ − φ_max) (Segalman, 2005).

    Slider φ slips while |w − x_φ| = φ, its slip displacement.
    The density up to φ_max is cut into geometric intervals, each of them one slider of
    the interval's stiffness that slips at its mean slip displacement. So K_T and F_S
    are exact, as are force and stiffness on first loading at the edges of all
    intervals; in between the force is too large, by ``backbone_error`` at the most,
    and the energy that a cycle dissipates is off by ``energy_error`` of its amplitude.
    With χ = −0.5, β = 0 and 20 sliders these are 0.9 % of F_S, and at the most 2 %
    above a tenth of φ_max and 12 % above twice the first edge; motions below the slip
    displacement of the first slider dissipate nothing. Twice as many sliders have a
    quarter of both errors, but for what the first interval adds, of which a smaller
    first edge leaves less.
    """

    slip_force: float = quantity("N", positive=True)
    """F_S [N], at which the whole joint slips"""
    stiffness: float = quantity("N/m", positive=True)
    """K_T [N/m], of very small motions"""
    chi: float = quantity(lowest=-0.999, highest=2.0)
    """χ; dissipation of microslip goes with the amplitude to the power 3 + χ"""
    beta: float = quantity(lowest=0.0, highest=1e3)
    """β, the ratio S / (R φ_max^(χ+1) / (χ+1)): stiffness lost when macroslip begins"""
    sliders: int = quantity(lowest=2, highest=200, default=20)
    """number of intervals"""
    smallest: float = quantity(lowest=1e-6, highest=0.5, default=1e-2)
    """first edge over φ_max"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        check_quantities(self, "iwan")

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    @property
    def largest_slip(self) -> float:
        """φ_max [m], at which macroslip begins."""
        shape = self.beta + (self.chi + 1.0) / (self.chi + 2.0)
        return self.slip_force * (1.0 + self.beta) / (self.stiffness * shape)

    @property
    def density(self) -> float:
        """R [N/m^(χ+2)]."""
        chi = self.chi
        shape = self.beta + (chi + 1.0) / (chi + 2.0)
        power = float(self.largest_slip ** (chi + 2.0))
        return self.slip_force * (chi + 1.0) / (power * shape)

    @property
    def edges(self) -> Array:
        """Ends of the intervals [m], shape (sliders + 1,)."""
        inner = np.geomspace(self.smallest, 1.0, self.sliders)
        return self.largest_slip * np.concatenate([[0.0], inner])

    @property
    def spectrum(self) -> tuple[Array, Array]:
        """Stiffness [N/m] and slip displacement [m] of each slider.

        Of shape ``(sliders,)``, one more if β > 0.
        """
        one, two = self.chi + 1.0, self.chi + 2.0
        stiffness = self.density * np.diff(self.edges**one) / one
        slip = self.density * np.diff(self.edges**two) / two / stiffness
        if self.beta > 0.0:
            stiffness = np.append(
                stiffness, self.stiffness * self.beta / (1 + self.beta)
            )
            slip = np.append(slip, self.largest_slip)
        return stiffness, slip

    @property
    def backbone_error(self) -> float:
        """Largest error of the force on first loading, over F_S."""
        stiffness, slip = self.spectrum
        made = np.minimum.outer(slip, slip) @ stiffness
        bend = self.density * slip ** (self.chi + 2.0)
        exact = self.stiffness * slip - bend / ((self.chi + 1.0) * (self.chi + 2.0))
        return float((made - exact).max() / self.slip_force)

    def energy_error(self, amplitude: float) -> float:
        """Return that of the energy dissipated in a cycle, relative.

        Parameters
        ----------
        amplitude
            Of the cycle [m], above zero. The exact energy is 4 ∫ ρ(φ) φ (a − φ) dφ over
            what slips.
        """
        stiffness, slip = self.spectrum
        made = 4.0 * float(stiffness @ (slip * np.maximum(amplitude - slip, 0.0)))
        two, three, most = self.chi + 2.0, self.chi + 3.0, self.largest_slip
        slips = min(amplitude, most)
        exact = 4.0 * self.density * slips**two * (amplitude / two - slips / three)
        if amplitude > most:
            last = self.stiffness * self.beta / (1.0 + self.beta)
            exact += 4.0 * last * most * (amplitude - most)
        return float(made / exact - 1.0)

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return a row for each slider."""
        return tuple(
            Row(slider(stiffness, stiffness * slip), tangents=(BETWEEN,))
            for stiffness, slip in zip(
                *(x.tolist() for x in self.spectrum), strict=True
            )
        )
