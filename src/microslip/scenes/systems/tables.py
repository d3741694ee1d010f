"""The tables of a scene of kind ``system``: every number with unit and range."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from microslip.scenes.quantity import quantity
from microslip.scenes.rotation import SteadyRotation
from microslip.scenes.systems.cantilever import Cantilever
from microslip_mechanics.laws.row import Law
from microslip_mechanics.structures.forms import Form, Pair

Rows: TypeAlias = str | tuple[Any, ...]
"""a matrix: name of its file, rows, or diagonal"""


@dataclass(frozen=True, slots=True)
class RayleighRatios:
    """Damping proportional to mass and stiffness, by two ratios."""

    frequencies: tuple[float, ...] = quantity("Hz", positive=True)
    ratios: tuple[float, ...] = quantity(lowest=0.0, highest=0.999)

    def __post_init__(self) -> None:
        """Check that there are two of each."""
        if len(self.frequencies) != 2 or len(self.ratios) != 2:
            raise ValueError("[structure.rayleigh]: give two frequencies and ratios")


@dataclass(frozen=True, slots=True)
class Reduction:
    """Few coordinates in place of many."""

    highest: float = quantity("Hz", positive=True)
    """frequency up to which modes are kept"""
    method: Literal["craig-bampton", "modal"] = quantity(default="craig-bampton")
    keep: tuple[str, ...] = quantity(default=())
    """degrees of freedom, nodes, patterns or sets that stay coordinates besides"""


@dataclass(frozen=True, slots=True)
class Numbers:
    """What the structure has beside matrices; all of it may be left out."""

    beam: Cantilever | None = None
    """in place of matrices"""
    damping_ratio: float | None = quantity(lowest=0.0, highest=0.999, optional=True)
    """of all modes"""
    damping_ratios: tuple[float, ...] | None = quantity(
        lowest=0.0, highest=0.999, optional=True
    )
    """of the slowest modes"""
    loss_factor: float | None = quantity(lowest=0.0, highest=0.999, optional=True)
    mass_damping: float | None = quantity("1/s", lowest=0.0, optional=True)
    stiffness_damping: float | None = quantity("s", lowest=0.0, optional=True)
    rayleigh: RayleighRatios | None = None
    """in place of both"""
    rotation: SteadyRotation | None = None
    """of the axes in which a beam moves"""
    reduction: Reduction | None = None

    @property
    def proportional(self) -> tuple[float, float] | None:
        """α [1/s] and β [s], if one of them is given."""
        if self.mass_damping is None and self.stiffness_damping is None:
            return None
        return self.mass_damping or 0.0, self.stiffness_damping or 0.0


@dataclass(frozen=True, slots=True)
class Matrices:
    """Matrices of the structure, inline or as names of files."""

    mass: Rows | None
    """none where a beam takes their place"""
    stiffness: Rows | None
    damping: Rows | None
    gyroscopic: Rows | None
    names: tuple[str, ...] | None
    folder: Path
    """in which files are sought"""


@dataclass(frozen=True, slots=True)
class Base:
    """Ground that moves all supports alike."""

    direction: tuple[float, ...] = quantity()
    acceleration: float = quantity("m/s^2")


@dataclass(frozen=True, slots=True)
class Order:
    """A wave that stands still around a disk that turns."""

    blades: tuple[str, ...] = quantity()
    """the loaded degree of freedom of each blade, in the order around the disk"""
    order: int = quantity(lowest=-1000, highest=1000)
    """maxima around the disk"""
    amplitude: float = quantity("N")


@dataclass(frozen=True, slots=True)
class Wave:
    """A harmonic force."""

    amplitude: float = quantity("N")
    phase: float = quantity("rad", default=0.0)


@dataclass(frozen=True, slots=True)
class System:
    """A structure, its elements, loads and probes."""

    source: str
    """the scene, for messages"""
    matrices: Matrices
    structure: Numbers
    masses: Mapping[str, float]
    """beside a beam [kg], by name"""
    element: Mapping[str, Law]
    """by name"""
    ends: Mapping[str, Mapping[str, Mapping[str, Any]]]
    """directions by key, of each contact of each element"""
    drive: Mapping[str, Wave]
    preload: Mapping[str, float]
    probes: Mapping[str, Form | Pair] | Sequence[str] | None
    base: Base | None
    engine_order: Order | None
    sets: Mapping[str, tuple[str, ...]]
    """nodes, by the name of their set"""
