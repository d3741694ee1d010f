"""Energies over time, and what their balance leaves."""

from __future__ import annotations

from typing import Protocol

from microslip_mechanics.arrays import Array


class Energies(Protocol):
    """What has flowed and what is stored in rows, of a history or of an envelope."""

    @property
    def energies(self) -> tuple[str, ...]:
        """Names of the columns."""
        ...

    @property
    def energy(self) -> Array:
        """[J], shape (rows, energies)."""
        ...

    @property
    def stored_at_start(self) -> float:
        """Energy stored when the march began [J]."""
        ...


def energy_of(result: Energies, name: str) -> Array:
    """Return one energy [J], shape (rows,)."""
    column: Array = result.energy[:, result.energies.index(name)]
    return column


def closing_error(result: Energies) -> Array:
    """Return what the energy balance leaves [J], shape (rows,) (theory, eq. 26)."""
    others = [place for place, name in enumerate(result.energies) if name != "input"]
    spent: Array = result.energy[:, others].sum(axis=1)
    return energy_of(result, "input") + result.stored_at_start - spent


def worded(name: str, *, pulls: bool) -> str:
    """Return the words for an energy; of springs and dampers, which pull, no normal."""
    return (
        "element damping"
        if pulls and name == "normal_damping"
        else name.replace("_", " ")
    )
