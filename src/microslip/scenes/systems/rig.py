"""The tables of a scene of kind ``system``, and the problem that they make."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from microslip.matrices.read import MatrixFiles, read_structure
from microslip.matrices.source import MatrixSource
from microslip.quantity import SceneError, quantity
from microslip.scenes.systems.cantilever import Cantilever, assembled
from microslip_mechanics.element import Element
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.forms import Form, Pair
from microslip_mechanics.laws.row import Law
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system

Rows: TypeAlias = str | tuple[Any, ...]
"""a matrix: name of its file, rows, or diagonal"""
SMALL = 400
"""degrees of freedom of a structure from files up to which its matrices are dense"""


@dataclass(frozen=True, slots=True)
class Numbers:
    """What the structure has beside matrices; all of it may be left out."""

    beam: Cantilever | None = None
    """in place of matrices"""
    damping_ratio: float | None = quantity(lowest=0.0, highest=0.999, optional=True)
    mass_damping: float | None = quantity("1/s", lowest=0.0, optional=True)
    stiffness_damping: float | None = quantity("s", lowest=0.0, optional=True)

    @property
    def rayleigh(self) -> tuple[float, float] | None:
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
    names: tuple[str, ...] | None
    folder: Path
    """in which files are sought"""


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
    ends: Mapping[str, Mapping[str, Any]]
    """directions of each element, by key"""
    drive: Mapping[str, Wave]
    preload: Mapping[str, float]
    probes: Mapping[str, Form | Pair] | Sequence[str] | None


def problem(rig: System) -> Problem:
    """Return the problem of a scene of kind ``system``.

    Raises
    ------
    SceneError
        In one line: with the scene, what is wrong and what to give instead.
    """
    try:
        return system(
            **_matrices(rig),
            damping_ratio=rig.structure.damping_ratio,
            rayleigh_damping=rig.structure.rayleigh,
            elements=[
                Element(law, **rig.ends[name], name=name)
                for name, law in rig.element.items()
            ],
            drive={name: (w.amplitude, w.phase) for name, w in rig.drive.items()},
            preload=rig.preload,
            probes=rig.probes,
        )
    except (ValueError, MicroslipError) as error:
        raise SceneError(f"{rig.source}: {error}") from None


def _matrices(rig: System) -> dict[str, Any]:
    """Return the matrices, and the names if there are any."""
    given = rig.matrices
    if rig.structure.beam is not None:
        made = assembled(rig.structure.beam, rig.masses)
        return {"mass": made.mass, "stiffness": made.stiffness, "names": made.names}
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
    return {**matrices, "names": given.names or read.names}
