"""The cases of the stress matrix: each parameter from one extreme to the other."""

from __future__ import annotations

from microslip.scenes.quantity import SceneError
from microslip.scenes.scene import Scene
from microslip.scenes.two_blades.tables import Blade, FrictionElement, TwoBlades
from microslip.studies.stress.bad_values import bad_values
from microslip.studies.stress.case import Case, row

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
STATICS = (1.0, 2.0, 5.0)
"""µs/µd of GKF at the steepest of them, where 10 has been had"""
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


def cases(scene: Scene, *, quick: bool = False) -> list[Case]:
    """Return the matrix, row by row; ``quick`` takes of each row the last value.

    The first case is the scene itself.

    Raises
    ------
    SceneError
        If the scene is not one of two blades, or nothing drives it.
    """
    if not isinstance(scene.rig, TwoBlades):
        raise SceneError(
            "stress changes the numbers of two blades: give a scene of the kind "
            'scene = "two-blades"'
        )
    rig = scene.rig
    if rig.excitation.force == 0.0:
        raise SceneError(
            "[excitation] force = 0 N: nothing vibrates, so there is nothing to "
            "compare: give a force"
        )
    own = [Case("scene", "as it is", ())]
    # first what is seldom out of time: what it leaves is for the others
    solved = [*own, *_structure(rig), *_loads(rig), *_contact(rig)]
    if quick:
        solved = list({case.parameter: case for case in solved}.values())
    return [*solved, *bad_values()]


def _contact(rig: TwoBlades) -> list[Case]:
    """Return the rows of the contacts' numbers."""
    contact, friction = rig.contact, rig.friction
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
        if power != contact.exponent
    ]
    return [
        *row("sigma", SIGMAS, "contact.sigma={}", own=contact.sigma),
        *row(
            "V_lim [m/s]",
            THRESHOLDS,
            "friction.threshold_velocity={}",
            own=friction.threshold_velocity,
        ),
        *row(
            "mu",
            FRICTIONS,
            "friction.mu_dynamic={}",
            "friction.mu_static={}",
            own=friction.mu_dynamic,
        ),
        *row(
            "contact damping",
            DAMPINGS,
            "contact.damping_ratio={}",
            own=contact.damping_ratio,
        ),
        *exponents,
        *_kinetic(),
    ]


def _kinetic() -> list[Case]:
    """Return the rows of friction that falls with the speed."""
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
    return [*row("GKF V_str [m/s]", FALLS, *gkf, *steep), *statics]


def _loads(rig: TwoBlades) -> list[Case]:
    """Return the rows of loads, and of what separates and strikes."""
    loose = (f"preload.force={LOOSE}", "excitation.force={}")
    held, driven = rig.preload.force, rig.excitation.force
    return [
        *row("preload [N]", PRELOADS, "preload.force={}", own=held),
        *row("drive [N]", DRIVES, "excitation.force={}", own=driven),
        *row("impacts, drive [N]", IMPACTS, *loose),
        *row("stop [N/m]", STOPS, "element.stop.stiffness={}", scene="gap"),
    ]


def _structure(rig: TwoBlades) -> list[Case]:
    """Return the rows of masses, springs, damping, and of the harmonics."""
    rope = None if rig.rope is None else rig.rope.stiffness
    return [
        *row("rope [N/m]", ROPES, "rope.stiffness={}", own=rope),
        *_masses(rig.friction_element),
        *_dampings(rig.blade),
        *row("harmonics", HARMONICS, "curve.harmonics={}"),
    ]


def _masses(element: FrictionElement) -> list[Case]:
    """Return the row of the friction element's mass, its inertia in proportion."""
    names = ("mass", "inertia_x", "inertia_y", "inertia_z")
    return [
        Case(
            "element mass x",
            f"{factor:g}",
            tuple(
                f"friction_element.{name}={factor * getattr(element, name)!r}"
                for name in names
            ),
        )
        for factor in MASSES
        if factor != 1.0
    ]


def _dampings(blade: Blade) -> list[Case]:
    """Return the row of the blades' damping ratio."""
    terms = ("mass_damping", "stiffness_damping")
    return [
        Case(
            "damping ratio",
            f"{ratio:g}",
            tuple(
                f"blade.{name}={getattr(blade, name) * ratio / NOMINAL!r}"
                for name in terms
            ),
        )
        for ratio in RATIOS
        if ratio != NOMINAL
    ]
