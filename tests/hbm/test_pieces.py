"""Where a curve begins anew: which response it takes, and how far it leaps."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import hbm.continuation.tracing
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.pieces import Pieces
from hbm.curves.restart import FIRST
from hbm.errors import ContinuationError, RetracedError, ReturnedError
from microslip_mechanics.arrays import Array
from systems import Finer, Square

RESISTS = 0.3


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

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.continuation.cornered.round_corner", lambda *_: None)
    monkeypatch.setattr("hbm.curves.pieces.path_metric", lambda *_: np.ones(2))
    monkeypatch.setattr(
        "hbm.curves.restart.approaches",
        lambda *_, **__: (np.array([[y]]) for y in (0.0, 0.9)),
    )
    return found


def pieces(start: float, end: float, square: Square | None = None) -> Pieces:
    problem = SimpleNamespace(rank=1, rest=np.array([0.9]))
    path: Any = SimpleNamespace(
        rank=1, at=lambda parameter: (problem, parameter), unit=lambda _: 0.1
    )
    system: Any = square or Square()
    return Pieces(path, system, start, end, StepControl(), Effort())


def test_restarts_leap_farther_where_a_piece_comes_no_nearer_to_the_end(
    begun: list[tuple[float, float]],
) -> None:
    list(pieces(0.0, 1.0))

    assert [place for _, place in begun] == pytest.approx([0.0, 0.3001, 0.301, 0.305])


def test_a_curve_goes_on_from_where_more_harmonics_have_it_too(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    controls: list[StepControl] = []

    def trace(
        system: Finer, start: Array, _: float, **options: Any
    ) -> Iterator[Correction]:
        begun.append((float(start[0]), float(start[1])))
        controls.append(options["control"])
        places = (1.0,) if system.more else (0.1, 0.2, 0.21, RESISTS)
        for place in places:
            point = np.array([1.0, place])
            residual, linearised = system(point)
            along = np.array([0.0, 1.0])
            yield Correction(
                point, residual, linearised, Outcome.CONVERGED, (0.0,), along
            )
        if not system.more:
            raise ContinuationError("the curve does not go on")

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.curves.pieces.path_metric", lambda *_: np.ones(2))
    loose = replace(pieces(0.0, 1.0, Finer()), control=StepControl(negligible=1e-5))

    found = list(loose)

    assert [place for _, place in begun] == [0.0, 0.2]
    assert [each.point[-1] for each in found] == [0.1, 0.2, 0.21, RESISTS, 1.0]
    # 0.21, which was not tried, and 0.3, which they do not have, are taken back
    assert [each.replaces for each in found] == [0, 0, 0, 0, 2]
    assert [each.negligible for each in controls] == [1e-5, 0.0]


def test_points_are_taken_up_as_they_are_reported(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    # few harmonics err by more than two points of one curve may differ
    def trace(
        system: Finer, start: Array, _: float, **_options: Any
    ) -> Iterator[Correction]:
        begun.append((float(start[0]), float(start[1])))
        for place in (1.0,) if system.more else (0.1, 0.2):
            off, along = 0.0 if system.more else 0.1, np.array([0.0, 1.0])
            point = np.array([1.0 + off, place])
            residual, linearised = system(point)
            yield Correction(
                *(point, residual, linearised, Outcome.CONVERGED, (0.0,), along),
                reported=np.array([1.0, place]),
            )
        if not system.more:
            raise ContinuationError("the curve does not go on")

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)

    list(pieces(0.0, 1.0, Finer()))

    assert begun == [(0.9, 0.0), (1.0, 0.2)]


@pytest.mark.parametrize(
    ("error", "again", "replaces"),
    [(RetracedError, 0.24, 2), (ReturnedError, 0.2401, 0)],
)
def test_what_goes_back_on_itself_is_taken_up_where_it_turned(
    begun: list[tuple[float, float]],
    monkeypatch: pytest.MonkeyPatch,
    error: type[ReturnedError],
    again: float,
    replaces: int,
) -> None:
    # where a step has led to another part more harmonics would go there again: a leap
    def trace(
        system: Finer, start: Array, _: float, **_options: Any
    ) -> Iterator[Correction]:
        begun.append((float(start[0]), float(start[1])))
        first = len(begun) == 1
        for place in (0.1, 0.2, 0.24, 0.23, 0.22) if first else (1.0,):
            point, along = np.array([1.0, place]), np.array([0.0, 1.0])
            residual, linearised = system(point)
            yield Correction(
                point, residual, linearised, Outcome.CONVERGED, (0.0,), along
            )
        if first:
            raise error("the curve comes back", 0.24)

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)

    found = list(pieces(0.0, 1.0, Finer()))

    assert [place for _, place in begun] == pytest.approx([0.0, again])
    points = [each.point[-1] for each in found]
    assert points == [0.1, 0.2, 0.24, 0.23, 0.22, 1.0]
    assert [each.replaces for each in found] == [0, 0, 0, 0, 0, replaces]


def test_what_more_harmonics_do_not_have_is_followed_back_with_few(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    square, more = Finer(ends=0.0), list[bool]()
    traced: Callable[..., Iterator[Correction]] = vars(hbm.continuation.tracing)[
        "trace"
    ]

    def trace(*given: Any, **options: Any) -> Iterator[Correction]:
        more.append(square.more)
        return traced(*given, **options)

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))

    points = [each.point[-1] for each in pieces(0.0, 1.0, square)]

    assert [place for _, place in begun] == [0.0, 1.0]
    assert points == [RESISTS, 0.0]
    assert more == [False, False]


def test_where_ratios_count_a_curve_begins_behind_a_small_ratio(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried: list[float] = []

    def approaches(_path: Any, parameter: float, *_: Any, **__: Any) -> Iterator[Array]:
        tried.append(parameter)
        return iter(())

    monkeypatch.setattr("hbm.curves.restart.approaches", approaches)
    path: Any = SimpleNamespace(unit=lambda place: place * np.log(1e4) / 10.0)
    restart = replace(pieces(1e-6, 1e-2), path=path).restart

    assert restart.point(1e-6, 1e-2, iter(FIRST)) is None
    assert tried == pytest.approx([1e-6, 1.092e-6], rel=1e-3)


def test_a_restart_takes_the_first_response_that_exists(
    begun: list[tuple[float, float]],
) -> None:
    list(pieces(0.0, 1.0))

    assert [y for y, _ in begun[1:]] == pytest.approx([1.0] * 3, abs=1e-8)


def test_folds_of_the_drive_are_followed_at_the_nearest_and_the_farthest_place(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    tried: list[tuple[float, bool]] = []

    def approaches(
        _path: Any, parameter: float, *_: Any, folded: bool, **__: Any
    ) -> Iterator[Array]:
        tried.append((parameter, folded))
        return iter(())

    monkeypatch.setattr("hbm.curves.restart.approaches", approaches)

    list(pieces(0.0, 1.0))

    places, folded = zip(*tried, strict=True)
    assert begun[0][1] == 0.0
    assert places == pytest.approx([0.3001, 0.301, 0.305, 0.32, 0.35])
    assert folded == (True, False, False, False, True)


def test_where_the_response_that_the_end_has_besides_is_lost_the_curve_is_whole(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun: list[float] = []

    def trace(
        system: Square, start: Array, end: float, **_: Any
    ) -> Iterator[Correction]:
        begun.append(float(start[0]))
        if start[0] < 0.0:
            raise ContinuationError("the curve does not go on")
        point, along = np.array([1.0, end]), np.array([0.0, 1.0])
        residual, linearised = system(point)
        yield Correction(point, residual, linearised, Outcome.CONVERGED, (0.0,), along)

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.continuation.cornered.round_corner", lambda *_: None)
    monkeypatch.setattr("hbm.curves.pieces.path_metric", lambda *_: np.ones(2))
    monkeypatch.setattr(
        "hbm.curves.restart.Restart.besides", lambda *_: np.array([-1.0, 1.0])
    )

    points = [each.point.tolist() for each in pieces(0.0, 1.0)]

    assert points == [[1.0, 1.0]]
    assert begun == [0.9, -1.0]


def test_a_curve_that_stops_is_followed_from_the_other_end(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))

    points = [each.point for each in pieces(0.0, 1.0)]

    assert [place for _, place in begun] == [0.0, 1.0]
    assert [place for _, place in points] == [RESISTS, 0.0]


def test_a_curve_that_stops_and_folds_back_at_the_other_end_is_not_whole(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    traced: Callable[..., Iterator[Correction]] = vars(hbm.continuation.tracing)[
        "trace"
    ]

    def trace(
        system: Any, start: Array, end: float, **options: Any
    ) -> Iterator[Correction]:
        back = 1.0 if start[-1] == 1.0 else end
        return traced(system, start, back, **options)

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))

    with pytest.raises(ContinuationError, match="does not go on at 0"):
        list(pieces(0.0, 1.0))

    assert [place for _, place in begun] == [0.0, 1.0]


def test_a_curve_that_stops_from_both_ends_says_where_it_did_first(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))
    kept: list[Correction] = []

    with pytest.raises(ContinuationError, match="does not go on at 0"):
        kept.extend(pieces(0.0, RESISTS - 0.1))

    assert [place for _, place in begun] == pytest.approx([0.0, RESISTS - 0.1])
    assert len(kept) == 2


@pytest.fixture
def returned(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> list[tuple[float, float]]:
    """Return where pieces begin; those from 0 and 1 turn back at 0.4 and 0.7."""
    corners = {0.0: 0.4, 1.0: 0.7}

    def trace(system: Any, start: Array, end: float, **_: Any) -> Iterator[Correction]:
        y, place = map(float, start)
        begun.append((y, place))
        residual, linearised = system(start)
        along = np.array([0.0, 1.0])
        for reached in (corners.get(place, place), place if place in corners else end):
            point = np.array([y, reached])
            yield Correction(
                point, residual, linearised, Outcome.CONVERGED, (0.0,), along
            )

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    return begun


def test_what_lies_between_curves_that_turn_back_is_sought(
    returned: list[tuple[float, float]],
) -> None:
    points = [each.point for each in pieces(0.0, 1.0)]

    assert [place for _, place in returned] == pytest.approx([0.0, 1.0, 0.4001])
    assert [place for _, place in points] == [0.4, 0.0, 0.7, 1.0, 0.4001, 1.0]


def test_what_resists_between_curves_that_turn_back_is_leaped_over(
    returned: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    traced: Callable[..., Iterator[Correction]] = vars(hbm.continuation.tracing)[
        "trace"
    ]

    def trace(
        system: Any, start: Array, end: float, **options: Any
    ) -> Iterator[Correction]:
        resists = 0.4 < start[-1] < 0.45
        yield from traced(system, start, 0.45 if resists else end, **options)
        if resists:
            raise ContinuationError("the curve does not go on at 0.45")

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)

    points = [each.point[-1] for each in pieces(0.0, 1.0)]

    begins = [place for _, place in returned]
    assert begins == pytest.approx([0.0, 1.0, 0.4001, 0.4501])
    assert points == pytest.approx([0.4, 0.0, 0.7, 1.0, 0.4001, 0.45, 0.4501, 1.0])


def test_what_lies_between_curves_that_turn_back_and_is_not_found_is_told(
    returned: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))

    with pytest.raises(ContinuationError, match=r"turns back at parameter 0\.4,"):
        list(pieces(0.0, 1.0))

    assert [place for _, place in returned] == [0.0, 1.0]


def test_a_curve_that_does_not_begin_is_followed_from_the_other_end(
    begun: list[tuple[float, float]], monkeypatch: pytest.MonkeyPatch
) -> None:
    traced: Callable[..., Iterator[Correction]] = vars(hbm.continuation.tracing)[
        "trace"
    ]

    def trace(
        system: Any, start: Array, end: float, **options: Any
    ) -> Iterator[Correction]:
        if start[-1] == 0.0:
            raise ContinuationError("no response is found at 0")
        return traced(system, start, end, **options)

    monkeypatch.setattr("hbm.continuation.tracing.trace", trace)
    monkeypatch.setattr("hbm.curves.restart.approaches", lambda *_, **__: iter(()))

    points = [each.point for each in pieces(0.0, 1.0)]

    assert begun == [pytest.approx((0.9, 1.0))]
    assert [place for _, place in points] == [0.0]
