"""Results are equal if all that they hold is."""

import copy
import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from microslip.files.result_file import load
from microslip.files.store import Stored, save
from microslip_mechanics.results.response_curve import ResponseCurve


def test_copies_are_equal_and_what_differs_is_not(result: Any) -> None:
    assert copy.deepcopy(result) == result
    assert pickle.loads(pickle.dumps(result)) == result
    other = result.frequency.copy()
    other[-1] = np.nextafter(other[-1], 0.0)
    assert replace(result, frequency=other) != result
    assert replace(result, ending="stopped") != result
    assert result != "a result"


def test_what_was_saved_is_what_is_loaded(
    small_curve: ResponseCurve, tmp_path: Path
) -> None:
    save(tmp_path / "curve.nc", Stored(small_curve, "a scene", "a command"))

    assert load(tmp_path / "curve.nc").result == small_curve


def test_values_that_are_not_known_are_equal(small_curve: ResponseCurve) -> None:
    unknown = np.full_like(small_curve.error, np.nan)

    assert replace(small_curve, error=unknown) == replace(
        small_curve, error=unknown.copy()
    )
    assert replace(small_curve, error=unknown) != small_curve


def test_what_is_there_differs_from_what_is_not(small_curve: ResponseCurve) -> None:
    without: Any = replace(small_curve, error=None)  # type: ignore[arg-type]

    assert without != small_curve
    assert small_curve != without
