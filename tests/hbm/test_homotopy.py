"""Easier problems from which a first point is reached."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hbm.homotopy
from hbm.homotopy import FOURIERS, approaches
from microslip_mechanics.arrays import Array


@pytest.mark.parametrize(
    ("friction", "tried"),
    [(0.0, ["_drive"]), (0.3, ["_drive", "_threshold", "_friction"])],
)
def test_without_friction_the_drive_alone_makes_a_problem_easier(
    friction: float, tried: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    found: list[str] = []

    def followed(_path: Any, _parameter: Any, easier: Any, *_: Any) -> Array:
        found.append(easier.__name__)
        return np.zeros((1, 1))

    def along(*_: Any) -> Array:
        found.append("arc")
        return np.zeros((1, 1))

    monkeypatch.setattr(hbm.homotopy, "_followed", followed)
    monkeypatch.setattr(hbm.homotopy, "_along_an_arc", along)
    laws = np.array([friction])
    points = SimpleNamespace(dynamic=laws, static=laws)
    path: Any = SimpleNamespace(at=lambda _: (SimpleNamespace(points=points), 1.0))
    nothing: Any = None

    list(approaches(path, 1.0, nothing, nothing, nothing))

    # what may take long comes last
    assert found == tried * len(FOURIERS) + ["arc"] * len(FOURIERS)

    found.clear()
    list(approaches(path, 1.0, nothing, nothing, nothing, folded=False))
    assert found == tried * len(FOURIERS)
