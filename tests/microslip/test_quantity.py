"""Numbers of a scene: units, formats, ranges."""

import math
from pathlib import Path

import pytest

from microslip.scenes.quantity import UNITS, Quantity, SceneError
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.quantity import apart

LENGTH = Quantity("m", 0.0, 10.0, positive=True)
RATIO = Quantity("", 0.0, 0.5, positive=False)


@pytest.mark.parametrize(
    ("unit", "text", "value"),
    [
        ("m", "207.5 mm", 0.2075),
        ("m", "0.2075 m", 0.2075),
        ("m", "207.5mm", 0.2075),
        ("s", "2.5e1us", 25e-6),
        ("m", "-.5mm", -0.5e-3),
        ("m", "3 um", 3e-6),
        ("m", "3 µm", 3e-6),
        ("kg", "76 g", 0.076),
        ("s", "25 us", 25e-6),
        ("s", "2 ms", 2e-3),
        ("Hz", "0.135 kHz", 135.0),
        ("N", "250 mN", 0.25),
        ("N/m", "10 N/mm", 1e4),
        ("N/m", "2 MN/m", 2e6),
        ("Pa", "210 GPa", 2.1e11),
        ("kg/m^3", "7.8 g/cm^3", 7800.0),
        ("kg m^2", "82.152 g mm^2", 8.2152e-8),
        ("rad", "180 deg", math.pi),
        ("m/s", "1 mm/s", 1e-3),
    ],
)
def test_text_with_a_unit_is_read_in_si(unit: str, text: str, value: float) -> None:
    kind = Quantity(unit, -math.inf, math.inf, positive=False)

    read = kind.read(text)

    assert read == pytest.approx(value, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("unit", UNITS)
def test_si_unit_itself_changes_nothing(unit: str) -> None:
    kind = Quantity(unit, -math.inf, math.inf, positive=False)

    read = kind.read(f"0.7 {unit}")

    assert read == kind.read(0.7) == 0.7


@pytest.mark.parametrize(
    ("written", "value"),
    [
        (2, 2.0),
        (2.5, 2.5),
        ("+25e-1 m", 2.5),
        ("  2.5   m ", 2.5),
        ("2.5E0 m", 2.5),
    ],
)
def test_number_may_be_written_in_any_usual_form(written: object, value: float) -> None:
    read = LENGTH.read(written)

    assert isinstance(read, float)
    assert read == value


def test_text_needs_a_unit_only_where_there_is_one() -> None:
    assert RATIO.read("0.3") == 0.3
    with pytest.raises(ValueError, match="wrong unit"):
        LENGTH.read("0.2075")


@pytest.mark.parametrize(
    ("kind", "written", "words"),
    [
        (LENGTH, "207.5 Hz", "wrong unit"),
        (LENGTH, "207.5 MM", "wrong unit"),
        (LENGTH, "207.5 mm long", "wrong unit"),
        (RATIO, "0.3 m", "without a unit"),
        (RATIO, "0.3 %", "without a unit"),
        (LENGTH, "long", "not a number"),
        (LENGTH, "mm 207.5", "not a number"),
        (LENGTH, "", "not a number"),
        (LENGTH, "2,5 m", "not a number"),
        (LENGTH, True, "not a number"),
        (LENGTH, None, "not a number"),
        (LENGTH, [1.0], "not a number"),
        (LENGTH, {"value": 1.0}, "not a number"),
        (LENGTH, math.nan, "not finite"),
        (LENGTH, math.inf, "not finite"),
        (LENGTH, "nan m", "not finite"),
        (LENGTH, "1e400 mm", "not finite"),
        (LENGTH, 0.0, "above 0 and at most 10 m"),
        (LENGTH, "-1 mm", "above 0 and at most 10 m"),
        (LENGTH, "10001 mm", "above 0 and at most 10 m"),
        (RATIO, -1e-9, "at least 0 and at most 0.5"),
        (RATIO, 0.7, "at least 0 and at most 0.5"),
        (Quantity("kg", 0.0, math.inf, positive=True), 0.0, "must be above 0 kg"),
        (Quantity("N", 0.0, math.inf, positive=False), -1, "must be at least 0 N"),
    ],
)
def test_message_says_what_a_value_should_be(
    kind: Quantity, written: object, words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        kind.read(written)


def test_message_lists_the_units_that_fit() -> None:
    with pytest.raises(ValueError, match='"m", "mm", "um"'):
        LENGTH.read("3 inches")


def test_bounds_themselves_are_inside_unless_the_value_must_be_positive() -> None:
    assert RATIO.read(0.0) == 0.0
    assert RATIO.read(0.5) == 0.5
    assert LENGTH.read("10 m") == 10.0


def test_whole_number_beyond_all_floats_is_out_of_range() -> None:
    with pytest.raises(ValueError, match=r"range|finite"):
        LENGTH.read(10**400)


@pytest.mark.parametrize("value", [1e-300, -1e-60, "1e-60 m", 5e-324])
def test_number_whose_square_vanishes_is_refused(value: float | str) -> None:
    kind = Quantity("m", -math.inf, math.inf, positive=False)

    with pytest.raises(
        ValueError, match=r"^is out of range: give 0 or at least 1e-50 "
    ):
        kind.read(value)
    assert kind.read(0.0) == 0.0
    assert kind.read(1e-50) == 1e-50
    with pytest.raises(ValueError, match=r"^is out of range: give at least 1e-50 "):
        LENGTH.read(1e-60)


@pytest.mark.parametrize(
    ("law", "numbers", "stiffness"),
    [
        ("unilateral-spring", 'stiffness = "5 kN/m"', 5e3),
        ("unilateral-spring", 'stiffness = "2 N/mm"\nexponent = 1', 2e3),
        ("unilateral-spring", 'stiffness = "7 N/m^p"\nexponent = 1.5', 7.0),
        ("polynomial-spring", 'coefficients = {1 = "3 kN/m", 3 = 2e6}', 3e3),
        ("unilateral-spring", 'stiffness = "5 kN/m"\nexponent = 1.5', None),
        ("hunt-crossley", 'stiffness = "5 kN/m"', None),
        ("polynomial-spring", 'coefficients = {3 = "3 kN/m"}', None),
    ],
)
def test_a_stiffness_has_the_unit_that_its_power_gives_it(
    law: str, numbers: str, stiffness: float | None, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        'scene = "system"\n[structure]\nnames = ["x"]\nmass = [1]\nstiffness = [9]\n'
        f'[[element]]\nname = "e"\nlaw = "{law}"\nbetween = ["x", "ground"]\n'
        f"{numbers}\n[drive]\nx = 1\n"
        "[curve]\nlowest = 1\nhighest = 2\n",
    )

    if stiffness is None:
        with pytest.raises(SceneError, match=r"wrong unit: give a number in N/m\^p"):
            load_scene(str(path))
        return
    made = load_scene(str(path)).rig.element["e"]
    found = made.coefficients[1.0] if law == "polynomial-spring" else made.stiffness
    assert found == stiffness


@pytest.mark.parametrize(
    ("ends", "texts"),
    [
        ((125.0, 145.0), ("125", "145")),
        ((4.0, 4.00000012), ("4", "4.0000001")),
        ((4.0, 4.0), ("4", "4")),
    ],
)
def test_two_numbers_have_digits_that_tell_them_apart(
    ends: tuple[float, float], texts: tuple[str, str]
) -> None:
    assert apart(*ends) == texts
