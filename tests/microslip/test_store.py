"""Result files: they come back bit for bit, explain themselves, and fail in words."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import netcdf_file

from microslip.files.result_file import load
from microslip.files.schema import SCHEMAS, Result
from microslip.files.store import Stored, StoreError, save
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.thinning import thinned
from microslip_mechanics.results.time_history import TimeHistory

SCENE = '# a scene\nscene = "two-blades"\n# --set model=A'
DOCS = Path(__file__).parents[2] / "docs"
COMMAND = "microslip frc two-blades --set model=A"


@pytest.fixture
def saved(result: Result, tmp_path: Path) -> Path:
    """Return the file of a result."""
    path = tmp_path / "result.nc"
    save(path, Stored(result, SCENE, COMMAND))
    return path


def attribute(place: object, name: str) -> str:
    """Return the text of an attribute of a file or a variable."""
    text: bytes = getattr(place, name)
    return text.decode()


def check_same(result: object, stored: object) -> None:
    """Check that each field came back bit for bit, with its type and shape."""
    assert type(stored) is type(result)
    for field in dataclasses.fields(result):  # type: ignore[arg-type]
        before, after = (getattr(each, field.name) for each in (result, stored))
        assert type(after) is type(before), field.name
        if isinstance(before, np.ndarray):
            assert after.dtype == before.dtype, field.name
            assert after.dtype.isnative, field.name
            assert after.shape == before.shape, field.name
            assert after.tobytes() == before.tobytes(), field.name
        elif dataclasses.is_dataclass(before):
            check_same(before, after)
        else:
            assert after == before, field.name


def test_result_comes_back_bit_for_bit(result: Result, saved: Path) -> None:
    stored = load(saved)

    assert (stored.scene, stored.command) == (SCENE, COMMAND)
    check_same(result, stored.result)


@pytest.mark.parametrize("missing", ["contacts", "probes"])
def test_result_without_contact_points_or_probes_comes_back(
    missing: str, result: Result, tmp_path: Path
) -> None:
    schema = next(schema for kind, schema in SCHEMAS.values() if type(result) is kind)
    dimension = schema[missing][0][0]
    none = {
        name: getattr(result, name)[..., :0]
        for name, (dimensions, *_) in schema.items()
        if dimension in dimensions[1:]
    }
    without = dataclasses.replace(result, **none, **{missing: ()})  # type: ignore[arg-type]

    save(tmp_path / "result.nc", Stored(without, SCENE, COMMAND))

    assert none
    check_same(without, load(tmp_path / "result.nc").result)


@pytest.mark.parametrize("longest", ["x" * 33, "ä" * 40, "y"], ids=len)
def test_names_come_back_whole_however_long(
    longest: str, result: Result, tmp_path: Path
) -> None:
    contacts = ("", longest, "B2")
    named = dataclasses.replace(result, contacts=contacts)

    save(tmp_path / "result.nc", Stored(named, SCENE, COMMAND))

    assert load(tmp_path / "result.nc").result.contacts == contacts


def test_file_without_a_variable_is_no_result(
    result: Result, saved: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = next(kind for kind, (type_, _) in SCHEMAS.items() if type(result) is type_)
    schema = dict(SCHEMAS[kind][1])
    missing = {"velocity", "peak", "highest"} & set(schema)
    del schema[missing.pop()]
    monkeypatch.setitem(SCHEMAS, kind, (type(result), schema))
    save(saved, Stored(result, SCENE, COMMAND))
    monkeypatch.undo()

    with pytest.raises(StoreError, match="is not a result file, it has no "):
        load(saved)


@pytest.mark.parametrize("name", ["frequency", "parameter", "amplitude"])
def test_a_curve_of_no_numbers_is_no_result(
    name: str, small_curve: ResponseCurve, tmp_path: Path
) -> None:
    path = tmp_path / "lost.nc"
    lost = np.full_like(getattr(small_curve, name), np.nan)
    curve = dataclasses.replace(small_curve, **{name: lost})
    save(path, Stored(curve, SCENE, COMMAND))

    with pytest.raises(StoreError, match="is not a result file"):
        load(path)


def test_curve_of_an_earlier_version_has_no_errors_of_its_parameter(
    small_curve: ResponseCurve, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind, schema = SCHEMAS["frequency response curve"]
    earlier = {name: row for name, row in schema.items() if name != "parameter_error"}
    with monkeypatch.context() as patch:
        patch.setitem(SCHEMAS, "frequency response curve", (kind, earlier))
        save(tmp_path / "result.nc", Stored(small_curve, SCENE, COMMAND))

    unknown = np.full(len(small_curve.frequency), np.nan)
    expected = dataclasses.replace(small_curve, parameter_error=unknown)
    check_same(expected, load(tmp_path / "result.nc").result)


def test_amplitudes_that_are_unique_are_stored_once(
    small_curve: ResponseCurve, tmp_path: Path
) -> None:
    amplitude = small_curve.amplitude
    unique = dataclasses.replace(
        small_curve, amplitude_lowest=amplitude, amplitude_highest=amplitude
    )

    save(tmp_path / "result.nc", Stored(unique, SCENE, COMMAND))

    check_same(unique, load(tmp_path / "result.nc").result)
    with netcdf_file(tmp_path / "result.nc", "r", mmap=False) as file:
        assert not {"amplitude_lowest", "amplitude_highest"} & set(file.variables)


def test_an_interruption_leaves_the_curve_that_was_there(
    small_curve: ResponseCurve, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.nc"
    save(path, Stored(small_curve, SCENE, COMMAND))
    before = path.read_bytes()
    other = dataclasses.replace(small_curve, frequency=2.0 * small_curve.frequency)

    def interrupted(_: netcdf_file) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(netcdf_file, "flush", interrupted)

    with pytest.raises(KeyboardInterrupt):
        save(path, Stored(other, SCENE, COMMAND))
    assert path.read_bytes() == before


def test_every_field_is_a_variable_or_an_attribute(result: Result, saved: Path) -> None:
    names = {field.name for field in dataclasses.fields(result)}

    with netcdf_file(saved, "r", mmap=False) as file:
        assert all(name in file.variables or hasattr(file, name) for name in names)


@pytest.mark.parametrize("value", [0.0, -0.0, 5e-324, 1e308, np.inf, -np.inf, np.nan])
def test_no_number_is_too_special_for_a_file(
    value: float, small_history: TimeHistory, tmp_path: Path
) -> None:
    power = np.array([value, *small_history.friction_power[1:]])
    result = dataclasses.replace(small_history, friction_power=power)

    save(tmp_path / "result.nc", Stored(result, SCENE, COMMAND))

    stored = load(tmp_path / "result.nc").result
    assert isinstance(stored, TimeHistory)
    assert stored.friction_power.tobytes() == power.tobytes()


def test_curve_of_one_point_comes_back(
    small_curve: ResponseCurve, tmp_path: Path
) -> None:
    first = {
        field.name: getattr(small_curve, field.name)[:1]
        for field in dataclasses.fields(small_curve)
        if field.name not in ("probes", "contacts", "ending")
    }
    one = dataclasses.replace(small_curve, **first, ending="interrupted")

    save(tmp_path / "result.nc", Stored(one, SCENE, COMMAND))

    stored = load(tmp_path / "result.nc").result
    assert isinstance(stored, ResponseCurve)
    np.testing.assert_array_equal(stored.amplitude, one.amplitude)
    assert (stored.outcome, stored.ending) == (("converged",), "interrupted")


@pytest.mark.parametrize(
    "ending",
    [
        "complete",
        "interrupted",
        "the curve does not go on at parameter 823.1: " + "no step helps, " * 50,
        "ein Körper driftet: µ = 0,3",
    ],
)
def test_ending_comes_back_whatever_it_says(
    ending: str, small_history: TimeHistory, tmp_path: Path
) -> None:
    result = dataclasses.replace(small_history, ending=ending)

    save(tmp_path / "result.nc", Stored(result, SCENE, COMMAND))

    assert load(tmp_path / "result.nc").result.ending == ending


@pytest.mark.parametrize("text", ['length = "207500 µm"', "# Über die Schaufeln – β"])
def test_scene_and_command_may_hold_any_letters(
    text: str, small_curve: ResponseCurve, tmp_path: Path
) -> None:
    command = f"microslip frc Schaufel-für-Übung.toml --set '{text}'"

    save(tmp_path / "result.nc", Stored(small_curve, text, command))

    stored = load(tmp_path / "result.nc")
    assert (stored.scene, stored.command) == (text, command)


def test_attributes_tell_where_a_file_is_from(result: Result, saved: Path) -> None:
    kind = {
        "ResponseCurve": "frequency response curve",
        "TimeHistory": "time history",
        "Envelope": "envelope",
    }

    with netcdf_file(saved, "r", mmap=False) as file:
        assert attribute(file, "kind") == kind[type(result).__name__]
        assert attribute(file, "source").startswith("microslip 0.")
        assert attribute(file, "command") == COMMAND
        assert attribute(file, "scene") == SCENE
        assert attribute(file, "ending") == result.ending


def test_variables_have_named_dimensions_units_and_a_meaning(
    result: Result, saved: Path
) -> None:
    (schema,) = (schema for kind, schema in SCHEMAS.values() if type(result) is kind)

    with netcdf_file(saved, "r", mmap=False) as file:
        assert file.version_byte == 2
        assert set(file.variables) == set(schema)
        for name, (dimensions, unit, meaning) in schema.items():
            variable = file.variables[name]
            assert variable.dimensions == dimensions
            along = isinstance(result, ResponseCurve) and name.startswith("parameter")
            assert attribute(variable, "units") == ("rad/s" if along else unit)
            assert attribute(variable, "long_name") == meaning
            assert unit or variable.data.dtype.kind == "S"


def test_dimensions_have_the_sizes_of_the_result(
    small_curve: ResponseCurve, tmp_path: Path
) -> None:
    save(tmp_path / "result.nc", Stored(small_curve, SCENE, COMMAND))

    with netcdf_file(tmp_path / "result.nc", "r", mmap=False) as file:
        assert file.dimensions["point"] == len(small_curve.frequency)
        assert file.dimensions["probe"] == len(small_curve.probes)
        assert file.dimensions["contact"] == len(small_curve.contacts)


def test_truncated_file_is_told_in_words_wherever_it_is_cut(
    saved: Path, tmp_path: Path
) -> None:
    whole, cut = saved.read_bytes(), tmp_path / "cut.nc"

    for length in range(0, len(whole) - 8, 61):
        cut.write_bytes(whole[:length])
        with pytest.raises(StoreError, match=r"cut\.nc"):
            load(cut)


@pytest.mark.parametrize("missing", ["nowhere/result.nc", "file/result.nc", "folder"])
def test_result_that_cannot_be_written_is_told_in_words(
    missing: str, result: Result, tmp_path: Path
) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")

    with pytest.raises(StoreError, match=f"{missing} cannot be written: "):
        save(tmp_path / missing, Stored(result, SCENE, COMMAND))


def test_a_long_history_is_read_thinned(
    small_history: TimeHistory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("microslip.files.result_file.CHUNK", 100)
    rows = 1000
    many: dict[str, Any] = {
        field.name: np.resize(values, (rows, *values.shape[1:]))
        for field in dataclasses.fields(small_history)
        if isinstance(values := getattr(small_history, field.name), np.ndarray)
    }
    result = dataclasses.replace(small_history, **many)
    save(tmp_path / "result.nc", Stored(result, SCENE, COMMAND))

    few = load(tmp_path / "result.nc", most=50).result

    check_same(few, thinned(result, 40))


def test_a_file_that_another_program_wrote_anew_is_told(
    small_history: TimeHistory, tmp_path: Path
) -> None:
    path, copy = tmp_path / "result.nc", tmp_path / "copy.nc"
    save(path, Stored(small_history, SCENE, COMMAND))
    with netcdf_file(path, "r", mmap=False) as old, netcdf_file(copy, "w") as new:
        for name in ("kind", "source", "command", "scene", "ending"):
            setattr(new, name, getattr(old, name))
        new.createDimension("time", None)
        new.createVariable("time", "d", ("time",))[:] = old.variables["time"].data

    with pytest.raises(StoreError, match="is not a result file"):
        load(copy)


@pytest.mark.parametrize("kind", SCHEMAS)
def test_units_are_those_that_the_docs_name(kind: str) -> None:
    number = list(SCHEMAS).index(kind)
    tables = (DOCS / "files.md").read_text().split("| variable |")[1:]
    told: dict[str, str] = {}
    for line in tables[number].splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 4 and cells[0].startswith("`"):
            names = [name.strip("` ") for name in cells[0].split(",")]
            units = [unit.strip() for unit in cells[2].split(",")] * len(names)
            told |= dict(zip(names, units, strict=False))

    _, schema = SCHEMAS[kind]
    named_in_words = {"probes", "contacts", "energies", "checkpoint"}
    assert schema.keys() - told.keys() <= named_in_words
    for name in schema.keys() & told.keys():
        _, unit, _ = schema[name]
        assert told[name] in {unit, "SI"}, name
