"""Traces that go round corners."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from hbm.continuation.corner import Turned
from hbm.continuation.cornered import Cornered
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.step_control import StepControl
from hbm.continuation.tracing import Tracing
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array
from systems import Square


@pytest.mark.parametrize(("corner", "ahead"), [(0.2999, 0.0), (0.304, 1e-2)])
def test_behind_a_corner_a_piece_does_not_lead_back(
    corner: float, ahead: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The corner, where the point is settled, may lie beyond the one that was found."""

    def trace(
        system: Square, start: Array, _: float, **__: Any
    ) -> Iterator[Correction]:
        residual, linearised = system(start)
        along = np.array([0.0, 1.0 if start[-1] > corner else -1.0])
        yield Correction(start, residual, linearised, Outcome.CONVERGED, (0.0,), along)
        if start[-1] == 0.0:
            raise ContinuationError("the curve does not go on")

    turned = Turned(np.array([1.0, 0.3]), np.array([0.0, 1.0]), folds=True)
    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.continuation.cornered.round_corner", lambda *_: turned)
    square, start = Square(), np.array([1.0, 0.0])

    tracing = Tracing(square, 1.0, 0.0, np.ones_like, StepControl(), square)
    _, found = Cornered(tracing, start)

    assert found.turns
    assert found.point[-1] == pytest.approx(0.3 + ahead)
