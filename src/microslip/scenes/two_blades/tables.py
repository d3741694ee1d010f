"""The tables of a two-blade scene: every number of the rig, with unit and range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from microslip.scenes.quantity import quantity
from microslip.scenes.rotation import SteadyRotation


@dataclass(frozen=True, slots=True)
class Blade:
    """Both blades; only the excited one leans."""

    length: float = quantity("m", positive=True, highest=10.0)
    elements: int = quantity(lowest=1, highest=100)
    width: float = quantity("m", positive=True, highest=1.0)
    thickness: float = quantity("m", positive=True, highest=1.0)
    young_modulus: float = quantity("Pa", lowest=1e6, highest=2e12)
    poisson_ratio: float = quantity(lowest=0.0, highest=0.5)
    density: float = quantity("kg/m^3", lowest=1.0, highest=3e4)
    mass_damping: float = quantity("1/s", lowest=0.0)
    stiffness_damping: float = quantity("s", lowest=0.0, highest=1.0)
    fan: float = quantity("rad", lowest=-0.7, highest=0.7)


@dataclass(frozen=True, slots=True)
class BladeEnd:
    """Rigid shroud at a blade's tip."""

    mass: float = quantity("kg", lowest=0.0)
    inertia_x: float = quantity("kg m^2", lowest=0.0)
    inertia_y: float = quantity("kg m^2", lowest=0.0)
    inertia_z: float = quantity("kg m^2", lowest=0.0)
    width: float = quantity("m", positive=True, highest=10.0)
    offset: float = quantity("m", lowest=-1.0, highest=1.0)


@dataclass(frozen=True, slots=True)
class FrictionElement:
    """Rigid wedge between the shrouds."""

    mass: float = quantity("kg", positive=True)
    inertia_x: float = quantity("kg m^2", positive=True)
    inertia_y: float = quantity("kg m^2", positive=True)
    inertia_z: float = quantity("kg m^2", positive=True)
    height: float = quantity("m", positive=True, highest=1.0)
    width: float = quantity("m", positive=True, highest=1.0)
    depth: float = quantity("m", positive=True, highest=1.0)
    shift: float = quantity("m", lowest=-1.0, highest=1.0)


@dataclass(frozen=True, slots=True)
class Rope:
    """Spring that holds the friction element along z."""

    stiffness: float = quantity("N/m", lowest=0.0)


@dataclass(frozen=True, slots=True)
class Contact:
    """Normal law of both faces."""

    sigma: float = quantity(positive=True)
    exponent: float = quantity(lowest=1.0, highest=10.0)
    damping_ratio: float = quantity(lowest=0.0, highest=10.0)
    damping_exponent: float = quantity(lowest=0.0, highest=10.0)
    clamped: bool = quantity()
    angle_excited: float = quantity("rad", lowest=-1.2, highest=1.2)
    angle_follower: float = quantity("rad", lowest=-1.2, highest=1.2)


@dataclass(frozen=True, slots=True)
class Friction:
    """Friction law of both faces."""

    law: Literal["coulomb", "gkf", "none"] = quantity()
    mu_dynamic: float = quantity(lowest=0.0)
    mu_static: float = quantity(lowest=0.0)
    threshold_velocity: float = quantity("m/s", positive=True)
    stribeck_velocity: float = quantity("m/s", positive=True)
    stribeck_exponent: float = quantity(positive=True, highest=10.0)
    viscous: float = quantity("N s/m", lowest=0.0)


@dataclass(frozen=True, slots=True)
class Preload:
    """Radial force on the friction element."""

    force: float = quantity("N", lowest=0.0)
    offset: float = quantity("m", lowest=-1.0, highest=1.0)


@dataclass(frozen=True, slots=True)
class Excitation:
    """Axial force on the excited blade's end."""

    force: float = quantity("N", lowest=0.0)
    offset: float = quantity("m", lowest=-1.0, highest=1.0)


@dataclass(frozen=True, slots=True)
class TwoBlades:
    """The two-blade rig."""

    blade: Blade
    blade_end: BladeEnd
    friction_element: FrictionElement
    contact: Contact
    friction: Friction
    preload: Preload
    excitation: Excitation
    model: Literal["full", "B", "A"] = quantity()
    rope: Rope | None = None
    rotation: SteadyRotation | None = None

    def __post_init__(self) -> None:
        """Check what more than one number decides."""
        wedge = self.contact.angle_excited + self.contact.angle_follower
        if wedge <= 0.0:
            raise ValueError(
                f"[contact] angle_excited + angle_follower = {wedge:g} rad: the faces "
                "must form a wedge that the preload pushes into: give a positive sum"
            )
