"""What a solver is given: a structure, its contacts, its loads and what to watch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.structures.structure import Structure


@dataclass(frozen=True, slots=True)
class Probes:
    """Displacements that a result reports, each a linear form of the motion."""

    names: tuple[str, ...]
    rows: Array
    """shape (probes, dofs)"""

    def __post_init__(self) -> None:
        """Check that each row has a name."""
        if self.rows.ndim != 2 or len(self.rows) != len(self.names):
            raise ValueError(
                f"probe rows have shape {self.rows.shape}, but there are "
                f"{len(self.names)} names: give one row for each"
            )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Problem:
    """M ü + C u̇ + K u + Lᵀ f(L u, L u̇) = preload + Im(drive · e^(i excitation phase)).

    A real drive acts in phase with the sine. A problem equals itself alone, and may be
    a key of what was computed of it.
    """

    structure: Structure
    interface: Interface
    preload: Array
    """static load [N], shape (dofs,)"""
    drive: Array | ComplexArray
    """amplitude of the harmonic load [N], complex where phases differ, shape (dofs,)"""
    probes: Probes

    def __post_init__(self) -> None:
        """Check that everything speaks of the same degrees of freedom."""
        dofs = self.structure.dofs
        for name, array, entry in (
            ("preload", self.preload, "number"),
            ("drive", self.drive, "number"),
            ("interface.displacement", self.interface.displacement, "column"),
            ("probes.rows", self.probes.rows, "column"),
        ):
            axes = 1 if entry == "number" else 2
            if array.ndim != axes or array.shape[-1] != dofs:
                raise ValueError(
                    f"{name} has shape {array.shape}, but the structure has {dofs} "
                    f"degrees of freedom: give a {entry} for each"
                )
        for name in ("preload", "drive"):
            if not np.isfinite(getattr(self, name)).all():
                raise ValueError(
                    f"{name} holds a value that is not finite: give finite forces"
                )

    def __repr__(self) -> str:
        """Return what kind of problem it is, in a line."""
        contacts = ", ".join(self.interface.names) or "none"
        count = self.structure.dofs
        dofs = "1 degree" if count == 1 else f"{count} degrees"
        return (
            f"<Problem: {dofs} of freedom; contacts {contacts}; "
            f"probes {', '.join(self.probes.names)}>"
        )

    @property
    def in_phase(self) -> bool:
        """Whether everything is driven in phase with one sine."""
        return not np.iscomplexobj(self.drive)

    @property
    def loads(self) -> Array:
        """Preload and drive [N], shape (2, dofs); with phases (3, dofs).

        The last row is then what goes with the cosine, a quarter of a period ahead.
        """
        rows = [self.preload, self.drive.real]
        return np.stack(rows if self.in_phase else [*rows, self.drive.imag])

    @property
    def force_scale(self) -> float:
        """The smaller of preload and drive, of those that act [N]."""
        sizes = [np.abs(load).max(initial=0.0) for load in (self.preload, self.drive)]
        return float(min((size for size in sizes if size > 0.0), default=1.0))
