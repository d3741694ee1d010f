"""From the tables of a scene of kind ``system`` to its problem."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

from microslip.matrices.read import MatrixFiles, read_structure
from microslip.matrices.source import MatrixSource
from microslip.scenes.quantity import SceneError
from microslip.scenes.systems.cantilever import assembled
from microslip.scenes.systems.tables import Numbers, RayleighRatios, System
from microslip_mechanics.element import Element
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.loads.base_motion import BaseMotion
from microslip_mechanics.loads.engine_order import EngineOrder
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.rayleigh import Rayleigh
from microslip_mechanics.system import system

if TYPE_CHECKING:
    from microslip_mechanics.reduction.reduced_problem import ReducedProblem
    from microslip_mechanics.structures.frame import Frame
    from microslip_mechanics.structures.rotating_frame import RotatingFrame

Made = TypeVar("Made")
SMALL = 400
"""degrees of freedom of a structure from files up to which its matrices are dense"""


def problem(rig: System) -> Problem:
    """Return the problem of a scene of kind ``system``.

    Raises
    ------
    SceneError
        In one line: with the scene, what is wrong and what to give instead.
    """
    reduced = reduction(rig)
    return _told(rig, lambda: _whole(rig)) if reduced is None else reduced.problem


def reduction(rig: System) -> ReducedProblem | None:
    """Return the reduced problem of a scene; None if it has no [structure.reduction].

    Raises
    ------
    SceneError
        As for :func:`problem`.
    """
    wanted = rig.structure.reduction
    if wanted is None:
        return None
    from microslip_mechanics.reduction.reduced_problem import reduced_problem

    return _told(
        rig,
        lambda: reduced_problem(
            _whole(rig),
            wanted.highest,
            method=wanted.method,
            keep=wanted.keep,
            sets=rig.sets,
        ),
    )


def _told(rig: System, make: Callable[[], Made]) -> Made:
    """Name the scene in an error."""
    try:
        return make()
    except (ValueError, MicroslipError) as error:
        raise SceneError(f"{rig.source}: {error}") from None


def _whole(rig: System) -> Problem:
    """Return the problem with all degrees of freedom."""
    beam, base = rig.structure.beam, rig.base
    moved = None if base is None else BaseMotion(base.direction, base.acceleration)
    if beam is None:
        return _made(rig, _matrices(rig), moved)
    frame = assembled(beam, rig.masses)
    turned = _turning(rig, frame)
    shown = (turned or frame).structure()
    matrices = {"mass": shown.mass, "stiffness": shown.stiffness, "names": shown.names}
    made = _made(rig, matrices, None)
    if moved is not None:
        made = _moved(made, frame, moved)
    return made if turned is None else _turned(made, turned)


def _moved(made: Problem, frame: Frame, motion: BaseMotion) -> Problem:
    """Return a problem whose ground moves."""
    from microslip_mechanics.loads.base_excitation import frame_carried_inertia

    load = motion.load_of(frame_carried_inertia(frame, motion.unit))
    return replace(made, drive=made.drive + load)


def _turning(rig: System, frame: Frame) -> RotatingFrame | None:
    """Return a frame in axes that turn; None if they do not."""
    if rig.structure.rotation is None:
        return None
    from microslip.scenes.turning import turning

    return turning(frame, rig.structure.rotation)


def _turned(made: Problem, turned: RotatingFrame) -> Problem:
    """Return a problem with the loads and Coriolis forces of rotation."""
    swerve = turned.coriolis()
    structure = replace(
        made.structure,
        damping=made.structure.damping + swerve,
        gyroscopic=bool(swerve.any()),
    )
    return replace(made, structure=structure, preload=made.preload + turned.load())


def _made(rig: System, matrices: dict[str, Any], base: BaseMotion | None) -> Problem:
    """Return the problem of some matrices."""
    order, wave = rig.engine_order, None
    if order is not None:
        wave = EngineOrder(order.blades, order.order, order.amplitude)
    return system(
        **matrices,
        **_damping(rig.structure),
        elements=[
            Element(law, **directions, name=place)
            for name, law in rig.element.items()
            for place, directions in rig.ends[name].items()
        ],
        drive={name: (w.amplitude, w.phase) for name, w in rig.drive.items()},
        preload=rig.preload,
        engine_order=wave,
        base=base,
        probes=rig.probes,
        sets=rig.sets,
    )


def _matrices(rig: System) -> dict[str, Any]:
    """Return the matrices, and the names if there are any."""
    given = rig.matrices
    files = {
        name: MatrixSource.of(value, given.folder)
        for name in ("mass", "stiffness", "damping")
        if isinstance(value := getattr(given, name), str)
    }
    if not files:
        return {
            "mass": given.mass,
            "stiffness": given.stiffness,
            "damping": given.damping,
            "gyroscopic": given.gyroscopic,
            "names": given.names,
        }
    if len(files) < (2 if given.damping is None else 3):
        raise ValueError(
            "[structure] some matrices are files, others not: give all of them alike"
        )
    read = read_structure(MatrixFiles(**files))
    matrices = {name: getattr(read, name) for name in files}
    if read.dofs <= SMALL:
        matrices = {name: matrix.toarray() for name, matrix in matrices.items()}
    others = {"gyroscopic": given.gyroscopic, "names": given.names or read.names}
    return {**matrices, **others}


def _damping(given: Numbers) -> dict[str, Any]:
    """Return what is said of damping, in the words of :func:`system`."""
    ways = {
        "damping_ratio": given.damping_ratio,
        "damping_ratios": given.damping_ratios,
        "rayleigh": given.rayleigh,
        "mass_damping and stiffness_damping": given.proportional,
        "loss_factor": given.loss_factor,
    }
    said = [name for name, value in ways.items() if value is not None]
    if len(said) > 1:
        raise ValueError(f"[structure] {said[0]} beside {said[1]}: give one of the two")
    if given.rayleigh is not None:
        return {"rayleigh_damping": _rayleigh(given.rayleigh)}
    return {
        "damping_ratio": given.damping_ratio
        if given.damping_ratios is None
        else given.damping_ratios,
        "rayleigh_damping": given.proportional,
        "loss_factor": given.loss_factor,
    }


def _rayleigh(table: RayleighRatios) -> tuple[float, float]:
    """Return α [1/s] and β [s] of two ratios."""
    first, second = (2.0 * math.pi * each for each in table.frequencies)
    one, two = table.ratios
    made = Rayleigh.of_ratios((first, second), (one, two))
    return made.mass, made.stiffness
