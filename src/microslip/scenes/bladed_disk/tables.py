"""The tables of a bladed disk: every number, with unit and range."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal

from microslip.scenes.quantity import quantity

PARTS = ("disk", "root", "middle", "tip")
"""masses of a sector, in their order"""


@dataclass(frozen=True, slots=True)
class Sector:
    """Lumped masses in a row, the first of them tied to its neighbours."""

    masses: tuple[float, ...] = quantity("kg", positive=True)
    """disk, root, middle, tip"""
    springs: tuple[float, ...] = quantity("N/m", positive=True)
    """between them"""
    ground: float = quantity("N/m", lowest=0.0)
    coupling: float = quantity("N/m", lowest=0.0)
    mass_damping: float = quantity("1/s", lowest=0.0)
    stiffness_damping: float = quantity("s", lowest=0.0, highest=1.0)

    def __post_init__(self) -> None:
        """Check the numbers of masses and springs."""
        between = [" to ".join(pair) for pair in itertools.pairwise(PARTS)]
        for name, wanted in (("masses", PARTS), ("springs", between)):
            count = len(getattr(self, name))
            if count != len(wanted):
                raise ValueError(
                    f"[sector] {name} has {count} number{'s' * (count != 1)}: give "
                    f"{len(wanted)}, for {', '.join(wanted)}"
                )
        if self.ground == 0.0:
            raise ValueError(
                "[sector] ground = 0: the disk is free: tie it to the ground"
            )


@dataclass(frozen=True, slots=True)
class Friction:
    """Between the tips of two neighbouring blades."""

    law: Literal["jenkins", "coulomb"] = quantity()
    stiffness: float = quantity("N/m", positive=True)
    limit: float = quantity("N", lowest=0.0)
    threshold: float = quantity("m/s", positive=True)


@dataclass(frozen=True, slots=True)
class Drive:
    """A wave around the disk, at the tips."""

    engine_order: int = quantity(lowest=1, highest=10**4)
    amplitude: float = quantity("N", lowest=0.0)


@dataclass(frozen=True, slots=True)
class Mistuning:
    """Random changes of the stiffness of each sector."""

    deviation: float = quantity(lowest=0.0, highest=0.2)
    seed: int = quantity(lowest=0, highest=2**32 - 1)


@dataclass(frozen=True, slots=True)
class BladedDisk:
    """A bladed disk."""

    sector: Sector
    friction: Friction
    drive: Drive
    mistuning: Mistuning
    solve: Literal["sector", "disk"] = quantity()
    sectors: int = quantity(lowest=2, highest=200)

    def __post_init__(self) -> None:
        """Check that one sector can stand for all."""
        if self.solve == "sector" and self.mistuning.deviation > 0.0:
            raise ValueError(
                f"[mistuning] deviation = {self.mistuning.deviation:g}: one sector "
                'cannot stand for mistuned ones: give solve = "disk"'
            )
