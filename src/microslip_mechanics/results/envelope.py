"""Envelope of a march: one row for each cycle of the drive."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.by_value import ByValue
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.energies import closing_error, energy_of
from microslip_mechanics.results.response_curve import pulling


@dataclass(frozen=True, slots=True, eq=False)
class Envelope(ByValue):
    """Extremes of each cycle, and what flowed until its end."""

    time: Array
    """end of each cycle [s], shape (cycles,)"""
    frequency: Array
    """of the drive [rad/s], shape (cycles,)"""
    level: Array
    """amplitude of the drive's sine over the problem's, shape (cycles,)"""
    probes: tuple[str, ...]
    highest: Array
    """displacement of each probe [m], shape (cycles, probes)"""
    lowest: Array
    """displacement of each probe [m], shape (cycles, probes)"""
    fastest: Array
    """largest velocity of each probe [m/s], shape (cycles, probes)"""
    contacts: tuple[str, ...]
    normal_smallest: Array
    """of each contact point [N], shape (cycles, contacts)"""
    normal_largest: Array
    """of each contact point [N], shape (cycles, contacts)"""
    energies: tuple[str, ...]
    energy: Array
    """[J], shape (cycles, energies): what flowed so far and what is stored"""
    stored_at_start: float
    """energy stored when the march began [J]"""
    time_step: float
    """[s]"""
    iterations: int
    """Newton iterations of all steps"""
    divided: int
    """steps that converged only when they were divided"""
    ending: str = "complete"
    """how the march ended: "complete", "interrupted", or the cause"""
    checkpoint: Checkpoint | None = None
    """where the march can go on; the cycle begun there is in its memory"""

    energy_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the energy taken out by friction until the ends of the cycles [J],
    shape (cycles,), or empty if not estimated"""
    peak_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the largest amplitude, relative, like ``energy_error``"""
    work_difference: Array = field(default_factory=lambda: np.zeros(0))
    """friction's energy less that by another way [J], like ``energy_error``"""

    def __repr__(self) -> str:
        """Return what kind of envelope it is, in a line."""
        until = f" until {self.time[-1]:g} s" if self.time.size else ""
        return (
            f"<Envelope: {self.time.size} cycles{until}; "
            f"probes {', '.join(self.probes)}; {self.ending}>"
        )

    @property
    def pulls(self) -> bool:
        """Whether springs or dampers are among the contacts, which hardly pull."""
        return pulling(self.normal_smallest, self.normal_largest)

    def of(self, energy: str) -> Array:
        """Return one energy at the ends of the cycles [J], shape (cycles,)."""
        return energy_of(self, energy)

    @property
    def closing_error(self) -> Array:
        """What the energy balance leaves [J], shape (cycles,) (theory, eq. 26)."""
        return closing_error(self)

    @property
    def swing(self) -> Array:
        """Half of the way from lowest to highest [m], shape (cycles, probes)."""
        half: Array = 0.5 * (self.highest - self.lowest)
        return half
