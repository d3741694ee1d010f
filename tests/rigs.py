"""The two-blade rig of the built-in scene, with some of its values overridden."""

import dataclasses
import tomllib
from importlib import resources
from typing import Any

from microslip.scenes.two_blades import tables
from microslip.scenes.two_blades.build import problem
from microslip_mechanics.problem import Problem

SCENE = resources.files("microslip.scenes.two_blades") / "two-blades.toml"
TABLES = {
    "blade": tables.Blade,
    "blade_end": tables.BladeEnd,
    "friction_element": tables.FrictionElement,
    "rope": tables.Rope,
    "contact": tables.Contact,
    "friction": tables.Friction,
    "preload": tables.Preload,
    "excitation": tables.Excitation,
}


def rig(**overrides: object) -> tables.TwoBlades:
    """Return the rig; ``blade__fan="0 deg"`` sets a value, ``rope=None`` a table."""
    scene = tomllib.loads(SCENE.read_text(encoding="utf-8"))
    for name, value in overrides.items():
        table, _, key = name.partition("__")
        place, last = (scene[table], key) if key else (scene, table)
        if last not in place:
            raise KeyError(name)
        place[last] = value
    made = {
        name: _made(kind, scene[name])
        for name, kind in TABLES.items()
        if scene[name] is not None
    }
    return tables.TwoBlades(model=scene["model"], **made)


def rig_problem(**overrides: object) -> Problem:
    """Return the problem of :func:`rig`."""
    return problem(rig(**overrides))


def _made(kind: Any, table: dict[str, Any]) -> Any:
    values = {}
    for field in dataclasses.fields(kind):
        value = table[field.name]
        if field.type in ("float", "int"):
            value = field.metadata["quantity"].read(value)
        values[field.name] = int(value) if field.type == "int" else value
    return kind(**values)
