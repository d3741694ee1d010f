"""From the TOML of a scene of kind ``system`` to its tables."""

from __future__ import annotations

from typing import Any

from microslip.scenes.quantity import Quantity, SceneError
from microslip.scenes.systems.elements import read_elements
from microslip.scenes.systems.structure import (
    read_masses,
    read_matrices,
    read_sets,
    read_structure_numbers,
)
from microslip.scenes.systems.tables import Base, Order, System, Wave
from microslip.scenes.table import meant, read_numbers, read_table, shown, written

TABLES = (
    "structure", "element", "drive", "preload", "probes", "base", "engine_order"
)  # fmt: skip
FORCE = Quantity("N", float("-inf"), float("inf"), positive=False)


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
    sets = read_sets(source, structure)
    laws, ends = read_elements(source, document.get("element", []), sets)
    if "drive" in document or not {"base", "engine_order"} & document.keys():
        drive = _drive(source, _table(source, document, "drive"))
    else:
        drive = {}
    return System(
        source,
        read_matrices(source, structure),
        read_structure_numbers(source, structure),
        read_masses(source, structure),
        laws,
        ends,
        drive,
        read_numbers(source, "preload", document.get("preload", {}), FORCE),
        document.get("probes"),
        _optional(source, document, "base", Base),
        _optional(source, document, "engine_order", Order),
        sets,
    )


def _optional(source: str, document: dict[str, Any], name: str, table: type) -> Any:  # noqa: ANN401  (an instance of ``table``)
    """Return a table that may be left out."""
    if name not in document:
        return None
    try:
        return read_table(source, f"[{name}] ", table, document[name])
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None


def _table(source: str, document: dict[str, Any], name: str) -> dict[str, Any]:
    """Return a table that must be there."""
    if name not in document:
        raise SceneError(f"{source}: table [{name}] is missing: add it")
    if not isinstance(document[name], dict):
        raise SceneError(
            f"{source}: [{name}] must be a table, not {written(document[name])}"
        )
    return dict(document[name])


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
