"""From the TOML of a scene of kind ``system`` to its tables."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

from microslip.quantity import Quantity, SceneError
from microslip.scenes.systems.elements import read_elements
from microslip.scenes.systems.tables import (
    Base,
    Matrices,
    Numbers,
    Order,
    System,
    Wave,
)
from microslip.table import meant, read_table, shown

TABLES = (
    "structure", "element", "drive", "preload", "probes", "base", "engine_order"
)  # fmt: skip
MATRICES = ("mass", "stiffness", "damping")
NUMBERS = tuple(each.name for each in fields(Numbers))
FORCE = Quantity("N", float("-inf"), float("inf"), positive=False)
MASS = Quantity("kg", 0.0, float("inf"), positive=True)


def read_system(source: str, document: dict[str, Any], known: list[str]) -> System:
    """Return the tables of a system; ``known`` are more names to suggest.

    Raises
    ------
    SceneError
        With source, table, key and remedy.
    """
    for key in document:
        if key not in TABLES:
            raise SceneError(
                f"{source}: {key}{shown(document[key])} is unknown"
                f"{meant(key, [*TABLES, *known])}"
            )
    structure = _table(source, document, "structure")
    sets = _sets(source, structure)
    laws, ends = read_elements(source, document.get("element", []), sets)
    if "drive" in document or not {"base", "engine_order"} & document.keys():
        drive = _drive(source, _table(source, document, "drive"))
    else:
        drive = {}
    return System(
        source,
        _matrices(source, structure),
        _structure_numbers(source, structure),
        _masses(source, structure),
        laws,
        ends,
        drive,
        _numbers(source, "preload", document.get("preload", {}), FORCE),
        document.get("probes"),
        _optional(source, document, "base", Base),
        _optional(source, document, "engine_order", Order),
        sets,
    )


def _structure_numbers(source: str, structure: dict[str, Any]) -> Numbers:
    given = {key: structure[key] for key in NUMBERS if key in structure}
    try:
        made: Numbers = read_table(source, "[structure] ", Numbers, given)
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None
    return made


def _optional(source: str, document: dict[str, Any], name: str, table: type) -> Any:  # noqa: ANN401  (an instance of ``table``)
    """Return a table that may be left out."""
    if name not in document:
        return None
    try:
        return read_table(source, f"[{name}] ", table, document[name])
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None


def _sets(source: str, values: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Return the nodes of each set."""
    given = values.get("sets", {})
    if not isinstance(given, dict):
        raise SceneError(f"{source}: [structure.sets] must be a table, not {given!r}")
    for name, nodes in given.items():
        if not _texts(nodes) or not nodes:
            raise SceneError(
                f"{source}: [structure.sets] {name}{shown(nodes)}: give a list of "
                'nodes as texts, such as ["12", "13"]'
            )
    return {name: tuple(nodes) for name, nodes in given.items()}


def _table(source: str, document: dict[str, Any], name: str) -> dict[str, Any]:
    """Return a table that must be there."""
    if name not in document:
        raise SceneError(f"{source}: table [{name}] is missing: add it")
    if not isinstance(document[name], dict):
        raise SceneError(f"{source}: [{name}] must be a table, not {document[name]!r}")
    return dict(document[name])


def _matrices(source: str, values: dict[str, Any]) -> Matrices:
    """Return the matrices as they stand there."""
    known = (*MATRICES, *NUMBERS, "names", "masses", "sets")
    for key in values:
        if key not in known:
            raise SceneError(
                f"{source}: [structure] {key}{shown(values[key])} is unknown"
                f"{meant(key, known)}"
            )
    both = [key for key in (*MATRICES, "names") if key in values and "beam" in values]
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
    names = values.get("names")
    if names is not None and not _texts(names):
        raise SceneError(
            f"{source}: [structure] names{shown(names)}: give a list of texts"
        )
    mass, stiffness, damping = (_rows(source, key, values.get(key)) for key in MATRICES)
    return Matrices(
        mass,
        stiffness,
        damping,
        None if names is None else tuple(names),
        Path(source).parent,
    )


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


def _masses(source: str, values: dict[str, Any]) -> dict[str, float]:
    """Return the point masses beside a beam."""
    _check_rotation(source, values)
    if "masses" in values and "beam" not in values:
        raise SceneError(
            f"{source}: [structure] masses belong to a beam: add a [structure.beam], "
            "or put them into the mass matrix"
        )
    return _numbers(source, "structure.masses", values.get("masses", {}), MASS)


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


def _drive(source: str, values: dict[str, Any]) -> dict[str, Wave]:
    """Return the harmonic forces."""
    return {
        name: read_table(
            source,
            f"[drive] {name}: ",
            Wave,
            value if isinstance(value, dict) else {"amplitude": value},
        )
        for name, value in values.items()
    }


def _numbers(
    source: str, table: str, values: object, kind: Quantity
) -> dict[str, float]:
    """Return a table of numbers of one kind."""
    if not isinstance(values, dict):
        raise SceneError(f"{source}: [{table}] must be a table, not {values!r}")
    found = {}
    for name, value in values.items():
        try:
            found[name] = kind.read(value)
        except ValueError as error:
            raise SceneError(
                f"{source}: [{table}] {name}{shown(value)}: {error}"
            ) from None
    return found


def _texts(values: object) -> bool:
    return isinstance(values, list) and all(isinstance(each, str) for each in values)
