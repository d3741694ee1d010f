"""The functions of plain Python, and what they say of arguments of no use."""

import dataclasses
import importlib.metadata
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import microslip
from figure_checks import check_labels
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory


@pytest.fixture(scope="module")
def duffing() -> Any:
    return microslip.scene("duffing")


SWEPT: dict[str, Any] = {"duration": 1.0, "time_step": 1e-3}


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"lowest": -4.0}, "lowest = -4.0: is out of range: it must be at least 1e-12"),
        ({"lowest": "4 kg"}, r'lowest = "4 kg": '),
        ({"highest": float("nan")}, "highest = nan: is not finite"),
        ({"highest": 4.0}, "lowest and highest are both 4 Hz: give two"),
        ({"highest": 4.0 + 1e-15}, "lowest and highest are both 4 Hz: give two"),
        ({"tolerance": 10.0}, "tolerance = 10.0: is out of range"),
        ({"tolerance": 1e-300}, "tolerance = 1e-300: is out of range"),
        ({"harmonics": 2.5}, "harmonics = 2.5: is not a whole number"),
        ({"harmonics": 1000}, "harmonics = 1000: is out of range"),
        ({"samples": 64}, "samples = 64: they follow from the tolerance"),
        ({"harmonics": 7, "samples": 8}, "samples = 8: too few for 7 harmonics"),
        ({"harmonics": 7, "tolerance": 1e-5}, "tolerance = 1e-05: harmonics are fixed"),
        ({"problem": "duffing"}, "problem = 'duffing': give what microslip.system"),
    ],
)
def test_arguments_of_a_curve_that_are_of_no_use_are_named(
    duffing: Any, given: dict[str, Any], text: str
) -> None:
    arguments = {"problem": duffing, "lowest": 4.0, "highest": 7.0} | given

    with pytest.raises(microslip.MicroslipError, match=f"^microslip.curve: {text}"):
        microslip.curve(**arguments)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"time_step": 0.0}, "time_step = 0.0: is out of range"),
        ({"store_every": 1.5}, "store_every = 1.5: is not a whole number"),
        ({"duration": -1.0}, "duration = -1.0: is out of range"),
        ({"highest": 4.0}, "lowest and highest are both 4 Hz"),
        ({"problem": None}, "problem = None: give what microslip.system"),
    ],
)
def test_arguments_of_a_sweep_that_are_of_no_use_are_named(
    duffing: Any, given: dict[str, Any], text: str
) -> None:
    arguments = {"problem": duffing, "lowest": 4.0, "highest": 7.0} | SWEPT | given

    with pytest.raises(microslip.MicroslipError, match=f"^microslip.sweep: {text}"):
        microslip.sweep(**arguments)


def test_quantities_may_be_texts_with_units_or_numbers_of_numpy(duffing: Any) -> None:
    plain = microslip.curve(duffing, 4.0, 4.5, harmonics=3)

    units = microslip.curve(duffing, "4 Hz", "0.0045 kHz", harmonics=3)
    few: Any = np.int64(3)
    numbers = microslip.curve(duffing, np.float64(4.0), np.float64(4.5), harmonics=few)

    for other in (units, numbers):
        np.testing.assert_array_equal(other.amplitude, plain.amplitude)


def test_one_override_needs_no_list() -> None:
    single = microslip.scene("duffing", "drive.x=3")

    assert single.drive == microslip.scene("duffing", ["drive.x=3"]).drive


def test_results_come_back_from_files_and_are_drawn(
    duffing: Any, tmp_path: Path
) -> None:
    curve = microslip.curve(duffing, 4.0, 4.5, harmonics=3)
    march = microslip.sweep(duffing, 4.0, 7.0, **SWEPT)

    both: list[Any] = [curve, march]
    for place, result in enumerate(both):
        microslip.save(result, tmp_path / f"{place}.nc")
        again = microslip.load(str(tmp_path / f"{place}.nc"))
        assert type(again) is type(result)
        assert again.probes == result.probes
        assert again.ending == "complete"
        check_labels(microslip.figure(again, "duffing"))
    amplitude = microslip.load(tmp_path / "0.nc").amplitude  # type: ignore[union-attr]
    np.testing.assert_array_equal(amplitude, curve.amplitude)


def test_files_that_are_no_results_are_named(tmp_path: Path) -> None:
    with pytest.raises(microslip.MicroslipError, match=r"no result file .*none\.nc"):
        microslip.load(tmp_path / "none.nc")


def test_the_package_tells_its_names_and_its_version() -> None:
    names = dir(microslip)

    assert {"curve", "scene", "sweep", "system", "MicroslipError"} <= set(names)
    assert microslip.__version__ == importlib.metadata.version("microslip")
    assert all(hasattr(microslip, name) for name in names)


def test_results_tell_what_they_are_in_a_line(
    small_curve: ResponseCurve, small_history: TimeHistory, small_envelope: Envelope
) -> None:
    lines = repr(small_curve), repr(small_history), repr(small_envelope)

    assert all(len(line) < 300 and "\n" not in line for line in lines)
    assert lines[0].startswith(f"<ResponseCurve: {small_curve.frequency.size} points, ")
    assert f" {small_history.time.size} times until " in lines[1]
    assert lines[2].startswith("<Envelope: 5 cycles until ")
    assert ", ".join(small_curve.probes) in lines[0]
    assert small_curve.ending in lines[0]
    assert small_history.ending in lines[1]


@pytest.mark.parametrize(
    ("hertz", "span"),
    [
        ([130.0, 131.0, 133.0, 134.0], "130 to 134 Hz"),
        ([134.0, 133.0, 131.0, 130.0], "134 to 130 Hz"),
        (
            [130.0, 133.0, 134.0, 130.0],
            "130 to 134 Hz",
        ),  # it turns back, or begins anew
    ],
)
def test_a_curve_tells_how_far_it_comes(
    small_curve: ResponseCurve, hertz: list[float], span: str
) -> None:
    curve = dataclasses.replace(small_curve, frequency=2.0 * np.pi * np.array(hertz))

    assert f"<ResponseCurve: 4 points, {span};" in repr(curve)


def test_a_body_that_only_a_dashpot_holds_is_told_as_an_error_of_microslip() -> None:
    free = microslip.system(
        mass=[1.0, 1.0],
        stiffness=[[100.0, -100.0], [-100.0, 100.0]],
        damping=[[1.0, 0.0], [0.0, 0.0]],
        drive={"x1": 0.5},
    )

    with pytest.raises(
        microslip.MicroslipError, match=r"^microslip.curve: the structure can move"
    ):
        microslip.curve(free, 1.0, 7.0)


def test_problems_tell_what_they_are_in_a_line(duffing: Any) -> None:
    assert repr(duffing) == "<Problem: 1 degree of freedom; contacts cubic; probes x>"


def test_a_curve_takes_no_number_from_numpy_s_global_generator() -> None:
    before = np.random.get_state(legacy=False)  # noqa: NPY002

    curve = microslip.curve(microslip.scene("jenkins"), 18.0, 19.0)

    assert "peak" in curve.event
    after = np.random.get_state(legacy=False)  # noqa: NPY002
    np.testing.assert_equal(after, before)
