"""From the TOML of a scene of kind ``system`` to its tables."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from microslip.quantity import Quantity, SceneError
from microslip.scenes.systems.rig import Matrices, Numbers, System, Wave
from microslip.table import meant, read_table, shown
from microslip_mechanics.element import KEYS
from microslip_mechanics.laws.catalogue import LAWS

TABLES = ("structure", "element", "drive", "preload", "probes")
MATRICES = ("mass", "stiffness", "damping")
NUMBERS = ("beam", "damping_ratio", "mass_damping", "stiffness_damping")
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
    elements = document.get("element", [])
    if not isinstance(elements, list):
        raise SceneError(
            f"{source}: [element] is one table: write [[element]], once for each"
        )
    laws: dict[str, Any] = {}
    ends: dict[str, dict[str, Any]] = {}
    for number, values in enumerate(elements, start=1):
        name, law, given = _element(source, number, values)
        if name in laws:
            raise SceneError(
                f"{source}: two elements are named {name}: give each its own name"
            )
        laws[name], ends[name] = law, given
    structure = _table(source, document, "structure")
    return System(
        source,
        _matrices(source, structure),
        read_table(
            source,
            "[structure] ",
            Numbers,
            {key: structure[key] for key in NUMBERS if key in structure},
        ),
        _masses(source, structure),
        laws,
        ends,
        _drive(source, _table(source, document, "drive")),
        _numbers(source, "preload", document.get("preload", {}), FORCE),
        document.get("probes"),
    )


def _table(source: str, document: dict[str, Any], name: str) -> dict[str, Any]:
    """Return a table that must be there."""
    if name not in document:
        raise SceneError(f"{source}: table [{name}] is missing: add it")
    if not isinstance(document[name], dict):
        raise SceneError(f"{source}: [{name}] must be a table, not {document[name]!r}")
    return dict(document[name])


def _matrices(source: str, values: dict[str, Any]) -> Matrices:
    """Return the matrices as they stand there."""
    known = (*MATRICES, *NUMBERS, "names", "masses")
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


def _masses(source: str, values: dict[str, Any]) -> dict[str, float]:
    """Return the point masses beside a beam."""
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


def _element(
    source: str, number: int, values: object
) -> tuple[str, Any, dict[str, Any]]:
    """Return name, law and directions of an element."""
    if not isinstance(values, dict):
        raise SceneError(f"{source}: [[element]] must be a table, not {values!r}")
    left = dict(values)
    name = left.pop("name", f"element-{number}")
    law = left.pop("law", None)
    if not isinstance(name, str) or not name:
        raise SceneError(f"{source}: [[element]] name = {name!r}: give a text")
    if law not in LAWS:
        hint = meant(str(law), list(LAWS))
        raise SceneError(f"{source}: element {name}: law = {law!r} is unknown{hint}")
    given = {key: left.pop(key) for key in KEYS if key in left}
    for key in KEYS[2:]:
        if key in given and not isinstance(given[key], list):
            raise SceneError(
                f"{source}: element {name}: {key} = {given[key]!r}: give a list of "
                'pairs, such as [["x1", "ground"]]'
            )
    try:
        made = read_table(source, f"element {name}: ", LAWS[law], left, KEYS)
    except ValueError as error:
        raise SceneError(f"{source}: element {name}: {error}") from None
    return name, made, given


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
