"""The table [structure] of a scene of kind ``system``."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

from microslip.scenes.quantity import Quantity, SceneError
from microslip.scenes.systems.tables import Matrices, Numbers
from microslip.scenes.table import meant, read_numbers, read_table, shown, written

MATRICES = ("mass", "stiffness", "damping")
NUMBERS = tuple(each.name for each in fields(Numbers))
MASS = Quantity("kg", 0.0, float("inf"), positive=True)


def read_sets(source: str, values: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Return the nodes of each set."""
    given = values.get("sets", {})
    if not isinstance(given, dict):
        raise SceneError(
            f"{source}: [structure.sets] must be a table, not {written(given)}"
        )
    for name, nodes in given.items():
        if not _texts(nodes) or not nodes:
            raise SceneError(
                f"{source}: [structure.sets] {name}{shown(nodes)}: give a list of "
                'nodes as texts, such as ["12", "13"]'
            )
    return {name: tuple(nodes) for name, nodes in given.items()}


def read_matrices(source: str, values: dict[str, Any]) -> Matrices:
    """Return the matrices as they stand there."""
    _check_keys(source, values)
    names = values.get("names")
    if names is not None and not _texts(names):
        raise SceneError(
            f"{source}: [structure] names{shown(names)}: give a list of texts"
        )
    swerve = values.get("gyroscopic")
    if isinstance(swerve, str):
        raise SceneError(
            f"{source}: [structure] gyroscopic{shown(swerve)}: give its rows, those of "
            "files are not read"
        )
    rows = {
        key: _rows(source, key, values.get(key)) for key in (*MATRICES, "gyroscopic")
    }
    named = None if names is None else tuple(names)
    return Matrices(**rows, names=named, folder=Path(source).parent)


def _check_keys(source: str, values: dict[str, Any]) -> None:
    """Check that there are matrices or a beam, and nothing unknown."""
    known = (*MATRICES, *NUMBERS, "gyroscopic", "names", "masses", "sets")
    for key in values:
        if key not in known:
            raise SceneError(
                f"{source}: [structure] {key}{shown(values[key])} is unknown"
                f"{meant(key, known)}"
            )
    alone = (*MATRICES, "gyroscopic", "names")
    both = [key for key in alone if key in values and "beam" in values]
    if both:
        raise SceneError(
            f"{source}: [structure] {both[0]} and beam: give matrices or a beam, one "
            "of the two"
        )
    for key in () if "beam" in values else MATRICES[:2]:
        if key not in values:
            raise SceneError(
                f"{source}: [structure] {key} is missing: add it, or a [structure.beam]"
            )


def _rows(source: str, key: str, given: object) -> Any:  # noqa: ANN401  (text or rows)
    """Return a matrix that can be compared: lists become tuples."""
    if given is None or isinstance(given, str):
        return given
    if not isinstance(given, list):
        raise SceneError(
            f"{source}: [structure] {key}{shown(given)}: give rows, the diagonal, or "
            "the name of a file"
        )
    return tuple(tuple(row) if isinstance(row, list) else row for row in given)


def _texts(values: object) -> bool:
    return isinstance(values, list) and all(isinstance(each, str) for each in values)


def read_structure_numbers(source: str, values: dict[str, Any]) -> Numbers:
    """Return what the structure has beside matrices."""
    given = {key: values[key] for key in NUMBERS if key in values}
    try:
        made: Numbers = read_table(source, "[structure] ", Numbers, given)
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None
    return made


def read_masses(source: str, values: dict[str, Any]) -> dict[str, float]:
    """Return the point masses beside a beam."""
    _check_rotation(source, values)
    if "masses" in values and "beam" not in values:
        raise SceneError(
            f"{source}: [structure] masses belong to a beam: add a [structure.beam], "
            "or put them into the mass matrix"
        )
    return read_numbers(source, "structure.masses", values.get("masses", {}), MASS)


def _check_rotation(source: str, values: dict[str, Any]) -> None:
    """Check that what rotates is a beam in space, alone."""
    beam = values.get("beam")
    if "rotation" not in values or not isinstance(beam, dict | None):
        return
    for wrong, cause, remedy in (
        (beam is None, "belongs to a beam", "add a [structure.beam]"),
        (
            beam is not None and beam.get("plane", False),
            "stretches a beam, which plane = true does not let it",
            "give plane = false",
        ),
        (
            bool(values.get("masses")),
            "needs the places of point masses, which [structure.masses] has not",
            "leave one of the two out",
        ),
    ):
        if wrong:
            raise SceneError(f"{source}: [structure.rotation] {cause}: {remedy}")
