"""What a march returns: probes, contact forces and energies over time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.by_value import ByValue
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.energies import closing_error, energy_of
from microslip_mechanics.results.response_curve import pulling


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TimeHistory(ByValue):
    """Response to a load history at stored times."""

    time: Array
    """[s], shape (times,)"""
    probes: tuple[str, ...]
    displacement: Array
    """of each probe [m], shape (times, probes)"""
    velocity: Array
    """of each probe [m/s], shape (times, probes)"""
    contacts: tuple[str, ...]
    normal_force: Array
    """of each contact point [N], shape (times, contacts)"""
    friction_power: Array
    """taken out by friction [W], shape (times,)"""
    energies: tuple[str, ...]
    energy: Array
    """[J], shape (times, energies): what flowed so far and what is stored"""
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
    """at the last time, if the march can go on from there"""

    frequency: Array = field(default_factory=lambda: np.zeros(0))
    """of the drive [rad/s], shape (times,), or empty if not told"""
    level: Array = field(default_factory=lambda: np.zeros(0))
    """amplitude of the drive's sine over the problem's, like ``frequency``"""
    energy_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the energy taken out by friction so far [J], shape (times,), or
    empty if not estimated"""
    peak_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the largest amplitude so far, relative, like ``energy_error``"""
    work_difference: Array = field(default_factory=lambda: np.zeros(0))
    """friction's energy less that by another of two ways, mean force times sliding
    increment and times the mean of both ends' velocities [J], like ``energy_error``"""

    def __repr__(self) -> str:
        """Return what kind of history it is, in a line."""
        until = f" until {self.time[-1]:g} s" if self.time.size else ""
        return (
            f"<TimeHistory: {self.time.size} times{until}; "
            f"probes {', '.join(self.probes)}; {self.ending}>"
        )

    @property
    def pulls(self) -> bool:
        """Whether springs or dampers are among the contacts, which hardly pull."""
        return pulling(self.normal_force, self.normal_force)

    def of(self, energy: str) -> Array:
        """Return one energy over time [J], shape (times,)."""
        return energy_of(self, energy)

    @property
    def closing_error(self) -> Array:
        """What the energy balance leaves [J], shape (times,) (theory, eq. 26)."""
        return closing_error(self)
