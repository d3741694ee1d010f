"""Scenes: TOML text to checked tables; every message names file, table and key."""

from __future__ import annotations

import dataclasses
import difflib
import tomllib
import types
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from microslip.force_file import Force, read_force
from microslip.quantity import Quantity, SceneError, quantity
from microslip.scenes.bladed_disk.tables import BladedDisk
from microslip.scenes.two_blades.tables import TwoBlades

KINDS = ("two-blades", "system", "bladed-disk")
"""what ``scene = "…"`` may name"""
SYSTEMS = ("duffing", "jenkins", "gap", "chain", "friction-beam", "tip-damper")
BUILT_IN = ("two-blades", "bladed-disk", *SYSTEMS)
"""names of built-in scenes"""
NESTED = (["element"], ["drive"], ["structure"])
"""tables of a system with tables in them"""


@dataclass(frozen=True, slots=True)
class Sweep:
    """Load history of the time march."""

    ramp: float = quantity("s", lowest=0.0)
    start: float = quantity("s", lowest=0.0)
    end: float = quantity("s", positive=True)
    duration: float = quantity("s", positive=True)
    lowest: float = quantity("Hz", positive=True)
    highest: float = quantity("Hz", positive=True)
    kind: typing.Literal["exponential", "linear", "stepped"] = quantity(
        default="exponential"
    )
    direction: typing.Literal["up", "down", "up-down"] = quantity(default="up")
    levels: tuple[float, ...] = quantity(positive=True, highest=1e6, default=(1.0,))
    steps: int | None = quantity(lowest=2, highest=10**5, optional=True)
    periods: int | None = quantity(lowest=1, highest=10**7, optional=True)
    force_file: str | None = quantity(optional=True)


@dataclass(frozen=True, slots=True)
class Curve:
    """Frequency response by harmonic balance."""

    lowest: float = quantity("Hz", positive=True)
    highest: float = quantity("Hz", positive=True)
    tolerance: float = quantity(lowest=1e-6, highest=0.5)
    harmonics: int | None = quantity(lowest=1, highest=255, optional=True)
    samples: int | None = quantity(lowest=6, highest=2**16, optional=True)


@dataclass(frozen=True, slots=True)
class March:
    """Time integration."""

    time_step: float = quantity("s", positive=True, highest=1.0)
    store_every: int = quantity(lowest=1, highest=10**6)


@dataclass(frozen=True, slots=True)
class Scene:
    """A rig, and what is done with it."""

    rig: typing.Any
    """tables of its kind: TwoBlades, BladedDisk or System"""
    sweep: Sweep
    curve: Curve
    march: March
    text: str
    """the TOML that made it, overrides included"""
    force: Force | None = None
    """that the sweep's ``force_file`` holds"""


def built_in_text(name: str) -> str:
    """Return the TOML of a built-in scene."""
    kind = "systems" if name in SYSTEMS else name.replace("-", "_")
    folder = resources.files("microslip.scenes") / kind
    return (folder / f"{name}.toml").read_text(encoding="utf-8")


def load_scene(source: str, overrides: typing.Sequence[str] = ()) -> Scene:
    """Read a built-in scene by name, or a scene file.

    Parameters
    ----------
    source
        Name of a built-in scene, or path of a TOML file.
    overrides
        Texts ``table.key=value`` that replace values; ``value`` is TOML, or a text.

    Raises
    ------
    SceneError
        With file, table, key, value and remedy.
    """
    path = Path(source)
    if source in BUILT_IN and not path.is_file():
        text = built_in_text(source)
    else:
        text = _read(path)
    try:
        document = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise SceneError(f"{source}: not valid TOML: {error}") from None
    for override in overrides:
        _apply(document, override)
        text += f"\n# --set {override}"
    scene = _scene(source, document, text)
    return scene if scene.sweep.force_file is None else _with_force(path, scene)


def _with_force(path: Path, scene: Scene) -> Scene:
    """Return a scene with the force of its file, sought beside the scene file."""
    folder = path.parent if path.is_file() else Path()
    force = read_force(folder / str(scene.sweep.force_file))
    text = f"{scene.text}\n# force file {force.digest}"
    return dataclasses.replace(scene, force=force, text=text)


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (FileNotFoundError, NotADirectoryError):
        raise SceneError(
            f"there is no scene file {path}, and no built-in scene of that name: "
            f"give a path, or one of {', '.join(BUILT_IN)}"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        raise SceneError(f"{path} cannot be read: {reason}") from None


def _apply(document: dict[str, typing.Any], override: str) -> None:
    """Put one ``table.key=value`` into the document."""
    name, equals, text = override.partition("=")
    *tables, key = name.strip().split(".")
    deepest = 2 if tables[:1] in NESTED else 1
    if not equals or not key or len(tables) > deepest or not all(tables):
        raise SceneError(
            f"--set {override}: give table.key=value, such as contact.sigma=3e-7"
        )
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        parsed = {}
    value = parsed["value"] if len(parsed) == 1 else text.strip()
    place = document
    for table in tables:
        place = _inner(place, table, override)
        if not isinstance(place, dict):
            raise SceneError(f"--set {override}: {table} is a value, not a table")
    place[key] = value


def _inner(place: dict[str, typing.Any], table: str, override: str) -> typing.Any:  # noqa: ANN401
    """Return the table of a name within another, or the element of that name."""
    elements = place.get("element")
    if table != "element" or not isinstance(elements, list):
        return place.setdefault(table, {})
    named = {each.get("name"): each for each in elements if isinstance(each, dict)}
    name = override.split(".")[1]
    if name not in named:
        raise SceneError(
            f"--set {override}: there is no element {name}"
            f"{meant(name, [str(each) for each in named])}"
        )
    return named


def _scene(source: str, document: dict[str, typing.Any], text: str) -> Scene:
    kind = document.pop("scene", None)
    if kind not in KINDS:
        raise SceneError(
            f"{source}: scene = {kind!r}: name the kind of scene at the top, "
            f"one of {', '.join(KINDS)}"
        )
    experiments = {"sweep": Sweep, "curve": Curve, "march": March}
    made = {}
    for name, table in experiments.items():
        if name not in document:
            raise SceneError(f"{source}: table [{name}] is missing: add it")
        made[name] = read_table(source, f"[{name}] ", table, document.pop(name))
    known = [*experiments, "scene"]
    scene = Scene(_rig(source, str(kind), document, known), **made, text=text)
    _check(source, scene)
    return scene


def _rig(
    source: str, kind: str, document: dict[str, typing.Any], known: list[str]
) -> object:
    """Return the tables of a kind of scene."""
    if kind == "system":
        # what it needs knows numbers, which the list of scenes must not wait for
        from microslip.scenes.systems.read import read_system

        return read_system(source, document, known)
    table = BladedDisk if kind == "bladed-disk" else TwoBlades
    try:
        return read_table(source, "", table, document, known)
    except ValueError as error:
        raise SceneError(f"{source}: {error}") from None


def read_table(
    source: str,
    place: str,
    table: type,
    values: object,
    known: typing.Sequence[str] = (),
) -> typing.Any:  # noqa: ANN401  (an instance of ``table``)
    """Make a dataclass from a TOML table; ``known`` are more names to suggest."""
    if not isinstance(values, dict):
        raise SceneError(f"{source}: {place}must be a table, not {values!r}")
    hints = typing.get_type_hints(table)
    fields = {field.name: field for field in dataclasses.fields(table)}
    for key in values:
        if key not in fields:
            raise SceneError(
                f"{source}: {place}{key}{shown(values[key])} is unknown"
                f"{meant(key, [*fields, *known])}"
            )
    made = {}
    for name, field in fields.items():
        if name in values:
            made[name] = _value(source, place, field, hints[name], values[name])
        elif field.default is dataclasses.MISSING:
            what = (
                f"{place}{name}" if "quantity" in field.metadata else f"table [{name}]"
            )
            raise SceneError(f"{source}: {what} is missing: add it")
    return table(**made)


def _value(
    source: str,
    place: str,
    field: dataclasses.Field[typing.Any],
    hint: typing.Any,  # noqa: ANN401  (a type annotation)
    value: object,
) -> object:
    """Read one key as its annotation says."""
    if _optional(hint):
        hint = typing.get_args(hint)[0]
    if dataclasses.is_dataclass(hint):
        return read_table(source, f"[{field.name}] ", typing.cast("type", hint), value)
    try:
        return _scalar(field.metadata["quantity"], hint, value)
    except ValueError as error:
        name = f"{place}{field.name}{shown(value)}"
        raise SceneError(f"{source}: {name}: {error}") from None


def _scalar(
    kind: Quantity,
    hint: typing.Any,  # noqa: ANN401  (a type annotation)
    value: object,
) -> object:
    """Return a choice, a list, a text or a number."""
    if typing.get_origin(hint) is typing.Literal:
        choices = typing.get_args(hint)
        if value not in choices:
            raise ValueError(f"is unknown: give one of {', '.join(choices)}")
        return value
    if typing.get_origin(hint) is Mapping:
        return _by_power(kind, value)
    if typing.get_origin(hint) is tuple:
        return _several(kind, value)
    if hint is str:
        if not isinstance(value, str) or not value:
            raise ValueError("is not a text: give one in quotes")
        return value
    return _number(kind, hint, value)


def _number(kind: Quantity, hint: type, value: object) -> object:
    """Return a switch, a whole number or a quantity in SI units."""
    if hint is bool:
        if not isinstance(value, bool):
            raise ValueError("is not a switch: give true or false")
        return value
    number = kind.read(value)
    if hint is int:
        if number != int(number):
            raise ValueError("is not a whole number: give one")
        return int(number)
    return number


def _by_power(kind: Quantity, value: object) -> dict[float, float]:
    """Return numbers by the power to which they belong."""
    if not isinstance(value, dict):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            "is no table: give a number for each power, such as {1 = 10, 3 = 2e6}"
        )
    return {float(power): kind.read(each) for power, each in value.items()}


def _several(kind: Quantity, value: object) -> tuple[float, ...]:
    """Return one number or a list of them as a tuple."""
    several = value if isinstance(value, list) else [value]
    if not several:
        raise ValueError("is empty: give at least one number")
    return tuple(kind.read(each) for each in several)


def shown(value: object) -> str:
    """Return `` = value`` for a message; a table has too much to show."""
    if isinstance(value, dict):
        return ""
    text = f'"{value}"' if isinstance(value, str) else str(value)
    return f" = {text if len(text) <= 60 else text[:60] + '…'}"


def _optional(hint: typing.Any) -> bool:  # noqa: ANN401  (a type annotation)
    return isinstance(hint, types.UnionType) and types.NoneType in typing.get_args(hint)


def meant(key: str, names: typing.Sequence[str]) -> str:
    """Return what may have been meant, to end a message."""
    close = difflib.get_close_matches(key, names, n=1)
    if close:
        return f": do you mean {close[0]}?"
    return f": give one of {', '.join(names)}"


def _check(source: str, scene: Scene) -> None:
    """Check what more than one key decides."""
    sweep, curve = scene.sweep, scene.curve
    if not sweep.ramp <= sweep.start < sweep.end <= sweep.duration:
        raise SceneError(
            f"{source}: [sweep] ramp {sweep.ramp:g} s, start {sweep.start:g} s, end "
            f"{sweep.end:g} s, duration {sweep.duration:g} s: "
            "give ramp <= start < end <= duration"
        )
    for name, table in (("sweep", sweep), ("curve", curve)):
        if not table.lowest < table.highest:
            raise SceneError(
                f"{source}: [{name}] lowest = {table.lowest:g} Hz, highest = "
                f"{table.highest:g} Hz: give lowest < highest"
            )
    _check_kind(source, sweep)
    if curve.samples is not None and curve.harmonics is None:
        raise SceneError(
            f"{source}: [curve] samples = {curve.samples}: they follow from the "
            "tolerance unless harmonics are given: give both, or neither"
        )
    fewest = 4 * (curve.harmonics or 0) + 2
    if curve.samples is not None and curve.samples < fewest:
        raise SceneError(
            f"{source}: [curve] samples = {curve.samples}: too few for "
            f"{curve.harmonics} harmonics: give at least {fewest}"
        )


def _check_kind(source: str, sweep: Sweep) -> None:
    """Check that a sweep has the keys of its kind, and those alone."""
    steps = {"steps": sweep.steps, "periods": sweep.periods}
    for name, value in steps.items():
        if sweep.kind == "stepped" and value is None:
            raise SceneError(
                f'{source}: [sweep] {name} is missing: kind = "stepped" needs it'
            )
        if sweep.kind != "stepped" and value is not None:
            raise SceneError(
                f"{source}: [sweep] {name} = {value}: only for "
                'kind = "stepped": leave it out'
            )
    plain = (sweep.kind, sweep.direction, sweep.levels) == ("exponential", "up", (1.0,))
    if sweep.force_file is not None and not plain:
        raise SceneError(
            f'{source}: [sweep] force_file = "{sweep.force_file}": the force takes the '
            "place of the sine: leave kind, direction and levels out"
        )
