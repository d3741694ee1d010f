"""The cases of the stress matrix: each parameter from one extreme to the other."""

from __future__ import annotations

import dataclasses
import typing
from dataclasses import dataclass

from microslip.experiments import Curve, March, Sweep
from microslip.quantity import SceneError
from microslip.scene_file import Scene
from microslip.scenes.two_blades.tables import TwoBlades

SIGMAS = (3e-6, 3e-7, 3e-8, 3e-9, 3e-10, 3e-11)
THRESHOLDS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
"""V_lim [m/s]"""
FRICTIONS = (0.0, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 1e6)
"""µ; the last one sticks"""
PRELOADS = (0.0, 1e-3, 0.1, 1.0, 10.0, 100.0, 1e3)
"""[N]"""
DRIVES = (1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3)
"""[N]"""
DAMPINGS = (0.0, 0.01, 0.1, 0.2, 0.5, 1.0)
"""of the contacts' normal motion, ratio"""
ROPES = (0.0, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6)
"""[N/m]"""
MASSES = (1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3)
"""of the friction element, inertia too, over the scene's"""
EXPONENTS = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0)
FALLS = (0.5, 0.1, 1e-2, 1e-3)
"""V_str [m/s] of GKF, µs being ten times µd"""
STATICS = (1.0, 2.0, 5.0, 10.0)
"""µs/µd of GKF at the steepest of them"""
RATIOS = (0.0, 2e-4, 2e-3, 0.02, 0.1, 0.2)
"""damping ratios of the structure"""
HARMONICS = (1, 3, 5, 7, 15, 31, 63)
IMPACTS = (0.1, 1.0, 10.0, 100.0)
"""drives [N] at which a nearly loose element separates and strikes"""
LOOSE = 0.01
"""its preload [N]"""
STOPS = (1e3, 1e4, 1e5, 1e6, 1e7)
"""stiffness [N/m] of a stop that the mass of the scene "gap" strikes"""
NOMINAL = 2e-3
"""damping ratio that the rig's α and β make at its frequencies"""
BAD = ("nan", "inf", "-inf", "1e999", "1e308")
"""the last is a number: the curve that is made of it must be finite, or one line"""


@dataclass(frozen=True, slots=True)
class Case:
    """One cell of the matrix."""

    parameter: str
    """its row"""
    value: str
    """what stands in the cell"""
    overrides: tuple[str, ...]
    """as ``--set`` takes them"""
    scene: str | None = None
    """a built-in one instead of the scene that is put under stress"""
    refusals: tuple[tuple[str, ...], ...] = ()
    """overrides of which each must be refused, or computed to a finite end"""


def cases(scene: Scene, *, quick: bool = False) -> list[Case]:
    """Return the matrix, row by row; ``quick`` takes of each row the last value.

    Raises
    ------
    SceneError
        If the scene is not one of two blades.
    """
    if not isinstance(scene.rig, TwoBlades):
        raise SceneError(
            "stress changes the numbers of two blades: give a scene of the kind "
            'scene = "two-blades"'
        )
    found = [*_contact(), *_loads(), *_structure(scene.rig), *_refused()]
    if not quick:
        return found
    last = {case.parameter: case for case in found if not case.refusals}
    return [*last.values(), *(case for case in found if case.refusals)]


def _row(
    name: str,
    values: typing.Iterable[float],
    *templates: str,
    scene: str | None = None,
) -> list[Case]:
    """Return the cases of one row; a template holds ``{}`` where the value goes."""
    return [
        Case(
            name,
            f"{value:g}",
            tuple(each.format(repr(value)) for each in templates),
            scene,
        )
        for value in values
    ]


def _contact() -> list[Case]:
    """Return the rows of the contacts' numbers."""
    exponents = [
        Case(
            "exponent",
            f"{power:g}",
            (
                f"contact.exponent={power}",
                f"contact.damping_exponent={(power - 1.0) / 2.0}",
            ),
        )
        for power in EXPONENTS
    ]
    gkf = ("friction.law=gkf", "friction.mu_dynamic=0.1")
    steep = ("friction.mu_static=1.0", "friction.stribeck_velocity={}")
    statics = [
        Case(
            "GKF µs/µd",
            f"{ratio:g}",
            (
                *gkf,
                f"friction.mu_static={0.1 * ratio}",
                "friction.stribeck_velocity=1e-3",
            ),
        )
        for ratio in STATICS
    ]
    return [
        *_row("sigma", SIGMAS, "contact.sigma={}"),
        *_row("V_lim [m/s]", THRESHOLDS, "friction.threshold_velocity={}"),
        *_row("mu", FRICTIONS, "friction.mu_dynamic={}", "friction.mu_static={}"),
        *_row("contact damping", DAMPINGS, "contact.damping_ratio={}"),
        *exponents,
        *_row("GKF V_str [m/s]", FALLS, *gkf, *steep),
        *statics,
    ]


def _loads() -> list[Case]:
    """Return the rows of loads, and of what separates and strikes."""
    loose = (f"preload.force={LOOSE}", "excitation.force={}")
    return [
        *_row("preload [N]", PRELOADS, "preload.force={}"),
        *_row("drive [N]", DRIVES, "excitation.force={}"),
        *_row("impacts, drive [N]", IMPACTS, *loose),
        *_row("stop [N/m]", STOPS, "element.stop.stiffness={}", scene="gap"),
    ]


def _structure(rig: TwoBlades) -> list[Case]:
    """Return the rows of masses, springs, damping, and of the harmonics."""
    element, blade = rig.friction_element, rig.blade
    names = ("mass", "inertia_x", "inertia_y", "inertia_z")
    masses = [
        Case(
            "element mass x",
            f"{factor:g}",
            tuple(
                f"friction_element.{name}={factor * getattr(element, name)!r}"
                for name in names
            ),
        )
        for factor in MASSES
    ]
    terms = ("mass_damping", "stiffness_damping")
    dampings = [
        Case(
            "damping ratio",
            f"{ratio:g}",
            tuple(
                f"blade.{name}={getattr(blade, name) * ratio / NOMINAL!r}"
                for name in terms
            ),
        )
        for ratio in RATIOS
    ]
    return [
        *_row("rope [N/m]", ROPES, "rope.stiffness={}"),
        *masses,
        *dampings,
        *_row("harmonics", HARMONICS, "curve.harmonics={}"),
    ]


def _refused() -> list[Case]:
    """Return, for each table, every number of it replaced by each bad value."""
    tables = {"sweep": numbers(Sweep), "curve": numbers(Curve), "march": numbers(March)}
    for table, hint in typing.get_type_hints(TwoBlades).items():
        kinds = [each for each in _kinds(hint) if dataclasses.is_dataclass(each)]
        tables[table] = [key for kind in kinds for key in numbers(kind)]
    return [
        Case(bad, table, (), refusals=tuple((f"{table}.{key}={bad}",) for key in keys))
        for bad in BAD
        for table, keys in tables.items()
        if keys
    ]


def numbers(table: typing.Any) -> list[str]:  # noqa: ANN401  (a dataclass)
    """Return the names of the numbers, and lists of them, in a table of scenes."""
    hints = typing.get_type_hints(table)
    return [
        field.name
        for field in dataclasses.fields(table)
        if "quantity" in field.metadata
        and {float, int} & {hints[field.name], *_kinds(hints[field.name])}
    ]


def _kinds(hint: object) -> tuple[object, ...]:
    return typing.get_args(hint) or (hint,)
