"""Where a curve begins anew: which response it takes, and how far it leaps."""

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hbm.pieces
from hbm.effort import Effort
from hbm.errors import ContinuationError
from hbm.newton import Correction, Outcome
from hbm.options import CurveOptions
from hbm.path import along_frequency
from hbm.pieces import Pieces
from hbm.settler import Unsettled
from hbm.solve import frequency_response
from hbm.step_control import StepControl
from hbm.tracer import Tracer
from microslip.rigs import problem_of
from microslip.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from systems import Dense

TURN = 2.0 * np.pi
RESISTS = 0.3


class Square(Unsettled):
    """y² = 1, at any parameter."""

    size = 2

    def __call__(self, point: Array) -> tuple[Array, Dense]:
        y, _ = point
        return np.array([y**2 - 1.0]), Dense([[2.0 * y, 0.0]])

    def restart(self, harmonics: int) -> None:
        """Have nothing to begin anew."""


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, float]]:
    """Return where pieces begin, which end at 0.3 unless they begin behind 0.302."""
    found: list[tuple[float, float]] = []

    def trace(
        system: Square, start: Array, end: float, **_: Any
    ) -> Iterator[Correction]:
        y, place = map(float, start)
        found.append((y, place))
        reached = end if place > RESISTS + 0.002 else RESISTS
        residual, linearised = system(start)
        point = np.array([y, reached])
        along = np.array([0.0, 1.0])
        yield Correction(point, residual, linearised, Outcome.CONVERGED, (0.0,), along)
        if reached != end:
            raise ContinuationError(f"the curve does not go on at {place:g}")

    monkeypatch.setattr("hbm.pieces.trace", trace)
    monkeypatch.setattr("hbm.pieces.round_corner", lambda *_: None)
    monkeypatch.setattr(
        "hbm.pieces.approaches", lambda *_: (np.array([[y]]) for y in (0.0, 0.9))
    )
    return found


def pieces(start: float, end: float) -> Pieces:
    problem = SimpleNamespace(rank=1, rest=np.array([0.9]))
    path: Any = SimpleNamespace(
        rank=1, at=lambda parameter: (problem, parameter), unit=lambda _: 0.1
    )
    system: Any = Square()
    return Pieces(path, system, start, end, StepControl(), Effort())


def test_restarts_leap_farther_where_a_piece_comes_no_nearer_to_the_end(
    begun: list[tuple[float, float]],
) -> None:
    list(pieces(0.0, 1.0))

    assert [place for _, place in begun] == pytest.approx([0.0, 0.3001, 0.301, 0.305])


def test_a_restart_takes_the_first_response_that_exists(
    begun: list[tuple[float, float]],
) -> None:
    list(pieces(0.0, 1.0))

    assert [y for y, _ in begun[1:]] == pytest.approx([1.0] * 3, abs=1e-8)


def test_a_curve_that_stops_is_followed_from_the_other_end(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hbm.pieces.approaches", lambda *_: iter(()))

    points = [each.point for each in pieces(0.0, 1.0)]

    assert [place for _, place in begun] == [0.0, 1.0]
    assert [place for _, place in points] == [RESISTS, 0.0]


def test_a_curve_that_stops_and_folds_back_at_the_other_end_is_not_whole(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    traced: Callable[..., Iterator[Correction]] = vars(hbm.pieces)["trace"]

    def trace(
        system: Any, start: Array, end: float, **options: Any
    ) -> Iterator[Correction]:
        back = 1.0 if start[-1] == 1.0 else end
        return traced(system, start, back, **options)

    monkeypatch.setattr("hbm.pieces.trace", trace)
    monkeypatch.setattr("hbm.pieces.approaches", lambda *_: iter(()))

    with pytest.raises(ContinuationError, match="does not go on at 0"):
        list(pieces(0.0, 1.0))

    assert [place for _, place in begun] == [0.0, 1.0]


def test_a_curve_that_stops_from_both_ends_says_where_it_did_first(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hbm.pieces.approaches", lambda *_: iter(()))
    kept: list[Correction] = []

    with pytest.raises(ContinuationError, match="does not go on at 0"):
        kept.extend(pieces(0.0, RESISTS - 0.1))

    assert [place for _, place in begun] == pytest.approx([0.0, RESISTS - 0.1])
    assert len(kept) == 2


def test_a_curve_that_does_not_begin_is_followed_from_the_other_end(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    traced: Callable[..., Iterator[Correction]] = vars(hbm.pieces)["trace"]

    def trace(
        system: Any, start: Array, end: float, **options: Any
    ) -> Iterator[Correction]:
        if start[-1] == 0.0:
            raise ContinuationError("no response is found at 0")
        return traced(system, start, end, **options)

    monkeypatch.setattr("hbm.pieces.trace", trace)
    monkeypatch.setattr("hbm.pieces.approaches", lambda *_: iter(()))

    points = [each.point for each in pieces(0.0, 1.0)]

    assert begun == [pytest.approx((0.9, 1.0))]
    assert [place for _, place in points] == [0.0]


def test_a_duffing_curve_without_a_first_point_is_traced_from_its_end() -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    options = CurveOptions(TURN * 5.8, TURN * 9.0, stability=False)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    assert curve[0].frequency == TURN * 9.0
    assert curve[-1].frequency == TURN * 5.8
    assert "restart" not in [each.event for each in curve]


@pytest.mark.parametrize("limit", [{"harmonics": 1}, {"most_harmonics": 1}])
@pytest.mark.parametrize("harmonics", [3, 7, 15])
def test_a_curve_of_few_harmonics_goes_on_from_a_response_of_more(
    harmonics: int, limit: dict[str, Any]
) -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    start, end = TURN * 6.8, TURN * 9.0
    path = along_frequency(problem, static_equilibrium(problem), start, end)
    tracer = Tracer(problem, path, CurveOptions(start, end, stability=False, **limit))

    found = tracer.pieces._settled(np.zeros((2 * harmonics + 1, 1)), start)

    assert found is not None
    assert found[-1] == start
    assert np.abs(found[1:3]).max() > 1e-4
    np.testing.assert_array_equal(found[3:-1], 0.0)


def test_a_rig_whose_coarse_responses_differ_has_a_first_point() -> None:
    """Model B that slides by 4 mm with friction that falls with speed."""
    problem = rig_problem(
        model="B",
        friction__law="gkf",
        friction__mu_dynamic=5.0,
        friction__mu_static=10.0,
        friction__threshold_velocity=1e-2,
        contact__sigma=3e-9,
        preload__force=1.0,
        excitation__force=100.0,
    )
    options = CurveOptions(TURN * 125.0, TURN * 125.1, stability=False, events=False)

    curve = frequency_response(problem, static_equilibrium(problem), options)

    first = next(curve)
    assert first.frequency == TURN * 125.0
    assert first.error < options.error
